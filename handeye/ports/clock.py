"""The clock of a cell: the only way to let time pass, for all of its devices at once."""

import math
from abc import ABC, abstractmethod
from fractions import Fraction
from typing import Final

from handeye.core.errors import BadArgument

LONGEST: Final = 86400.0  # s that may pass at once: a day, far longer than any job
_ROUNDING: Final = 1e-6
"""Share of a step by which a period may miss a whole number of steps: what floating-point numbers lose."""
_DIGITS: Final = ".12g"  # digits of a period in a message, so that what is written there can be typed


class Clock(ABC):
    """Time, which passes only when it is asked to.

    The last commands of the devices hold while time passes; their readings are taken again at its end.
    """

    @property
    @abstractmethod
    def now(self) -> float:
        """s since the program began; until then, since the cell was switched on."""

    @property
    def tick(self) -> Fraction | None:
        """The time, s, of which everything that passes is a multiple, where others are rounded up to it; None: they
        are refused."""
        return None

    @property
    def next_event(self) -> Fraction | None:
        """s until something happens by itself that tasks may wait for; None: nothing does."""
        return None

    @abstractmethod
    def advance(self, seconds: float) -> None:
        """Let time pass; raises InvalidInput unless it is a whole number of physics steps, one at least."""


def whole_steps(seconds: float, step: float) -> int:
    """Physics steps (s each) in a period (s); raises InvalidInput unless whole, from one to `LONGEST` s."""
    if not (math.isfinite(seconds) and seconds > 0):
        raise BadArgument(f"time cannot pass by {seconds:g} s; the shortest period is {step:{_DIGITS}} s")
    if seconds > LONGEST:
        raise BadArgument(f"time cannot pass by {seconds:g} s at once; the longest period is {LONGEST:g} s")
    steps = round(seconds / step)
    if steps < 1 or abs(seconds / step - steps) > _ROUNDING:
        low = max(1, int(seconds / step))
        raise BadArgument(
            f"a period of {seconds:{_DIGITS}} s is not a whole number of physics steps of {step:{_DIGITS}} s; "
            f"use {low * step:{_DIGITS}} or {(low + 1) * step:{_DIGITS}}"
        )
    return steps
