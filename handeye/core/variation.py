"""Variation of the world: a task's table of quantities, and the worlds that are drawn from it.

A quantity is one number with a dotted name, such as `camera.place.x`; what stands before a dot names a group of them
(`camera.place`, `camera`). Each is drawn from a stream of its own, made from the seed and its name, so that a new
quantity moves no other, and one can be switched off or set while all others stay as they are.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Final, Literal
from zlib import crc32

import msgspec
import numpy as np

from handeye.core.diagnostics import quoted, suggestion
from handeye.core.distributions import Distribution
from handeye.core.errors import BadArgument, NoSuchName, Refused
from handeye.core.faults import Fault
from handeye.core.random_streams import random_numbers
from handeye.core.record import Record
from handeye.core.units import UNITS, Unit
from handeye.core.whole_numbers import whole

DRAWING: Final = 4
"""How a world comes from its seed: raised when equal seeds give other worlds than before."""

LARGEST_SEED: Final = (1 << 63) - 1
"""What is written to disk has 64 bits and a sign."""

Level = Literal["low", "nominal", "high"]
SPREADS: Final[dict[Level, float]] = {"low": 0.5, "nominal": 1.0, "high": 2.0}
"""Factors of the spread of every error."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Quantity:
    """One number in which worlds differ."""

    name: str
    unit: str
    """One of UNITS; that of all figures here."""
    distribution: Distribution
    nominal: float = 0.0
    """Its value where it is switched off."""
    limits: tuple[float, float] = (-np.inf, np.inf)
    """Range it can be set to."""
    source: str
    """Meaning, and source of its figures."""

    @property
    def measure(self) -> Unit:
        """Its unit, with its size."""
        return UNITS[self.unit]

    def check(self, value: float) -> None:
        """Make sure that it can be set to a value, SI."""
        low, high = (limit * self.measure.size for limit in self.limits)
        if type(value) not in (int, float) or not low <= value <= high:  # not a number is not between two
            raise BadArgument(
                f"{self.name} cannot be set to {value!r}: it can be {low:g} to {high:g} in SI units"
            )


class Overrides(Record, frozen=True, kw_only=True):
    """Overrides of a drawn world."""

    without: tuple[str, ...] = ()
    """Quantities and groups at their nominal values, in the order of their names."""
    set: dict[str, float] = msgspec.field(default_factory=dict)
    """Values of quantities, SI; where both speak of one, this counts."""


class WorldSpec(Record, frozen=True, kw_only=True):
    """All that a world is drawn from, as a run records it. Equal specifications give equal worlds."""

    seed: Annotated[int, msgspec.Meta(ge=0)]
    level: Level = "nominal"
    overrides: Overrides = Overrides()
    faults: tuple[Fault, ...] = ()
    """What is broken in it, in the order of their names."""
    drawing: int = DRAWING
    """How it is drawn: that of the handeye that drew it first."""

    def __str__(self) -> str:
        level = "" if self.level == "nominal" else f"level {self.level}"
        without = f"without {', '.join(self.overrides.without)}" if self.overrides.without else ""
        changed = f"{', '.join(self.overrides.set)} set" if self.overrides.set else ""
        broken = ", ".join(map(str, self.faults))
        return ", ".join(filter(None, (f"seed {self.seed}", level, without, changed, broken)))


@dataclass(frozen=True, slots=True, kw_only=True)
class World:
    """Values of the quantities of a task."""

    spec: WorldSpec
    values: Mapping[str, float]
    """By name, SI."""

    def __getitem__(self, name: str) -> float:
        return self.values[name]

    def numbered(self, group: str) -> tuple[float, ...]:
        """The values of `group.1`, `group.2` and so on, SI."""
        found: list[float] = []
        while (name := f"{group}.{len(found) + 1}") in self.values:
            found.append(self.values[name])
        return tuple(found)

    def generator(self, stream: str) -> np.random.Generator:
        """A source of noise; streams of different names are independent."""
        return random_numbers(self.spec.seed, stream)


class Variation:
    """The quantities in which the worlds of a task differ, in the order they are listed."""

    def __init__(self, *quantities: Quantity) -> None:
        self.quantities = {quantity.name: quantity for quantity in quantities}
        """By name."""
        assert len({crc32(name.encode()) for name in self.quantities}) == len(quantities), (
            "two share a stream"
        )
        assert not self.groups & self.quantities.keys(), "a name stands for a quantity and for a group"

    @cached_property
    def groups(self) -> frozenset[str]:
        """Names of groups of quantities."""
        parts = [name.split(".") for name in self.quantities]
        return frozenset(".".join(part[:n]) for part in parts for n in range(1, len(part)))

    def select(self, name: str) -> tuple[Quantity, ...]:
        """The quantity of a name, or those of a group."""
        found = tuple(q for q in self.quantities.values() if within(q.name, name))
        if not found:
            first = dict.fromkeys(known.split(".")[0] for known in self.quantities)
            near = suggestion(name, {*self.quantities, *self.groups})
            known = near or f"there are {', '.join(map(quoted, first))}"
            raise NoSuchName(f"the world has no quantity {quoted(name)}; {known}")
        return found

    def draw(self, spec: WorldSpec) -> World:
        """The world of a specification."""
        self.check(spec)
        return World(spec=spec, values={name: self.value(name, spec) for name in self.quantities})

    def value(self, name: str, spec: WorldSpec) -> float:
        """A single quantity of a world that can be drawn here, SI."""
        quantity = self.quantities[name]
        if name in spec.overrides.set:
            return spec.overrides.set[name]
        if any(within(name, group) for group in spec.overrides.without):
            return quantity.nominal * quantity.measure.size
        return drawn(quantity, spec.level, random_numbers(spec.seed, name))

    def check(self, spec: WorldSpec) -> None:
        """Make sure that a world is one that can be drawn here."""
        if spec.level not in SPREADS:
            raise NoSuchName(f"there is no level {spec.level!r}; there are {', '.join(SPREADS)}")
        if spec.drawing != DRAWING:
            raise Refused(
                f"the world of seed {spec.seed} was drawn by another handeye; this one draws another world from that "
                "seed, so begin the run again"
            )
        for name in spec.overrides.without:
            self.select(name)
        for name in spec.overrides.set:
            if name not in self.quantities:
                self.select(name)
                raise BadArgument(f"{quoted(name)} is a group of quantities, which cannot have one value")
            self.quantities[name].check(spec.overrides.set[name])


def within(name: str, group: str) -> bool:
    """A name is that of a group, or of what is in it."""
    return f"{name}.".startswith(f"{group}.")


def drawn(quantity: Quantity, level: Level, stream: np.random.Generator) -> float:
    """What a quantity is at a level of errors by its stream of a world, SI."""
    distribution, nominal = quantity.distribution, quantity.nominal
    value = distribution.draw(stream, nominal)
    if level != "nominal" and distribution.is_error:
        value = nominal + SPREADS[level] * (value - nominal)
    return value * quantity.measure.size


def checked_seed(seed: object) -> int:
    """A seed, as a plain number."""
    number = whole(seed)
    if number is None or number < 0:
        raise BadArgument(f"a seed is a whole number from 0 up; {seed!r} is not")
    if number > LARGEST_SEED:
        raise BadArgument(f"the largest seed is {LARGEST_SEED}; {seed} is larger")
    return number
