"""Commands that add a step below the active step, and commands that change or delete steps. Moves and hand steps
are executed as soon as they are added.
"""

from collections.abc import Callable
from typing import Literal

from handeye.core.errors import BadArgument, Refused
from handeye.systems.trig.language.arguments import Arguments, read_branch
from handeye.systems.trig.language.graph import NONE, TOP, Node, delete_below, delete_step, insert_loop, prune
from handeye.systems.trig.language.place import Position, free_name, told_place
from handeye.systems.trig.language.program import RecordedStep, TrigProgram
from handeye.systems.trig.language.session import Session

Acted = Callable[[Session, Arguments], None]


def move(kind: Literal["absolute", "relative"] | None, *, guarded: bool = False) -> Acted:
    """M, MA, MR, MG, MAG and MRG: move to a position. If the position is not defined, the user teaches it."""

    def act(session: Session, given: Arguments) -> None:
        branch = session.open_branch(given.branch)
        node = session.program.graph.new("guarded" if guarded else "normal")
        node.negate = given.negate
        if given.position in session.program.positions:
            _to_known(session, given, kind, node, branch)
        elif given.negate:
            raise Refused(f"-{given.position} cannot be used yet, because {given.position} is not defined")
        else:
            relative = session.program.relative_by_default() if kind is None else kind == "relative"
            _to_taught(session, given.position, relative, node, branch)

    return act


def _to_known(session: Session, given: Arguments, kind: str | None, node: Node, branch: int) -> None:
    position = session.position(given.position, negate=given.negate)
    defined = "relative" if position.relative else "absolute"
    if kind not in (None, defined):
        raise Refused(f"{given.position} is already defined, as {defined}; to go there, use M")
    node.position = given.position
    session.confirmed("Move to the predefined location? ")
    if node.type == "guarded":
        node.threshold, node.vector = session.threshold(), session.vector()
    halted = session.runner.execute(node, session.program.cursor) is None
    taken = session.program.taken
    _add(session, node, branch)
    session.program.taken = taken
    if halted:
        session.desk.tell(f"stopped at {told_place(session.arm.here())}; RUN 1 continues this step")


def _to_taught(session: Session, name: str | None, relative: bool, node: Node, branch: int) -> None:
    program, start, closed = session.program, session.arm.here(), session.arm.closed
    end = session.taught()
    if node.type == "guarded":
        node.threshold, node.vector = session.threshold(), session.vector()
    data = end.seen_from(start) if relative else end
    node.position = free_name(program.positions) if name is None else name
    program.positions[node.position] = Position(relative=relative, init=data, data=data)
    program.remember(RecordedStep(node.id, start, closed))
    program.ended_at = end
    _add(session, node, branch)


def hand(closed: bool) -> Acted:
    """GRASP and UNGRASP: close or open the hand."""

    def act(session: Session, given: Arguments) -> None:
        branch = session.open_branch(None)
        node = session.program.graph.new("grasp" if closed else "ungrasp")
        session.runner.execute(node, session.program.cursor)
        _add(session, node, branch)

    return act


def save(session: Session, given: Arguments) -> None:
    """SAVPOS: set a position to the arm's present place, and add a step that does the same whenever it is executed."""
    branch = session.open_branch(given.branch)
    name, here = given.position or "", session.arm.here()
    position = session.program.positions.get(name)
    if position is None:
        session.program.positions[name] = Position(relative=False, init=here, data=here)
    elif position.relative:
        check_no_opposite(session, name)
        session.confirmed(
            f"{name} is a relative position. Replace it with the present place of the arm, as an absolute position? "
        )
        session.program.positions[name] = Position(relative=False, init=here, data=here)
    node = session.program.graph.new("savpos")
    node.position = name
    session.runner.execute(node, session.program.cursor)
    _add(session, node, branch)


def check_no_opposite(session: Session, name: str) -> None:
    """Raise Refused if a step uses the opposite of the position `name`. A position cannot become absolute while its
    opposite is in use.
    """
    if any(node.negate for node in session.program.users(name)):
        raise Refused(f"{name} cannot become absolute, because a step goes to -{name}; D deletes the step")


def loop(session: Session, given: Arguments) -> None:
    """LOOP: return to a step a number of times before continuing with the next step."""
    target, wanted = session.step(given.step or ""), given.count or 0
    if target.id == TOP:
        raise Refused(f"a loop cannot go back to the top, only to a step; {target_hint(session)}")
    if wanted < 0:
        raise BadArgument(f"the count of a loop must be 0 or more, not {wanted}")
    program = session.program
    branch = session.open_branch(None)
    node = insert_loop(program.graph, program.cursor, branch, target.id, wanted)
    program.put_cursor(node.id)
    program.changed = True


def target_hint(session: Session) -> str:
    """Return a hint that helps the user to name the step to which a loop returns."""
    first = session.program.first
    if first == NONE:
        return "the program is empty"
    name = session.program.graph[first].name
    return f"the first step is {name}" if name else "to name the first step, go to it with P and type CN"


def link(session: Session, given: Arguments) -> None:
    """L: make an existing step the next step after the active step."""
    program, target = session.program, session.step(given.step or "")
    if program.cursor == TOP or target.id == TOP:
        raise Refused("a link leads from one step to another, and the top is not a step")
    branch = session.branch(given.branch)
    entry = program.graph.entry(target.id)
    son = program.active.sons[branch]
    if son == entry:
        raise Refused(f"the active step already leads to {target.name}")
    if son != NONE:
        session.confirmed(f"Another step follows here. Replace it with a link to {target.name}? ")
    above = program.above(program.cursor)
    program.graph.attach(program.cursor, branch, entry, link=True)
    prune(program.graph)
    program.edited(above)


def _add(session: Session, node: Node, branch: int) -> None:
    """Add `node`, a step that was just executed, below the active step. The new step becomes the active step."""
    program = session.program
    program.graph.insert(program.cursor, branch, node)
    program.put_cursor(node.id)
    program.changed = True


def rename(session: Session, given: Arguments) -> None:
    """CN: give the active step a name."""
    node, name = active_step(session), given.step or ""
    if node.type == "loop":
        raise Refused("a loop step cannot have a name: its line shows the step to which it goes back")
    other = session.program.graph.named(name)
    if other is not None and other is not node:
        raise BadArgument(f"another step is already called {name}; GOTO {name} shows it")
    if name.startswith("*"):
        raise BadArgument("only the top has a name that begins with `*`; choose a name such as GET-BLOCK")
    node.name = name
    session.program.changed = True


def change_position(session: Session, given: Arguments) -> None:
    """CP: give the active step another position."""
    node = active_step(session)
    position = session.position(given.position)
    if node.position is None:
        raise Refused(
            "the active step has no position to change, because it neither goes to a position nor saves a position"
        )
    if node.type == "savpos" and position.relative:
        raise Refused(f"{given.position} is relative, but a SAVPOS step needs an absolute position")
    node.position, node.negate = given.position, False
    session.program.changed = True


def change_threshold(session: Session, given: Arguments) -> None:
    """CT: change the threshold of the active step."""
    _guarded(session, "threshold").threshold = given.threshold
    session.program.changed = True


def change_vector(session: Session, given: Arguments) -> None:
    """CV: change the force vector of the active step."""
    _guarded(session, "force vector").vector = given.vector
    session.program.changed = True


def delete(session: Session, given: Arguments) -> None:
    """D: delete one step. If the step is guarded, keep only branch n or g."""
    program, node = session.program, _named_or_active(session, given)
    keep = _kept_branch(session, given, node)
    above = program.above(node.id)
    delete_step(program.graph, node.id, keep)
    _after(program, above)


def delete_all(session: Session, given: Arguments) -> None:
    """DA: delete a step and all steps that can be reached only through it."""
    program, node = session.program, _named_or_active(session, given)
    above = program.above(node.id)
    delete_below(program.graph, node.id)
    _after(program, above)


def unlink(session: Session, given: Arguments) -> None:
    """DLINK: remove the edge from the active step to one of its sons. This son must also have another father."""
    program, target = session.program, session.step(given.step or "")
    node, graph = active_step(session), program.graph
    entry = graph.entry(target.id)
    branches = [branch for branch, son in enumerate(node.sons) if son == entry]
    if not branches:
        raise Refused(f"the active step does not lead to {target.name}")
    if len(graph.edges_into(entry)) == 1:
        raise Refused(
            f"no other step leads to {target.name}; to delete {target.name}, use `DA {target.name}`"
        )
    branch = branches[0] if len(branches) == 1 and given.branch is None else session.branch(given.branch)
    if branch not in branches:
        raise Refused(f"the chosen branch does not lead to {target.name}")
    if not _reached_otherwise(program, node, branch, entry):
        raise Refused(
            f"{target.name} can be reached from the top only through this step; to delete {target.name}, use "
            f"`DA {target.name}`"
        )
    above = program.above(node.id)
    graph.attach(node.id, branch, NONE)
    prune(graph)
    program.edited(above)


def flush(session: Session, given: Arguments) -> None:
    """FLUSH: erase the program."""
    ask_if_unsaved(session, "Erase it")
    session.program, session.origin, session.file = TrigProgram(), None, None


def ask_if_unsaved(session: Session, deed: str) -> None:
    """If the program has unsaved changes, ask the user whether to lose these changes. Raises Cancelled unless the user
    agrees."""
    if session.program.changed:
        session.confirmed(f"The program has not been written to a file. {deed}? ")


def active_step(session: Session) -> Node:
    if session.program.cursor == TOP:
        empty = session.program.first == NONE
        raise Refused(
            "the program is empty; M teaches its first step"
            if empty
            else "no step is active at the top of the program; N goes to the first step"
        )
    return session.program.active


def _guarded(session: Session, what: str) -> Node:
    node = active_step(session)
    if node.type != "guarded":
        raise Refused(f"the active step is not guarded and has no {what}; MG adds a guarded step")
    return node


def _named_or_active(session: Session, given: Arguments) -> Node:
    node = active_step(session) if given.step is None else session.step(given.step)
    if node.id == TOP:
        raise Refused("the top cannot be deleted; FLUSH erases the program")
    return node


def _kept_branch(session: Session, given: Arguments, node: Node) -> int:
    if node.type != "guarded" or given.branch is not None:
        return session.branch(given.branch, node)
    kept = [branch for branch, son in enumerate(node.sons) if son != NONE]
    if len(kept) == 2:
        return session.desk.ask("Keep which branch, normal or guarded? ", read_branch)
    return kept[0] if kept else 0


def _reached_otherwise(program: TrigProgram, node: Node, branch: int, entry: int) -> bool:
    """Return True if the node `entry` can be reached from the top without the edge from `node` to it."""
    node.sons[branch] = NONE
    reached = entry in program.graph.distances(TOP)
    node.sons[branch] = entry
    return reached


def _after(program: TrigProgram, above: int) -> None:
    """Move the cursor to the step above the deleted steps."""
    program.put_cursor(above if above in program.graph else TOP)
    program.taken, program.changed = None, True
