"""The watchdog of an arm: it waits a servo period for a new torque, and no longer."""

from dataclasses import dataclass
from typing import Final

_LATE: Final = 1e-6
"""Share of a period that counts as none: what floating-point numbers lose."""


@dataclass(slots=True)
class Watchdog:
    """Cuts the drives of an arm whose computer does not answer, until the program sets the brakes itself."""

    period: float
    """s"""
    tripped: bool = False
    unanswered: float = 0.0
    """s since the arm was driven."""

    def answer(self, *, braked: bool) -> None:
        """The computer has put something out; brakes acknowledge that a period was missed."""
        self.unanswered = 0.0
        self.tripped = self.tripped and not braked

    def wait(self, seconds: float) -> None:
        """Time (s) is about to pass in which the drives hold what was put out last; too much of it trips at once."""
        self.unanswered += seconds
        self.tripped = self.tripped or self.unanswered > self.period * (1 + _LATE)
