"""Collects a recorded run: its trace, and the other files of its folder."""

from pathlib import Path

from handeye.core.errors import InvalidInput
from handeye.core.files import read_whole
from handeye.report.recorded import RecordedRun
from handeye.results.kept_run import kept_run
from handeye.results.result import Result
from handeye.runs.folder import PICTURES, RESULT
from handeye.tasks import known
from handeye.trace.trace import Trace


def recorded_run(run: Path, trace: Trace, *, whole: bool = True) -> RecordedRun:
    """Make a recorded run from its trace and the other files of its folder `run`."""
    result, remarks = _result(run)
    task = known(trace.head.task)
    views = () if task is None else task.photographs
    files = (run / PICTURES / f"end_{view}{ending}" for view in views[-1:] for ending in (".png", ".webp"))
    found = next(filter(Path.is_file, files), None)
    end = None if found is None else read_whole(found)
    return RecordedRun(trace=trace, whole=whole, result=result, end=end, remarks=remarks)


def _result(run: Path) -> tuple[Result | None, tuple[str, ...]]:
    """Return the result in the folder of a run, and the flaws of the result's file. The result is None if the folder
    has no usable result.
    """
    if not (run / RESULT).is_file():
        return None, ()
    try:
        kept = kept_run(run)
    except InvalidInput as fault:
        return None, (str(fault),)
    return (kept.result if kept.left else None), kept.faults
