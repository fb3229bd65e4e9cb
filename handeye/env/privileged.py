"""Shaped rewards. They are computed from the true state of the cell. Training with shaped rewards therefore gives a
policy more information than the sensors do. Episodes with shaped rewards are marked as privileged.
"""

from collections.abc import Callable

from handeye.core.units import MILLIMETRE
from handeye.env.jobs import Job
from handeye.results.judging import findings_so_far
from handeye.runs.runner import Runner

Potential = Callable[
    [Runner], float
]  # grows as the true state comes nearer to the goal; shaped rewards sum to its gain


def potential(job: Job) -> Potential | None:
    """Return the potential of a job's shaped reward, or None if the job has no shaped reward."""
    return _pin if job.task == "insertion" else None


def _pin(runner: Runner) -> float:
    """Return the depth of the pin below its seat, in units of 100 mm. The depth is negative while the
    pin is above its seat.
    """
    return -findings_so_far(runner)["seat"].value * MILLIMETRE / (100 * MILLIMETRE)
