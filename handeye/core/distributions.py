"""Distributions of the quantities that vary between worlds, each in the unit of its quantity."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar, Final
from zlib import crc32

import numpy as np

FULL_TURN_DEG: Final = 360.0


class Distribution(ABC):
    """The distribution of a quantity."""

    __slots__ = ()
    name: ClassVar[str]
    is_error: ClassVar[bool] = True  # scaled by the level of errors; False for the task's own range

    @abstractmethod
    def draw(self, rng: np.random.Generator, nominal: float) -> float:
        """Draw a value; `nominal` is the value without error."""


@dataclass(frozen=True, slots=True)
class Normal(Distribution):
    """Normal distribution about the nominal value, clipped at two sigma; `spread` is sigma."""

    name = "normal"
    spread: float

    def draw(self, rng: np.random.Generator, nominal: float) -> float:
        return nominal + self.spread * min(max(rng.standard_normal(), -2.0), 2.0)


@dataclass(frozen=True, slots=True)
class Uniform(Distribution):
    """Uniform distribution about the nominal value; `spread` is half the range."""

    name = "uniform"
    spread: float

    def draw(self, rng: np.random.Generator, nominal: float) -> float:
        return nominal + self.spread * float(rng.uniform(-1.0, 1.0))


@dataclass(frozen=True, slots=True)
class _Constant(Distribution):
    """Base class of errors that have the same value in every world of a level."""

    spread: float

    def draw(self, rng: np.random.Generator, nominal: float) -> float:
        return self.spread


@dataclass(frozen=True, slots=True)
class Noise(_Constant):
    """Standard deviation of a sensor's noise, the same in every world of a level."""

    name = "noise"


@dataclass(frozen=True, slots=True)
class Fixed(_Constant):
    """An error of the same size in every world of a level."""

    name = "fixed"


@dataclass(frozen=True, slots=True)
class Step(_Constant):
    """Step of an analogue-to-digital converter, the same in every world at every level."""

    name = "step"
    is_error = False


@dataclass(frozen=True, slots=True)
class Range(Distribution):
    """Uniform distribution from `low` to `high`. The quantity belongs to the task and is not an error, so the level
    does not change it.
    """

    name = "range"
    is_error = False
    low: float
    high: float

    def draw(self, rng: np.random.Generator, nominal: float) -> float:
        return float(rng.uniform(self.low, self.high))


@dataclass(frozen=True, slots=True)
class Phase(Distribution):
    """Uniform distribution over a full turn."""

    name = "phase"
    is_error = False

    def draw(self, rng: np.random.Generator, nominal: float) -> float:
        return float(rng.uniform(0.0, FULL_TURN_DEG))


@dataclass(frozen=True, slots=True)
class Choice(Distribution):
    """A choice within the task. The value is nominal unless the user sets it to another of `values`; no seed
    changes it.
    """

    name = "choice"
    is_error = False
    values: tuple[float, ...]

    def draw(self, rng: np.random.Generator, nominal: float) -> float:
        return nominal


def random_numbers(seed: int, name: str) -> np.random.Generator:
    """Make the random number generator for the quantity or stream `name` in the world of `seed`."""
    return np.random.default_rng(np.random.SeedSequence([seed, crc32(name.encode())]))
