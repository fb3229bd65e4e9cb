"""Commands that change or delete steps."""

from handeye.core.errors import BadArgument, Refused
from handeye.systems.trig.language.arguments import Arguments, read_branch
from handeye.systems.trig.language.graph import NONE, TOP, Node, delete_below, delete_step, prune
from handeye.systems.trig.language.program import TrigProgram
from handeye.systems.trig.language.session import Session


def rename(session: Session, given: Arguments) -> None:
    """CN: give the active step a name."""
    node, name = active_step(session), given.step or ""
    if node.type == "loop":
        raise Refused("a loop step shows where it goes back to, and has no name of its own")
    other = session.program.graph.named(name)
    if other is not None and other is not node:
        raise BadArgument(f"another step is called {name}; GOTO {name} shows which")
    if name.startswith("*"):
        raise BadArgument("that is the name of the top; a step has a name such as GET-BLOCK")
    node.name = name
    session.program.changed = True


def change_position(session: Session, given: Arguments) -> None:
    """CP: give the active step another position."""
    node = active_step(session)
    position = session.position(given.position)
    if node.position is None:
        raise Refused("the active step has no position to change: it is not a move, and saves none")
    if node.type == "savpos" and position.relative:
        raise Refused(f"{given.position} is relative; SAVPOS saves an absolute place")
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
    """D: delete one step; of a guarded one, keep branch n or g."""
    program, node = session.program, _named_or_active(session, given)
    keep = _kept_branch(session, given, node)
    above = program.above(node.id)
    delete_step(program.graph, node.id, keep)
    _after(program, above)


def delete_all(session: Session, given: Arguments) -> None:
    """DA: delete a step and everything reachable only through it."""
    program, node = session.program, _named_or_active(session, given)
    above = program.above(node.id)
    delete_below(program.graph, node.id)
    _after(program, above)


def unlink(session: Session, given: Arguments) -> None:
    """DLINK: remove the edge from the active step to a step that others lead to as well."""
    program, target = session.program, session.step(given.step or "")
    node, graph = active_step(session), program.graph
    entry = graph.entry(target.id)
    branches = [branch for branch, son in enumerate(node.sons) if son == entry]
    if not branches:
        raise Refused(f"the active step does not lead to {target.name}")
    if len(graph.edges_into(entry)) == 1:
        raise Refused(f"nothing else leads to {target.name}; `DA {target.name}` deletes it")
    branch = branches[0] if len(branches) == 1 and given.branch is None else session.branch(given.branch)
    if branch not in branches:
        raise Refused(f"that branch does not lead to {target.name}")
    if not _reached_otherwise(program, node, branch, entry):
        raise Refused(
            f"{target.name} can be reached from the top by this step only; `DA {target.name}` deletes it"
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
    """Return if nothing would be lost, or the user agrees; else raise Cancelled."""
    if session.program.changed:
        session.confirmed(f"The program has not been written to a file. {deed}? ")


def active_step(session: Session) -> Node:
    if session.program.cursor == TOP:
        empty = session.program.first == NONE
        raise Refused(
            "the program is empty; M teaches its first step"
            if empty
            else "the top is no step; N goes to the first"
        )
    return session.program.active


def _guarded(session: Session, what: str) -> Node:
    node = active_step(session)
    if node.type != "guarded":
        raise Refused(f"the active step is not guarded, and has no {what}; MG adds one that is")
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
    """True if a node can be reached from the top without one edge."""
    node.sons[branch] = NONE
    reached = entry in program.graph.distances(TOP)
    node.sons[branch] = entry
    return reached


def _after(program: TrigProgram, above: int) -> None:
    """Move the cursor above what was deleted."""
    program.put_cursor(above if above in program.graph else TOP)
    program.taken, program.changed = None, True
