"""The file that a run's trace, or what there is of it, is read from."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from handeye.cli.common import note
from handeye.core.errors import BadFile, Refused

File = Annotated[Path, Parameter(help="A trace.mcap, an events.jsonl, or the folder of a run.")]
TraceFile = Annotated[Path, Parameter(help="A trace.mcap, or the folder of a run.")]


def trace_file(path: Path) -> Path:
    """The trace of a run's folder, or its event list; a file itself; raises InvalidInput if the run has not begun."""
    from handeye.runs.folder import EVENTS, TRACE, check_holds_run
    from handeye.trace.recorder import part

    if path.exists() and not path.is_dir():
        return path
    check_no_batch(path)
    check_holds_run(path)
    growing = part(path / TRACE)
    if growing.exists():  # newer than the whole one, which is of before the run was resumed
        note(f"the run in {path} was interrupted; this is what its trace holds")
        return growing
    if (path / TRACE).exists():
        return path / TRACE
    if not (path / EVENTS).exists():
        raise BadFile(f"the run in {path} has not begun")
    return path / EVENTS


def check_no_batch(folder: Path) -> None:
    """Raises InvalidInput if a folder is not a run's, but that of a batch of trials."""
    from handeye.trials.folder import TRIALS

    if (folder / TRIALS).is_file():
        raise BadFile(f"{folder} is the folder of a batch of trials, not of a run")


def motion_file(path: Path) -> Path:
    """The same, where it must say where things were; raises InvalidInput if there is only an event list."""
    file = trace_file(path)
    if file.suffix == ".jsonl":
        raise Refused(f"{file} is an event list, which does not say where things were; take the trace.mcap")
    return file
