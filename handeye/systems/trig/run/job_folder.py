"""What a taught job leaves in the folder of its run, besides what every run does: its account, program, and report."""

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
"""What came of a job, and its program."""
_LARGEST: Final = 1_000_000
"""Bytes: an account of twenty blocks takes ten thousand."""
_FARTHEST: Final = 1e6
"""mm and degrees: no block lies there."""


def job_files(done: JobReport, program: TrigProgram) -> dict[str, bytes]:
    """Those files, by name."""
    taught = encoded(program)
    return {
        JOB: msgspec.json.format(msgspec.json.encode(done), indent=1) + b"\n",
        TAUGHT: taught,
        REPORT: job_page(done, decoded(taught, TAUGHT)),  # as `kept_job_page` makes it
    }


def kept_job_page(path: Path) -> bytes | None:
    """The report of the job in a folder, made anew; None: the folder holds none that is over.

    Raises:
        InvalidInput: what is kept of it cannot be read.
    """
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
    if any(abs(figure) > _FARTHEST for figure in (*lying, *(x for goal in done.goals for x in goal))):
        raise BadFile(f"{path} is no account of a job: a block lies farther away than anything")
    return done
