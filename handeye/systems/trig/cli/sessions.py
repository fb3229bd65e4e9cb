"""Opens TRIG sessions for the command line."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Final

from rich.status import Status
from rich.text import Text

from handeye.cli.common import note, notes
from handeye.core.host_time import HostTimer
from handeye.core.plain_text import counted, printable
from handeye.core.source import read_source
from handeye.systems.trig.jobs.benches import ArmName, new_session
from handeye.systems.trig.language.command_input import Script, type_script
from handeye.systems.trig.language.desk import Cancelled, Desk, Read
from handeye.systems.trig.language.session import Session
from handeye.systems.trig.language.storage import ENDING, read_program
from handeye.systems.trig.language.trig_arm import Halted

_REFRESH_S: Final = 0.1  # least time between updates of the progress line


def opened(arm: ArmName, file: Path | None, halted: Callable[[], bool]) -> Session:
    """Open a session with an arm. The program is empty, typed from a script, or read from a program file."""
    session = new_session(arm)
    if file is not None and file.name.endswith(ENDING):
        session.program, session.file = read_program(file), file
    elif file is not None:
        script = Script(read_source(file).text.splitlines(), halted=interrupting(halted))
        session.desk = script
        with notes.status(Text(f"typing {printable(str(file))}")):
            type_script(session, script, str(file))
    session.desk, session.over = Script((), note, halted), False
    return session


@contextmanager
def watched(session: Session, halted: Halted) -> Iterator[None]:
    """Within this context, show the progress of a running program at the terminal."""
    with watched_desk(session, halted) as desk:
        session.desk = desk
        yield


@contextmanager
def watched_desk(session: Session, halted: Halted) -> Iterator[Desk]:
    """Yield a user interface that shows progress at the terminal."""
    with notes.status("running") as status:
        yield _ProgressDesk(session, status, halted)


class PipedDesk(Script):
    """A user interface that reads its input from a pipe, and prints each question with its answer."""

    def answer(self, question: str) -> str:
        try:
            said = super().answer(question)
        except Cancelled:
            self.tell(question.strip())
            raise
        self.tell(f"{question.strip()} {said}")
        return said

    def ask(self, question: str, read: Callable[[str], Read]) -> Read:
        return read(self.answer(question))


class _ProgressDesk(Script):
    def __init__(self, session: Session, status: Status, halted: Halted) -> None:
        super().__init__((), note, halted)
        self._session, self._status = session, status
        self._since = HostTimer()

    def refresh(self) -> None:
        """Update the progress, but not often, because counting the executed steps takes time."""
        if self._since.wall_s < _REFRESH_S:
            return
        self._since = HostTimer()
        program = self._session.program
        steps = sum(program.graph[done.node].shown for done in program.trail if done.node in program.graph)
        active = program.active
        what = active.name or active.position or active.type
        self._status.update(
            f"running: {counted(steps, 'step')} done (not counting steps that were undone), now at {what}"
        )


def interrupting(halted: Callable[[], bool]) -> Halted:
    """Return the halt function of a session whose lines come from a script. After Ctrl-C, this function raises
    KeyboardInterrupt, which interrupts the whole script.
    """

    def ask() -> bool:
        if halted():
            raise KeyboardInterrupt
        return False

    return ask
