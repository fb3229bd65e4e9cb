"""Engines: what carries out many trials, each where it can."""

from collections.abc import Callable, Generator, Sequence

from handeye.trials.batch.row import Row
from handeye.trials.batch.trial import GRACE, Job, Trial
from handeye.trials.workers import Answer, answers

Engine = Callable[[Trial, Sequence[Job]], Generator[Answer[Job, Row], None, None]]
"""Carries out trials, in any order; a trial whose process is lost is tried once more."""


def processes(workers: int) -> Engine:
    """Processes on this computer, which are kept from trial to trial."""
    return lambda trial, jobs: answers(trial, jobs, workers, limit_s=trial.wall_limit_s * GRACE)
