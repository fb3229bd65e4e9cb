"""Defects of the lines between the devices of a cell and its controller, as values."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

Values = NDArray[Any]  # numbers, or the points of a picture

PICTURE: Final = "picture"  # the line of the camera's pictures


class Effect(ABC):
    """Effect of a defect on the values of a line: a number, or the points of a picture."""

    __slots__ = ()

    @abstractmethod
    def on(self, values: Values, first: Values, seconds: float) -> Values:
        """Values that arrive, SI, in place of those sent, `seconds` after it set in, when the line carried `first`."""


@dataclass(frozen=True, slots=True)
class Stuck(Effect):
    """The line keeps what it carried when the defect set in, or a value."""

    at: float | None = None

    def on(self, values: Values, first: Values, seconds: float) -> Values:
        return first if self.at is None else np.full_like(values, self.at)


@dataclass(frozen=True, slots=True)
class OffsetEffect(Effect):
    """Something is added."""

    by: float

    def on(self, values: Values, first: Values, seconds: float) -> Values:
        return np.asarray(values + self.by)


@dataclass(frozen=True, slots=True)
class DriftEffect(Effect):
    """More and more is added, `rate` a second."""

    rate: float

    def on(self, values: Values, first: Values, seconds: float) -> Values:
        return np.asarray(values + self.rate * seconds)


@dataclass(frozen=True, slots=True)
class SlipEffect(Effect):
    """Something is added that grows evenly to its full size within some seconds."""

    by: float
    seconds: float

    def on(self, values: Values, first: Values, seconds: float) -> Values:
        return np.asarray(values + self.by * min(1.0, seconds / self.seconds))


@dataclass(frozen=True, slots=True)
class PulseEffect(Effect):
    """Something is added for some seconds."""

    by: float
    seconds: float

    def on(self, values: Values, first: Values, seconds: float) -> Values:
        return np.asarray(values + self.by * (seconds <= self.seconds))


@dataclass(frozen=True, slots=True)
class GainEffect(Effect):
    """A share arrives, or a multiple."""

    by: float

    def on(self, values: Values, first: Values, seconds: float) -> Values:
        return np.asarray(values * self.by)


@dataclass(frozen=True, slots=True)
class DropoutEffect(Effect):
    """Nothing arrives for some seconds."""

    seconds: float

    def on(self, values: Values, first: Values, seconds: float) -> Values:
        return np.asarray(values * 0) if seconds < self.seconds else values


DEAD: Final = GainEffect(0.0)  # nothing arrives


@dataclass(frozen=True, slots=True, kw_only=True)
class Defect:
    """Something broken on a line."""

    line: str
    effect: Effect
    stage: int | None = None
    """Number of the stage with which it sets in, from 1; None: it is there when the cell is switched on."""
