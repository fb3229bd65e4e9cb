"""Commands that read and write files, and end the session."""

from pathlib import Path

from handeye.core.errors import Refused
from handeye.systems.trig.language.change_commands import ask_if_unsaved
from handeye.systems.trig.language.given import Arguments
from handeye.systems.trig.language.session import Session
from handeye.systems.trig.language.storage import read_program, trig_file, write_program


def write(session: Session, given: Arguments) -> None:
    """W: write the program to a file; by default to the last one."""
    _check_files(session)
    file = session.file if given.file is None else trig_file(Path(given.file))
    if file is None:
        raise Refused("no file has been read or written yet; W takes a name")
    write_program(file, session.program)
    session.file, session.program.changed = file, False
    session.desk.tell(f"written to {file}")


def read(session: Session, given: Arguments) -> None:
    """R: replace the present program by one from a file."""
    _check_files(session)
    file = trig_file(Path(given.file or ""))
    program = read_program(file)
    ask_if_unsaved(session, f"Read {file} in its place")
    session.program, session.file, session.origin = program, file, None


def leave_written(session: Session, given: Arguments) -> None:
    """EX: write the program, then leave."""
    write(session, given)
    session.over = True


def leave(session: Session, given: Arguments) -> None:
    """Q: leave without saving."""
    session.over = True


def _check_files(session: Session) -> None:
    """Raise Refused if this session may not touch files."""
    if not session.files:
        raise Refused("the script of a job reads and writes no files")
