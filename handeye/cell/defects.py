"""Defects of the signal lines between devices and controller, as values."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

Values = NDArray[Any]  # numbers, or the points of a picture

PICTURE: Final = "picture"  # the line of the camera's pictures


class Effect(ABC):
    """Effect of a defect on the values that a line carries. The values are numbers, or the points of a picture."""

    __slots__ = ()

    @abstractmethod
    def on(self, values: Values, first: Values, seconds: float) -> Values:
        """Return the values (SI) that arrive instead of the values sent, `seconds` after the defect began. `first` is
        the value that the line carried when the defect began.
        """


@dataclass(frozen=True, slots=True)
class Stuck(Effect):
    """The line keeps the value that it carried when the defect began, or a given value."""

    at: float | None = None

    def on(self, values: Values, first: Values, seconds: float) -> Values:
        return first if self.at is None else np.full_like(values, self.at)


@dataclass(frozen=True, slots=True)
class OffsetEffect(Effect):
    """A constant is added to the values."""

    by: float

    def on(self, values: Values, first: Values, seconds: float) -> Values:
        return np.asarray(values + self.by)


@dataclass(frozen=True, slots=True)
class DriftEffect(Effect):
    """An amount is added to the values. The amount grows by `rate` per second."""

    rate: float

    def on(self, values: Values, first: Values, seconds: float) -> Values:
        return np.asarray(values + self.rate * seconds)


@dataclass(frozen=True, slots=True)
class SlipEffect(Effect):
    """An amount is added to the values. The amount grows evenly to its full size within some seconds."""

    by: float
    seconds: float

    def on(self, values: Values, first: Values, seconds: float) -> Values:
        return np.asarray(values + self.by * min(1.0, seconds / self.seconds))


@dataclass(frozen=True, slots=True)
class PulseEffect(Effect):
    """An amount is added to the values for some seconds."""

    by: float
    seconds: float

    def on(self, values: Values, first: Values, seconds: float) -> Values:
        return np.asarray(values + self.by * (seconds <= self.seconds))


@dataclass(frozen=True, slots=True)
class GainEffect(Effect):
    """The values are multiplied by a factor."""

    by: float

    def on(self, values: Values, first: Values, seconds: float) -> Values:
        return np.asarray(values * self.by)


@dataclass(frozen=True, slots=True)
class DropoutEffect(Effect):
    """No values arrive for some seconds."""

    seconds: float

    def on(self, values: Values, first: Values, seconds: float) -> Values:
        return np.asarray(values * 0) if seconds < self.seconds else values


DEAD: Final = GainEffect(0.0)  # nothing arrives


@dataclass(frozen=True, slots=True, kw_only=True)
class Defect:
    """A defect on a line."""

    line: str
    effect: Effect
    stage: int | None = None
    """Number of the stage, from 1, with which the defect begins. None if the defect is present when the cell is
    switched on.
    """
