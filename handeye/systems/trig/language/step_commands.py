"""Commands that add a step below the active one; moves and hand act at once."""

from collections.abc import Callable
from typing import Literal

from handeye.core.errors import BadArgument, Refused
from handeye.systems.trig.language.arguments import Arguments
from handeye.systems.trig.language.graph import NONE, TOP, Node, insert_loop, prune
from handeye.systems.trig.language.place import Position, free_name, told_place
from handeye.systems.trig.language.program import RecordedStep
from handeye.systems.trig.language.session import Session

Acted = Callable[[Session, Arguments], None]


def move(kind: Literal["absolute", "relative"] | None, *, guarded: bool = False) -> Acted:
    """M, MA, MR, MG, MAG and MRG: move to a position, teaching it if it is not defined."""

    def act(session: Session, given: Arguments) -> None:
        branch = session.open_branch(given.branch)
        node = session.program.graph.new("guarded" if guarded else "normal")
        node.negate = given.negate
        if given.position in session.program.positions:
            _to_known(session, given, kind, node, branch)
        elif given.negate:
            raise Refused(f"-{given.position} has no opposite yet: {given.position} is not defined")
        else:
            relative = session.program.relative_by_default() if kind is None else kind == "relative"
            _to_taught(session, given.position, relative, node, branch)

    return act


def _to_known(session: Session, given: Arguments, kind: str | None, node: Node, branch: int) -> None:
    position = session.position(given.position, negate=given.negate)
    defined = "relative" if position.relative else "absolute"
    if kind not in (None, defined):
        raise Refused(f"{given.position} is {defined}; M goes there")
    node.position = given.position
    session.confirmed("Move to the predefined location? ")
    if node.type == "guarded":
        node.threshold, node.vector = session.threshold(), session.vector()
    halted = session.runner.execute(node, session.program.cursor) is None
    taken = session.program.taken
    _add(session, node, branch)
    session.program.taken = taken
    if halted:
        session.desk.tell(f"stopped at {told_place(session.arm.here())}; RUN 1 goes on with this step")


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
    """GRASP and UNGRASP: close the hand, or open it."""

    def act(session: Session, given: Arguments) -> None:
        branch = session.open_branch(None)
        node = session.program.graph.new("grasp" if closed else "ungrasp")
        session.runner.execute(node, session.program.cursor)
        _add(session, node, branch)

    return act


def save(session: Session, given: Arguments) -> None:
    """SAVPOS: set a position to the arm's place, now and whenever the step is executed."""
    branch = session.open_branch(given.branch)
    name, here = given.position or "", session.arm.here()
    position = session.program.positions.get(name)
    if position is None:
        session.program.positions[name] = Position(relative=False, init=here, data=here)
    elif position.relative:
        check_no_opposite(session, name)
        session.confirmed(f"{name} is relative. Make it the absolute place where the arm is now? ")
        session.program.positions[name] = Position(relative=False, init=here, data=here)
    node = session.program.graph.new("savpos")
    node.position = name
    session.runner.execute(node, session.program.cursor)
    _add(session, node, branch)


def check_no_opposite(session: Session, name: str) -> None:
    """Raise Refused if a step uses the opposite of a position that is to become absolute."""
    if any(node.negate for node in session.program.users(name)):
        raise Refused(f"a step goes to -{name}, so {name} stays relative; D deletes the step")


def loop(session: Session, given: Arguments) -> None:
    """LOOP: go back to a step a number of times before going on."""
    target, wanted = session.step(given.step or ""), given.count or 0
    if target.id == TOP:
        raise Refused(f"a loop goes back to a step; {target_hint(session)}")
    if wanted < 0:
        raise BadArgument(f"a loop goes back 0 times or more, not {wanted}")
    program = session.program
    branch = session.open_branch(None)
    node = insert_loop(program.graph, program.cursor, branch, target.id, wanted)
    program.put_cursor(node.id)
    program.changed = True


def target_hint(session: Session) -> str:
    """A hint on naming the first step."""
    first = session.program.first
    if first == NONE:
        return "the program is empty"
    name = session.program.graph[first].name
    return f"the first is {name}" if name else "P and CN name the first"


def link(session: Session, given: Arguments) -> None:
    """L: continue at an existing step."""
    program, target = session.program, session.step(given.step or "")
    if program.cursor == TOP or target.id == TOP:
        raise Refused("a link leads from a step to a step, and not to or from the top")
    branch = session.branch(given.branch)
    entry = program.graph.entry(target.id)
    son = program.active.sons[branch]
    if son == entry:
        raise Refused(f"the active step leads on to {target.name} already")
    if son != NONE:
        session.confirmed(f"Another step follows here. Replace it by a link to {target.name}? ")
    above = program.above(program.cursor)
    program.graph.attach(program.cursor, branch, entry, link=True)
    prune(program.graph)
    program.edited(above)


def _add(session: Session, node: Node, branch: int) -> None:
    """Add an executed step below the active one, and make it active."""
    program = session.program
    program.graph.insert(program.cursor, branch, node)
    program.put_cursor(node.id)
    program.changed = True
