"""The task of a MAL program on perfect motors."""

from typing import Final

from handeye.tasks.perfect_motors import PerfectMotors

MAL_TASK: Final = PerfectMotors("mal")
