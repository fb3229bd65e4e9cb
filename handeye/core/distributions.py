"""Distributions of the quantities that vary between worlds, each in the unit of its quantity."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from math import inf
from statistics import NormalDist
from typing import ClassVar, Final
from zlib import crc32

import numpy as np

FULL_TURN_DEG: Final = 360.0
_NORMAL: Final = NormalDist()
_RAREST: Final = 1e-15  # Least distance of a probability from 0 and 1, whose normal numbers are infinite


class Distribution(ABC):
    """The distribution of a quantity."""

    __slots__ = ()
    name: ClassVar[str]
    is_error: ClassVar[bool] = True  # True: the level of errors scales it. False: it is a range of the task.
    widest: ClassVar[float] = inf  # Beyond this standard normal number, the value no longer changes

    @abstractmethod
    def draw(self, rng: np.random.Generator, nominal: float) -> float:
        """Draw a value; `nominal` is the value without error."""

    def standard(self, rng: np.random.Generator) -> float | None:
        """Draw a standard normal number. For this number, `at` returns the value that `draw` would return. Returns
        None if the value is the same in every world.
        """
        return None

    def at(self, number: float, nominal: float) -> float:
        """Convert a standard normal number to a value. If `number` is normally distributed, the value has this
        distribution. A number of 0 gives the middle of the distribution.
        """
        raise NotImplementedError


@dataclass(frozen=True, slots=True)
class Normal(Distribution):
    """Normal distribution about the nominal value, clipped at two sigma; `spread` is sigma."""

    name = "normal"
    widest = 2.0
    spread: float

    def draw(self, rng: np.random.Generator, nominal: float) -> float:
        return self.at(rng.standard_normal(), nominal)

    def standard(self, rng: np.random.Generator) -> float:
        return float(rng.standard_normal())

    def at(self, number: float, nominal: float) -> float:
        return nominal + self.spread * min(max(number, -self.widest), self.widest)


@dataclass(frozen=True, slots=True)
class Uniform(Distribution):
    """Uniform distribution about the nominal value; `spread` is half the range."""

    name = "uniform"
    spread: float

    def draw(self, rng: np.random.Generator, nominal: float) -> float:
        return nominal + self.spread * float(rng.uniform(-1.0, 1.0))

    def standard(self, rng: np.random.Generator) -> float:
        return _standard((float(rng.uniform(-1.0, 1.0)) + 1.0) / 2.0)

    def at(self, number: float, nominal: float) -> float:
        return nominal + self.spread * (2.0 * _NORMAL.cdf(number) - 1.0)


@dataclass(frozen=True, slots=True)
class _Constant(Distribution):
    """Base class of errors that have the same value in all worlds with the same error level."""

    spread: float

    def draw(self, rng: np.random.Generator, nominal: float) -> float:
        return self.spread


@dataclass(frozen=True, slots=True)
class Noise(_Constant):
    """Standard deviation of a sensor's noise. This deviation is the same in all worlds with the same error level."""

    name = "noise"


@dataclass(frozen=True, slots=True)
class Fixed(_Constant):
    """An error that has the same size in all worlds with the same error level."""

    name = "fixed"


@dataclass(frozen=True, slots=True)
class Step(_Constant):
    """Step of an analogue-to-digital converter. This step is the same in all worlds, whatever the error level."""

    name = "step"
    is_error = False


@dataclass(frozen=True, slots=True)
class Range(Distribution):
    """Uniform distribution from `low` to `high`. The quantity belongs to the task and is not an error, so the error
    level does not change its range.
    """

    name = "range"
    is_error = False
    low: float
    high: float

    def draw(self, rng: np.random.Generator, nominal: float) -> float:
        return float(rng.uniform(self.low, self.high))

    def standard(self, rng: np.random.Generator) -> float | None:
        return None if self.low == self.high else _standard(float(rng.uniform(0.0, 1.0)))

    def at(self, number: float, nominal: float) -> float:
        return self.low + (self.high - self.low) * _NORMAL.cdf(number)


@dataclass(frozen=True, slots=True)
class Phase(Distribution):
    """Uniform distribution over a full turn."""

    name = "phase"
    is_error = False

    def draw(self, rng: np.random.Generator, nominal: float) -> float:
        return float(rng.uniform(0.0, FULL_TURN_DEG))

    def standard(self, rng: np.random.Generator) -> float:
        return _standard(float(rng.uniform(0.0, 1.0)))

    def at(self, number: float, nominal: float) -> float:
        return FULL_TURN_DEG * _NORMAL.cdf(number)


@dataclass(frozen=True, slots=True)
class Choice(Distribution):
    """A choice that the task offers. The value is the nominal one, unless the user sets another of `values`. The value
    does not depend on the seed.
    """

    name = "choice"
    is_error = False
    values: tuple[float, ...]

    def draw(self, rng: np.random.Generator, nominal: float) -> float:
        return nominal


def _standard(probability: float) -> float:
    """Return the quantile of the standard normal distribution at `probability`."""
    return _NORMAL.inv_cdf(min(max(probability, _RAREST), 1.0 - _RAREST))


def random_numbers(seed: int, name: str) -> np.random.Generator:
    """Make the random number generator for the quantity or stream `name` in the world of `seed`."""
    return np.random.default_rng(np.random.SeedSequence([seed, crc32(name.encode())]))
