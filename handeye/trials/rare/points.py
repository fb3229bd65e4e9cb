"""The worlds of a task as points: a standard normal number for each quantity that varies, and a seed for the noise."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from msgspec.structs import replace

from handeye.core.distributions import random_numbers
from handeye.core.pose import Array
from handeye.core.variation import Quantity, Variation, WorldSpec, within


@dataclass(frozen=True, slots=True, eq=False)
class Point:
    """A world: standard normal numbers, shape (n,), and the seed of its noise."""

    numbers: Array
    noise: int


class WorldSpace:
    """The quantities that vary between the worlds of a batch, and the standard normal numbers from which they are
    computed.
    """

    def __init__(self, variation: Variation, base: WorldSpec) -> None:
        """Make the space of the worlds that differ from `base` only in their seed. Raises InvalidInput if `variation`
        does not allow the world `base`, for example because a quantity does not exist.
        """
        variation.check(base)
        self._variation, self._base = variation, base
        there = variation.present(base.overrides.set)
        self._quantities = {name: each for name, each in there.items() if self._varies(each)}
        self.names = tuple(self._quantities)
        self._widest = np.array([each.distribution.widest for each in self._quantities.values()])

    def seeded(self, seed: int) -> Point:
        """Return the point of the world that a seed gives."""
        found = (
            each.distribution.standard(random_numbers(seed, name)) for name, each in self._quantities.items()
        )
        return Point(np.array([*found], dtype=float), seed)

    def world(self, point: Point) -> WorldSpec:
        """Return the world of a point. If a value would be beyond a limit of its quantity, it is set to the limit.
        This can happen because a user can scale errors by a factor of up to four.
        """
        values = {
            name: self._value(each, float(number))
            for (name, each), number in zip(self._quantities.items(), point.numbers, strict=True)
        }
        overrides = self._base.overrides
        overrides = replace(overrides, set=dict(sorted((values | overrides.set).items())))
        return replace(self._base, seed=point.noise, overrides=overrides)

    def deviations(self, numbers: Array) -> Array:
        """Return how far each quantity is from the middle of its range, in standard deviations, shape (n,). If a
        number would lead beyond the range, the quantity is at the end of the range.
        """
        return np.clip(numbers, -self._widest, self._widest)

    def distance(self, numbers: Array) -> float:
        """Return the distance (in standard deviations) between a world and the middle world, in which every quantity
        is in the middle of its range.
        """
        return float(np.linalg.norm(self.deviations(numbers)))

    def groups(self) -> list[list[int]]:
        """Return groups of quantities whose names have the same first part, the largest group first. The quantities
        are given by their numbers.
        """
        found: dict[str, list[int]] = {}
        for number, name in enumerate(self.names):
            found.setdefault(name.split(".")[0], []).append(number)
        return sorted(found.values(), key=len, reverse=True)

    def told(self, numbers: Array, only: Iterable[int]) -> Mapping[str, float]:
        """Return the deviations of the given quantities, by name, the greatest first."""
        away = self.deviations(numbers)
        ordered = sorted(only, key=lambda number: -abs(away[number]))
        return {self.names[number]: round(float(away[number]), 3) for number in ordered}

    def _varies(self, quantity: Quantity) -> bool:
        overrides = self._base.overrides
        if quantity.name in overrides.set or any(within(quantity.name, name) for name in overrides.without):
            return False
        if quantity.distribution.is_error and not self._variation.factor(quantity, self._base):
            return False
        return quantity.distribution.standard(np.random.default_rng(0)) is not None

    def _value(self, quantity: Quantity, number: float) -> float:
        """Return the value of a quantity, in SI units."""
        factor = self._variation.factor(quantity, self._base) if quantity.distribution.is_error else 1.0
        nominal = quantity.nominal
        away = factor * (quantity.distribution.at(number, nominal) - nominal)
        size = quantity.measure.size
        low, high = (limit * size for limit in quantity.limits)
        return min(max((nominal + away) * size, low), high)
