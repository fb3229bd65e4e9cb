"""Commands that move the cursor, run the program, read and write files, and end the session."""

from pathlib import Path

from handeye.core.errors import BadArgument, Refused
from handeye.core.files import check_new, check_place
from handeye.core.plain_text import counted
from handeye.systems.trig.language.arguments import Arguments
from handeye.systems.trig.language.graph import NONE, TOP
from handeye.systems.trig.language.running import RunResult
from handeye.systems.trig.language.session import Session
from handeye.systems.trig.language.step_commands import ask_if_unsaved
from handeye.systems.trig.language.storage import TRIG_FILE, read_program, trig_file, write_program
from handeye.systems.trig.language.trig_arm import told_obstacle

_MAX_DISTANCE = 100_000  # steps of the cursor


def next_step(session: Session, given: Arguments) -> None:
    """N: move the cursor down by a number of steps. At a loop, the cursor moves on to the step after the loop, and not
    back to the loop's target.
    """
    program = session.program
    for _ in range(_distance(given)):
        branch = session.branch(None)
        son = program.graph.step_at(program.active.sons[branch])
        if son == NONE:
            session.desk.tell("no step follows" if program.first != NONE else "the program is empty")
            return
        _come_down(session, son, branch)


def _come_down(session: Session, son: int, branch: int) -> None:
    """Move the cursor along an edge. Make each node on the way the most recent father of the next node."""
    graph, father = session.program.graph, session.program.cursor
    node = graph[father].sons[branch]
    while True:
        graph[node].last_father = father
        if node == son:
            break
        father, node = node, graph[node].sons[0]
    session.program.put_cursor(son)


def previous_step(session: Session, given: Arguments) -> None:
    """P: move the cursor up by a number of steps, along the most recent fathers."""
    program = session.program
    for _ in range(_distance(given)):
        above = program.above(program.cursor)
        if above == TOP or program.cursor == TOP:
            session.desk.tell("this is the first step" if program.first != NONE else "the program is empty")
            return
        program.put_cursor(above)


def goto(session: Session, given: Arguments) -> None:
    """GOTO: make a named step the active step."""
    session.program.put_cursor(session.step(given.step or "").id)


def run(session: Session, given: Arguments) -> None:
    """RUN: execute the whole program, or a number of steps, forwards or backwards."""
    if given.count == 0:
        raise BadArgument(
            "RUN 0 would do nothing; RUN 1 executes the active step, RUN -1 undoes the last executed step"
        )
    if given.count is not None and given.count < 0:
        session.desk.tell(told_run(session.runner.back(-given.count), back=True))
        return
    if session.program.first == NONE:
        raise Refused("the program is empty; M teaches its first step")
    ran = session.runner.run() if given.count is None else session.runner.forward(given.count)
    session.desk.tell(told_run(ran))


def told_run(ran: RunResult, *, back: bool = False) -> str:
    """Say in words how a run ended."""
    steps = f"{counted(ran.steps, 'step')} {'undone' if back else 'done'}"
    if ran.obstacle is not None:
        return f"{steps}; the arm stopped while undoing the next earlier step: {told_obstacle(ran.obstacle)}"
    return {
        "count": steps,
        "none": f"{steps}; the program has ended",
        "halted": f"{steps}; stopped: RUN with a number continues, RUN with a negative number goes back",
        "beginning": f"{steps}; no earlier steps can be undone" if ran.steps else "there is nothing to undo",
        "forgotten": f"{steps}; earlier steps are no longer recorded",
        "deleted": f"{steps}; the next earlier step has been deleted and cannot be undone",
    }[ran.end]


def _distance(given: Arguments) -> int:
    count = 1 if given.count is None else given.count
    if not 0 < count <= _MAX_DISTANCE:
        raise BadArgument(f"N moves down and P moves up, each by 1 to {_MAX_DISTANCE} steps, not by {count}")
    return count


def write(session: Session, given: Arguments) -> None:
    """W: write the program to a file, by default to the last file that was read or written."""
    _check_files(session)
    file = session.file if given.file is None else trig_file(Path(given.file))
    if file is None:
        raise Refused("no file has been read or written yet; give W a name")
    check_place(file, TRIG_FILE)
    if file != session.file:
        check_new(file)
    write_program(file, session.program)
    session.file, session.program.changed = file, False
    session.desk.tell(f"written to {file}")


def read(session: Session, given: Arguments) -> None:
    """R: replace the program by a program from a file."""
    _check_files(session)
    file = trig_file(Path(given.file or ""))
    program = read_program(file)
    ask_if_unsaved(session, f"Read {file} instead")
    session.program, session.file, session.origin = program, file, None


def leave_written(session: Session, given: Arguments) -> None:
    """EX: write the program to its file, then leave."""
    write(session, given)
    session.over = True


def leave(session: Session, given: Arguments) -> None:
    """Q: leave without saving the program."""
    session.over = True


def _check_files(session: Session) -> None:
    if not session.files:
        raise Refused("the script of a job cannot read or write files")
