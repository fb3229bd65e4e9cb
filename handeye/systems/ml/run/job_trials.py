"""Defines the kinds of trials for the jobs in ML."""

from collections.abc import Mapping
from typing import Final

from handeye.trials.jobs import JobRow, job_sweep


class MlJobRow(JobRow, frozen=True, kw_only=True):
    """The trial of one world."""

    variant: str = ""


def _sentence(means: Mapping[str, float]) -> str:
    return (
        f"on average {means['statements']:.0f} statements and {means['motions']:.0f} motions in "
        f"{means['simulated_s']:.1f} s, with {means['force_events']:.0f} force events"
    )


FOLLOW_TRIALS: Final = job_sweep("follow", MlJobRow, _sentence)
BLOCKS_TRIALS: Final = job_sweep("blocks", MlJobRow, _sentence)
TRAIN_TRIALS: Final = job_sweep("train", MlJobRow, _sentence)
SUPPORT_TRIALS: Final = job_sweep("support", MlJobRow, _sentence)
ORIENT_TRIALS: Final = job_sweep("orient", MlJobRow, _sentence)
BIN_TRIALS: Final = job_sweep("bin", MlJobRow, _sentence)
TYPEWRITER_TRIALS: Final = job_sweep("typewriter", MlJobRow, _sentence)
