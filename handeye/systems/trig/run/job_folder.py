"""Files of a taught job in its run's folder: account, program, and report."""

from pathlib import Path
from typing import Final

import msgspec

from handeye.core.errors import BadFile
from handeye.core.files import read_whole
from handeye.results.result import restore_figures
from handeye.runs.folder import REPORT
from handeye.systems.trig import ENTRY
from handeye.systems.trig.language.program import TrigProgram
from handeye.systems.trig.language.storage import decoded, encoded, read_program
from handeye.systems.trig.run.job import JobReport
from handeye.systems.trig.run.job_page import job_page

JOB, TAUGHT = ENTRY.files
"""The job's account, and its program."""
_LARGEST: Final = 1_000_000  # bytes: an account of twenty blocks takes ten thousand
_MAX_MEASURE: Final = 1e6  # mm and degrees


def job_files(done: JobReport, program: TrigProgram) -> dict[str, bytes]:
    """The files by name."""
    taught = encoded(program)
    return {
        JOB: msgspec.json.format(msgspec.json.encode(done), indent=1) + b"\n",
        TAUGHT: taught,
        REPORT: job_page(done, decoded(taught, TAUGHT)),  # as `kept_job_page` makes it
    }


def kept_job_page(path: Path) -> bytes | None:
    """The report of a folder's job, made anew; None if it holds no finished one."""
    if not (path / JOB).is_file():
        return None
    return job_page(_read_account(path / JOB), read_program(path / TAUGHT))


def _read_account(path: Path) -> JobReport:
    try:
        written = msgspec.json.decode(read_whole(path, _LARGEST))
        for name in ("checks", "checks_back") if isinstance(written, dict) else ():
            restore_figures(written.get(name))
        done = msgspec.convert(written, JobReport)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise BadFile(f"{path} is no account of a job: {error}") from None
    lying = [
        figure for blocks in done.lying.values() for each in blocks for figure in (*each.at, each.turned)
    ]
    if any(abs(figure) > _MAX_MEASURE for figure in (*lying, *(x for goal in done.goals for x in goal))):
        raise BadFile(f"{path} is no account of a job: a block lies farther away than anything")
    return done
