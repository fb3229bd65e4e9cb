"""Commands that move the cursor, and commands that run the program."""

from handeye.core.errors import BadArgument, Refused
from handeye.core.plain_text import counted
from handeye.systems.trig.language.given import Given
from handeye.systems.trig.language.node import NONE, TOP
from handeye.systems.trig.language.obstacles import told_obstacle
from handeye.systems.trig.language.running import Ran
from handeye.systems.trig.language.session import Session

_FARTHEST = 100_000
"""Steps that the cursor is moved by at most."""


def next_step(session: Session, given: Given) -> None:
    """N: go down so many steps; loops are passed by."""
    program = session.program
    for _ in range(_distance(given)):
        branch = session.branch(None)
        son = program.graph.step_at(program.active.sons[branch])
        if son == NONE:
            session.desk.tell("no step follows" if program.first != NONE else "the program is empty")
            return
        _come_down(session, son, branch)


def _come_down(session: Session, son: int, branch: int) -> None:
    """Move the cursor along an edge, which makes every father on it the most recent one."""
    graph, father = session.program.graph, session.program.cursor
    node = graph[father].sons[branch]
    while True:
        graph[node].last_father = father
        if node == son:
            break
        father, node = node, graph[node].sons[0]
    session.program.put_cursor(son)


def previous_step(session: Session, given: Given) -> None:
    """P: go up so many steps, by the fathers that were active last."""
    program = session.program
    for _ in range(_distance(given)):
        above = program.above(program.cursor)
        if above == TOP or program.cursor == TOP:
            session.desk.tell("this is the first step" if program.first != NONE else "the program is empty")
            return
        program.put_cursor(above)


def goto(session: Session, given: Given) -> None:
    """GOTO: make a named step the active one."""
    session.program.put_cursor(session.step(given.step or "").id)


def run(session: Session, given: Given) -> None:
    """RUN: the whole program, or so many steps, or so many backwards."""
    if given.count == 0:
        raise BadArgument(
            "RUN 0 would do nothing; RUN 1 executes the active step, RUN -1 undoes the last one"
        )
    if given.count is not None and given.count < 0:
        session.desk.tell(told_run(session.runner.back(-given.count), back=True))
        return
    if session.program.first == NONE:
        raise Refused("the program is empty; M teaches its first step")
    ran = session.runner.run() if given.count is None else session.runner.forward(given.count)
    session.desk.tell(told_run(ran))


def told_run(ran: Ran, *, back: bool = False) -> str:
    """How a run has ended, in words."""
    steps = f"{counted(ran.steps, 'step')} {'undone' if back else 'done'}"
    if ran.obstacle is not None:
        return f"{steps}; the arm has stopped at the step before that: {told_obstacle(ran.obstacle)}"
    return {
        "count": steps,
        "none": f"{steps}; the program has ended",
        "halted": f"{steps}; stopped: RUN with a number goes on, with a minus goes back",
        "beginning": f"{steps}; there is nothing to undo before this"
        if ran.steps
        else "there is nothing to undo",
        "forgotten": f"{steps}; what was done before that has been forgotten",
        "deleted": f"{steps}; the step that was done before this has been deleted and cannot be undone",
    }[ran.end]


def _distance(given: Given) -> int:
    count = 1 if given.count is None else given.count
    if not 0 < count <= _FARTHEST:
        raise BadArgument(f"N and P go 1 to {_FARTHEST} steps; N goes down, P goes up")
    return count
