"""The task of an ML program on perfect motors."""

from typing import Final

from handeye.tasks.perfect_motors import PerfectMotors

ML_TASK: Final = PerfectMotors("ml")
