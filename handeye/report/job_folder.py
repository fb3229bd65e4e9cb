"""What a taught job leaves in the folder of its run, besides what every run does: its account, program, and report."""

from pathlib import Path

import msgspec

from handeye.files import write_whole
from handeye.report.job_page import job_page
from handeye.report.taught_job import JobReport
from handeye.runs.folder import JOB, REPORT, TAUGHT
from handeye.trig.program import TrigProgram
from handeye.trig.storage import encoded


def write_job(path: Path, done: JobReport, program: TrigProgram) -> None:
    """Write them, each whole or not at all.

    Raises:
        InvalidInput: the folder cannot be written to.
    """
    write_whole(path / JOB, msgspec.json.format(msgspec.json.encode(done), indent=1) + b"\n")
    write_whole(path / TAUGHT, encoded(program))
    write_whole(path / REPORT, job_page(done, program))
