"""The quantities that vary between worlds: a task's table of quantities, and the worlds generated from it.

A quantity is one number with a dotted name such as `camera.place.x`; the part of a name before each dot is the name of
a group (`camera.place`, `camera`). Each quantity is drawn from a separate random stream, made from the seed and the
quantity's name. Adding a quantity therefore changes no other quantity, and the user can switch off or set one quantity
while the others keep their values.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Final, Literal
from zlib import crc32

import msgspec
import numpy as np

from handeye.core.arguments import whole
from handeye.core.diagnostics import quoted, suggestion
from handeye.core.distributions import Choice, Distribution, random_numbers
from handeye.core.errors import BadArgument, NoSuchName, Refused
from handeye.core.faults import Fault
from handeye.core.plain_text import counted
from handeye.core.record import Record
from handeye.core.units import UNITS, Unit

DRAWING: Final = 4  # version of the rules that generate worlds; raised when a seed gives a different world

LARGEST_SEED: Final = (
    1 << 53
) - 1  # the largest that every JSON reader keeps exactly, even one whose numbers are doubles
Seed = Annotated[int, msgspec.Meta(ge=0, le=LARGEST_SEED)]
"""Number from which a world is generated. Neighbouring numbers give unrelated worlds."""

_LONG: Final = 10**40  # a number with more digits is not quoted in a message

_NAMED: Final = 8  # if more quantities than this are set, a message gives only their number

UNSOURCED: Final = "unsourced"
"""This key of `Overrides.scale` stands for all quantities whose size has no source."""

Level = Literal["low", "nominal", "high"]
SPREADS: Final[dict[Level, float]] = {"low": 0.5, "nominal": 1.0, "high": 2.0}  # factors on errors
LARGEST_SCALE: Final = 4.0
"""Greatest factor by which an error can be multiplied, including the factor of the level. With a greater factor,
friction could be negative.
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Quantity:
    """One number that varies between worlds."""

    name: str
    unit: str  # one of UNITS; the unit of all figures of the quantity
    distribution: Distribution
    nominal: float = 0.0  # its value when switched off
    limits: tuple[float, float] = (-np.inf, np.inf)  # range it can be set to
    where: tuple[str, float] | None = None
    """The choice on which the quantity depends: name and value (SI). Only worlds in which the choice has this value
    have the quantity. If `where` is None, all worlds have the quantity.
    """
    source: str  # meaning, and source of its figures
    unsourced: str = ""
    """Why the size of the quantity has no source, and what limits this size. Empty if the size has a source or needs
    none.
    """

    @property
    def measure(self) -> Unit:
        return UNITS[self.unit]

    def check(self, value: float) -> None:
        """Raise BadArgument unless the quantity can be set to `value` (SI)."""
        if isinstance(self.distribution, Choice):
            if type(value) not in (int, float) or value not in self.distribution.values:
                known = " or ".join(f"{each:g}" for each in self.distribution.values)
                told = f"{value:g}" if isinstance(value, float) else repr(value)
                raise BadArgument(f"{self.name} must be {known}, not {told}")
            return
        low, high = (limit * self.measure.size for limit in self.limits)
        if type(value) not in (int, float) or not low <= value <= high:  # also refuses NaN
            raise BadArgument(f"{self.name} must be between {low:g} and {high:g} in SI units, not {value!r}")


class Overrides(Record, frozen=True, kw_only=True):
    """Changes to a generated world: quantities left at their nominal values, quantities set to values, and scaled
    errors.
    """

    without: tuple[str, ...] = ()  # quantities and groups at nominal values, sorted
    set: dict[str, float] = msgspec.field(default_factory=dict)  # values, SI; take precedence over `without`
    scale: dict[str, float] = msgspec.field(default_factory=dict)
    """Factors that multiply errors, in addition to the factor of the level. Each key is the name of a quantity or
    group, or `UNSOURCED`. If several names cover an error, the most specific name applies.
    """


class WorldSpec(Record, frozen=True, kw_only=True):
    """The complete specification of a world, as recorded with a run. Equal specifications give equal worlds."""

    seed: Seed
    level: Level = "nominal"
    overrides: Overrides = Overrides()
    faults: tuple[Fault, ...] = ()  # sorted by name
    drawing: int = DRAWING  # version of these rules

    def __post_init__(self) -> None:
        """Raise BadArgument if the seed is out of range."""
        checked_seed(self.seed)

    def __str__(self) -> str:
        level = "" if self.level == "nominal" else f"level {self.level}"
        without = f"without {', '.join(self.overrides.without)}" if self.overrides.without else ""
        several = counted(len(self.overrides.set), "quantity")
        named = ", ".join(self.overrides.set) if len(self.overrides.set) <= _NAMED else several
        changed = f"{named} set" if named else ""
        scaled = ", ".join(f"{name} scaled by {factor:g}" for name, factor in self.overrides.scale.items())
        broken = ", ".join(map(str, self.faults))
        return ", ".join(filter(None, (f"seed {self.seed}", level, without, changed, scaled, broken)))


@dataclass(frozen=True, slots=True, kw_only=True)
class World:
    """The name and the value (SI) of each of a task's quantities."""

    spec: WorldSpec
    values: Mapping[str, float]

    def __getitem__(self, name: str) -> float:
        return self.values[name]

    def numbered(self, group: str) -> tuple[float, ...]:
        """Return the values (SI) of the quantities `GROUP.1`, `GROUP.2` and so on, where GROUP is the value of
        `group`.
        """
        found: list[float] = []
        while (name := f"{group}.{len(found) + 1}") in self.values:
            found.append(self.values[name])
        return tuple(found)

    def generator(self, stream: str) -> np.random.Generator:
        """Make a random number generator for noise. Generators of different streams are independent."""
        return random_numbers(self.spec.seed, stream)


class Variation:
    """The quantities that vary between the worlds of a task, in the order in which they are listed."""

    def __init__(self, *quantities: Quantity) -> None:
        self.quantities = {quantity.name: quantity for quantity in quantities}
        assert len({crc32(name.encode()) for name in self.quantities}) == len(quantities), (
            "two quantities share a random stream"
        )
        assert not self.groups & self.quantities.keys(), (
            "the same name is used for a quantity and for a group"
        )
        assert UNSOURCED not in {*self.groups, *self.quantities}, "a name is reserved"
        choices = {q.name for q in quantities if isinstance(q.distribution, Choice)}
        assert {q.where[0] for q in quantities if q.where} <= choices, (
            "a quantity depends on a choice that does not exist"
        )

    @cached_property
    def groups(self) -> frozenset[str]:
        parts = [name.split(".") for name in self.quantities]
        return frozenset(".".join(part[:n]) for part in parts for n in range(1, len(part)))

    def present(self, values: Mapping[str, float]) -> dict[str, Quantity]:
        """Return the quantities that exist in a world with the values `values` (SI). The keys are their names. Some
        quantities exist only if another quantity, a choice, has a certain value.
        """
        return {name: q for name, q in self.quantities.items() if self._is_there(q, values)}

    def _is_there(self, quantity: Quantity, values: Mapping[str, float]) -> bool:
        if quantity.where is None:
            return True
        choice, wanted = quantity.where
        return values.get(choice, self.quantities[choice].nominal) == wanted

    def select(self, name: str, values: Mapping[str, float] | None = None) -> tuple[Quantity, ...]:
        """Return the quantity called `name`, or all quantities in the group of that name. Raises NoSuchName if neither
        a quantity nor a group has that name.

        Args:
            values: values set in the world (SI). If a world with these values lacks a quantity, the result lacks this
                quantity too. If `values` is None, the quantities of all worlds are taken.
        """
        found = tuple(q for q in self.quantities.values() if within(q.name, name))
        there = [q for q in found if values is None or self._is_there(q, values)]
        if found and not there:
            assert found[0].where is not None
            choice, wanted = found[0].where
            raise NoSuchName(
                f"the world has the quantity {quoted(name)} only if {choice} is set to {wanted:g}"
            )
        if not found:
            first = dict.fromkeys(known.split(".")[0] for known in self.quantities)
            near = suggestion(name, {*self.quantities, *self.groups})
            known = near or f"choose from {', '.join(map(quoted, first))}"
            raise NoSuchName(f"the world has no quantity {quoted(name)}; {known}")
        return tuple(there)

    def draw(self, spec: WorldSpec) -> World:
        """Generate the world of a specification. Raises BadArgument if the specification names a quantity that does
        not exist, or gives a quantity a value that it cannot have.
        """
        self.check(spec)
        there = self.present(spec.overrides.set)
        return World(spec=spec, values={name: self.value(name, spec) for name in there})

    def value(self, name: str, spec: WorldSpec) -> float:
        """Draw the value of one quantity in a world, in SI units."""
        quantity = self.quantities[name]
        if name in spec.overrides.set:
            return spec.overrides.set[name]
        if any(within(name, group) for group in spec.overrides.without):
            return quantity.nominal * quantity.measure.size
        return drawn(quantity, self.factor(quantity, spec), random_numbers(spec.seed, name))

    def factor(self, quantity: Quantity, spec: WorldSpec) -> float:
        """Return the factor by which the level and the scales multiply the error of a quantity."""
        scale = spec.overrides.scale
        mine = [name for name in scale if name != UNSOURCED and within(quantity.name, name)]
        mine = mine or ([UNSOURCED] if quantity.unsourced and UNSOURCED in scale else [])
        return SPREADS[spec.level] * (scale[max(mine, key=len)] if mine else 1.0)

    def scalable(self, name: str) -> tuple[Quantity, ...]:
        """Return the quantities to which a scale called `name` applies. Raises BadArgument if the scale applies to no
        quantity.
        """
        those = self.quantities.values() if name == UNSOURCED else self.select(name)
        found = tuple(q for q in those if q.distribution.is_error and (name != UNSOURCED or q.unsourced))
        if not found:
            what = "no unsourced error" if name == UNSOURCED else f"no error in {quoted(name)}"
            raise BadArgument(f"there is nothing to scale: the world has {what}")
        return found

    def check(self, spec: WorldSpec) -> None:
        """Raise BadArgument if the task's quantities do not allow the world of a specification."""
        if spec.level not in SPREADS:
            raise NoSuchName(f"there is no level {spec.level!r}; the levels are {', '.join(SPREADS)}")
        if spec.drawing != DRAWING:
            raise Refused(
                f"the world of seed {spec.seed} comes from another version of handeye; this version makes a "
                "different world from that seed, so start the run again"
            )
        for name in spec.overrides.without:
            self.select(name, spec.overrides.set)
        for name in spec.overrides.set:
            self.select(name, spec.overrides.set)
            if name not in self.quantities:
                raise BadArgument(
                    f"{quoted(name)} is a group of quantities; set each quantity by its own name"
                )
            self.quantities[name].check(spec.overrides.set[name])
        most = LARGEST_SCALE / SPREADS[spec.level]
        for name, factor in spec.overrides.scale.items():
            self.scalable(name)
            if type(factor) not in (int, float) or not 0 <= factor <= most:  # also refuses NaN
                raise BadArgument(
                    f"{quoted(name)} cannot be scaled by {factor!r}; at the level {spec.level}, a factor must be "
                    f"between 0 and {most:g}"
                )


def within(name: str, group: str) -> bool:
    """Return True if `name` is the group itself or belongs to the group."""
    return f"{name}.".startswith(f"{group}.")


def drawn(quantity: Quantity, factor: float, stream: np.random.Generator) -> float:
    """Draw the value (SI) of a quantity from a stream, with its error multiplied by `factor`."""
    distribution, nominal = quantity.distribution, quantity.nominal
    value = distribution.draw(stream, nominal)
    if factor != 1 and distribution.is_error:
        value = nominal + factor * (value - nominal)
    return value * quantity.measure.size


def checked_seed(seed: object) -> int:
    """Check a seed and return it as a plain `int`. Raises BadArgument if the value is not a valid seed."""
    number = whole(seed)
    if number is None or not 0 <= number <= LARGEST_SEED:
        told = repr(seed) if number is None or abs(number) < _LONG else "a longer number"
        raise BadArgument(f"a seed must be a whole number from 0 to {LARGEST_SEED} (2^53 - 1), not {told}")
    return number
