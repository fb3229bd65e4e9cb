"""Finds the file from which the trace of a run can be read."""

from pathlib import Path
from typing import Annotated, Final

from cyclopts import Parameter

from handeye.cli.common import note
from handeye.core.errors import BadFile, Refused

_NEWEST: Final = "by default the newest run in the folder `runs`."
Run = Annotated[Path | None, Parameter(name="RUN", help=f"The folder of a run; {_NEWEST}")]
RunOrCheckpoint = Annotated[
    Path | None, Parameter(name="RUN", help=f"The folder of a run, or a checkpoint; {_NEWEST}")
]
RunOrTrace = Annotated[
    Path | None, Parameter(name="RUN", help=f"The folder of a run, or its trace.mcap; {_NEWEST}")
]
RunOrEvents = Annotated[
    Path | None,
    Parameter(name="RUN", help=f"The folder of a run, its trace.mcap or its events.jsonl; {_NEWEST}"),
]


def run_or_newest(given: Path | None) -> Path:
    """The given run. If no run is given, the newest run, which a printed note names; raises InvalidInput if there is
    no run.
    """
    if given is not None:
        return given
    from handeye.runs.unnamed_runs import newest_runs

    (newest,) = newest_runs(1)
    note(f"using the newest run, {newest}")
    return newest


def two_runs(a: Path | None, b: Path | None) -> tuple[Path, Path]:
    """Two runs to compare. A single given run is compared with the newest run. If no run is given, the two newest runs
    are compared.
    """
    from handeye.runs.unnamed_runs import newest_runs

    if a is not None and b is not None:
        return a, b
    if a is None:
        newer, older = newest_runs(2)
        note(f"using the newest two runs, {older} and {newer}")
        return older, newer
    return a, run_or_newest(None)


def trace_file(path: Path) -> Path:
    """Return `path` itself if it is a file. If `path` is the folder of a run, return the path of the run's trace or, if
    there is no trace, of its event list. Raises InvalidInput if the run has not begun.
    """
    from handeye.runs.folder import EVENTS, TRACE, check_holds_run
    from handeye.trace.recorder import part

    if path.exists() and not path.is_dir():
        return path
    check_holds_run(path)
    growing = part(path / TRACE)
    if growing.exists():  # newer than the complete trace, which was written before the run was resumed
        note(f"the run in {path} was interrupted; this is its trace so far")
        return growing
    if (path / TRACE).exists():
        return path / TRACE
    if not (path / EVENTS).exists():
        raise BadFile(f"the run in {path} has not begun")
    return path / EVENTS


def motion_file(path: Path) -> Path:
    """Return the path that `trace_file` returns, for a caller that needs the recorded positions. Raises InvalidInput
    if the file is only an event list.
    """
    file = trace_file(path)
    if file.suffix == ".jsonl":
        raise Refused(f"{file} is an event list, which holds no positions; use the trace.mcap")
    return file
