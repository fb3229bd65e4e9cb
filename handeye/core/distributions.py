"""Distributions of quantities in which worlds differ. Figures are in the quantity's own unit."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np

TURN: Final = 360.0
"""Degrees."""


class Distribution(ABC):
    """Distribution of the values of a quantity."""

    __slots__ = ()
    name: ClassVar[str]
    is_error: ClassVar[bool] = True
    """It grows and shrinks with the level of errors; else it is what the job is for, or has no size."""

    @abstractmethod
    def draw(self, rng: np.random.Generator, nominal: float) -> float:
        """A value."""


@dataclass(frozen=True, slots=True)
class Normal(Distribution):
    """Normal about the nominal value, clipped at two sigma; `spread` is sigma."""

    name = "normal"
    spread: float

    def draw(self, rng: np.random.Generator, nominal: float) -> float:
        return nominal + self.spread * min(max(rng.standard_normal(), -2.0), 2.0)


@dataclass(frozen=True, slots=True)
class Uniform(Distribution):
    """Even about the nominal value; `spread` is half the range."""

    name = "uniform"
    spread: float

    def draw(self, rng: np.random.Generator, nominal: float) -> float:
        return nominal + self.spread * float(rng.uniform(-1.0, 1.0))


@dataclass(frozen=True, slots=True)
class Noise(Distribution):
    """Noise of a sensor, of the same sigma in every world of a level; the sigma is the value."""

    name = "noise"
    spread: float

    def draw(self, rng: np.random.Generator, nominal: float) -> float:
        return self.spread


@dataclass(frozen=True, slots=True)
class Fixed(Distribution):
    """An error that has the same size in every world of a level."""

    name = "fixed"
    spread: float

    def draw(self, rng: np.random.Generator, nominal: float) -> float:
        return self.spread


@dataclass(frozen=True, slots=True)
class Step(Distribution):
    """A step of a converter: the same in every world of every level, for the controller knows its bits."""

    name = "step"
    is_error = False
    spread: float

    def draw(self, rng: np.random.Generator, nominal: float) -> float:
        return self.spread


@dataclass(frozen=True, slots=True)
class Range(Distribution):
    """Even from `low` to `high`: what the job is for, and no error."""

    name = "range"
    is_error = False
    low: float
    high: float

    def draw(self, rng: np.random.Generator, nominal: float) -> float:
        return float(rng.uniform(self.low, self.high))


@dataclass(frozen=True, slots=True)
class Phase(Distribution):
    """Even over a whole turn."""

    name = "phase"
    is_error = False

    def draw(self, rng: np.random.Generator, nominal: float) -> float:
        return float(rng.uniform(0.0, TURN))
