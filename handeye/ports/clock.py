"""Defines the clock of a cell. Only the clock lets time pass, and time passes for all devices together."""

import math
from abc import ABC, abstractmethod
from fractions import Fraction
from typing import Final

from handeye.core.errors import BadArgument

LONGEST: Final = 86400.0  # s that may pass at once: a day, far longer than any job
_ROUNDING: Final = 1e-6
"""Tolerated deviation of a period from a whole number of steps, as a fraction of a step. The tolerance allows for the
rounding of floating-point numbers.
"""
_DIGITS: Final = ".12g"  # digits of a period in a message, so that a user can type this period


class Clock(ABC):
    """A clock on which time passes only on request.

    Each call of `advance` lets an interval pass. During the interval, the last command to each device remains in
    effect. At the end of the interval, the devices take new readings.
    """

    @property
    @abstractmethod
    def now(self) -> float:
        """Seconds since the program began. Before the program begins, the clock shows the seconds since the cell was
        switched on.
        """

    @property
    def tick(self) -> Fraction | None:
        """The unit of time (s): waiting times are rounded up to a multiple of this unit. If the unit is None, the
        clock refuses any waiting time that is not a multiple of the physics step.
        """
        return None

    @property
    def next_event(self) -> Fraction | None:
        """Seconds until the next event, or None if no event will follow. An event counts only if tasks may wait for
        it, and if it happens without a command.
        """
        return None

    @abstractmethod
    def advance(self, seconds: float) -> None:
        """Let time pass. Raises InvalidInput unless `seconds` is one physics step or a whole multiple of it."""


def whole_steps(seconds: float, step: float) -> int:
    """Return the number of physics steps (of `step` s each) in a period (s). Raises InvalidInput if the number
    is not whole, or if the period is longer than `LONGEST` s.
    """
    if not (math.isfinite(seconds) and seconds > 0):
        raise BadArgument(
            f"the clock cannot advance by {seconds:g} s; the shortest period is {step:{_DIGITS}} s"
        )
    if seconds > LONGEST:
        raise BadArgument(
            f"the clock cannot advance by {seconds:g} s at once; the longest period is {LONGEST:g} s"
        )
    steps = round(seconds / step)
    if steps < 1 or abs(seconds / step - steps) > _ROUNDING:
        low = max(1, int(seconds / step))
        raise BadArgument(
            f"a period of {seconds:{_DIGITS}} s is not a whole number of physics steps of {step:{_DIGITS}} s; "
            f"use {low * step:{_DIGITS}} or {(low + 1) * step:{_DIGITS}}"
        )
    return steps
