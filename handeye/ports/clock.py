"""The clock of a cell: time passes only through it, for all devices at once."""

import math
from abc import ABC, abstractmethod
from fractions import Fraction
from typing import Final

from handeye.core.errors import BadArgument

LONGEST: Final = 86400.0  # s that may pass at once: a day, far longer than any job
_ROUNDING: Final = 1e-6
"""Tolerated deviation of a period from a whole number of steps, as a fraction of a step: rounding of floating-point
numbers.
"""
_DIGITS: Final = ".12g"  # digits of a period in a message, so that what is written there can be typed


class Clock(ABC):
    """A clock whose time passes only on request.

    While time passes, the last commands of all devices stay in force; new readings are taken at the end.
    """

    @property
    @abstractmethod
    def now(self) -> float:
        """Seconds since the program began; before that, since the cell was switched on."""

    @property
    def tick(self) -> Fraction | None:
        """The time unit, s, up to whose multiples all waiting times are rounded; None: times that are not multiples
        of the physics step are refused.
        """
        return None

    @property
    def next_event(self) -> Fraction | None:
        """Seconds until the next event that happens by itself and for which tasks may wait; None if there is none."""
        return None

    @abstractmethod
    def advance(self, seconds: float) -> None:
        """Let time pass; raises InvalidInput unless `seconds` is a whole number of physics steps, at least one."""


def whole_steps(seconds: float, step: float) -> int:
    """Number of physics steps (s each) in a period (s); raises InvalidInput unless it is whole and the period at
    most `LONGEST` s.
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
