"""Folder of a taught job: its result, its program, and its report."""

from pathlib import Path
from typing import Final

import msgspec

from handeye.folders import FolderKind, write_folder
from handeye.report.job_page import job_page
from handeye.report.taught_job import JobReport
from handeye.tasks.benches import TaughtJob
from handeye.trig.storage import encoded

RESULT: Final = "result.json"
PROGRAM: Final = "program.trig.json"
PAGE: Final = "report.html"
JOB_FOLDER: Final = FolderKind(
    name="the result of a job", known_by=RESULT, begins=b'{\n "job"', holds=(RESULT, PROGRAM, PAGE)
)


def write_job(path: Path, done: JobReport, job: TaughtJob) -> None:
    """Write the folder of a job, whole or not at all."""
    result = msgspec.json.format(msgspec.json.encode(done), indent=1) + b"\n"
    program = job.session.program
    write_folder(path, {RESULT: result, PROGRAM: encoded(program), PAGE: job_page(done, program)})
