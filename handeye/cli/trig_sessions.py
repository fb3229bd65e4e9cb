"""Sessions of TRIG as the command line opens them: with an arm, and what a file brings."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Literal

from rich.status import Status

from handeye.cli.common import note, notes
from handeye.plain_text import printable
from handeye.source import read_source
from handeye.tasks.benches import open_bench
from handeye.trig.no_arm import NoArm
from handeye.trig.script import Script, type_script
from handeye.trig.session import Session
from handeye.trig.storage import ENDING, read_program
from handeye.trig.teachable import Halted

ArmName = Literal["none", "purbrick"]


def opened(arm: ArmName, file: Path | None, halted: Callable[[], bool]) -> Session:
    """A session with an arm: a new one, or one in which a script has been typed, or a program read.

    Raises:
        InvalidInput: the file cannot be used.
        KeyboardInterrupt: somebody wanted to stop while a script was typed.
    """
    session = _new(arm)
    if file is not None and file.name.endswith(ENDING):
        session.program, session.file = read_program(file), file
    elif file is not None:
        script = Script(read_source(file).text.splitlines(), halted=_interrupting(halted))
        session.desk = script
        with notes.status(f"typing {printable(str(file))}"):
            type_script(session, script, str(file))
    session.desk, session.over = Script((), note, halted), False
    return session


def _new(name: ArmName) -> Session:
    if name == "none":
        imagined = NoArm()
        return Session(arm=imagined, table=imagined, desk=Script(()))
    arm, table = open_bench(name)
    return Session(arm=arm, table=table, desk=Script(()))


@contextmanager
def watched(session: Session, halted: Halted) -> Iterator[None]:
    """While a program runs, show at a terminal how far it is: an arm with physics takes its time."""
    with notes.status("running") as status:
        session.desk = _Watched(session, status, halted)
        yield


class _Watched(Script):
    """A desk that shows where a run is."""

    def __init__(self, session: Session, status: Status, halted: Halted) -> None:
        super().__init__((), note, halted)
        self._session, self._status = session, status

    def refresh(self) -> None:
        active = self._session.program.active
        self._status.update(f"running: {active.name or active.position or active.type}")


def _interrupting(halted: Callable[[], bool]) -> Halted:
    """Asked while a script is typed, where nobody could say how to go on: to halt is to interrupt."""

    def ask() -> bool:
        if halted():
            raise KeyboardInterrupt
        return False

    return ask
