"""Parses the options that change a world: `--without`, `--set`, `--scale`, `--fault`."""

import re
from collections.abc import Callable, Iterable
from typing import Final, Protocol

import numpy as np

from handeye.core.diagnostics import quoted, suggestion
from handeye.core.errors import BadArgument
from handeye.core.faults import Catalogue, Fault, FaultKind
from handeye.core.units import UNITS, Unit, split_value, unit_named
from handeye.core.variation import Overrides, Variation, within


class WritableQuantity(Protocol):
    """A quantity whose value can be written with a unit."""

    @property
    def name(self) -> str:
        pass

    @property
    def unit(self) -> str:
        """Name of the quantity's unit."""

    @property
    def measure(self) -> Unit:
        """The quantity's unit."""

    @property
    def limits(self) -> tuple[float, float]:
        """Least and greatest value, in the quantity's unit."""


def overrides(
    variation: Variation, without: Iterable[str], settings: Iterable[str], scales: Iterable[str] = ()
) -> Overrides:
    """Make overrides from three lists: names of quantities to leave at their nominal values, settings
    `NAME=VALUE`, and scales `NAME=FACTOR`. If a name occurs twice, the later setting or scale applies.

    Raises BadArgument if a text cannot be used.
    """
    off, values = sorted(set(without)), dict[str, float]()
    names = [*off]
    for setting in settings:
        name, each = _setting(variation, setting)
        values |= each
        names.append(name)
    for name in names:
        variation.select(name, values)
    there = variation.present(values)
    widest = (name for name in off if not any(group != name and within(name, group) for group in off))
    factors = dict(_scale(variation, scale) for scale in scales)
    return Overrides(
        without=tuple(widest),
        set={name: values[name] for name in sorted(values) if name in there},
        scale=dict(sorted(factors.items())),
    )


def _scale(variation: Variation, text: str) -> tuple[str, float]:
    """Parse a scale. Returns two values: the name of a quantity or group, or `unsourced`; and the factor on the errors
    of the quantities with this name.
    """
    name, equals, factor = (part.strip() for part in text.partition("="))
    written = split_value(factor)
    if not equals or written is None or written[1]:
        raise BadArgument(f"{quoted(text)} is not a factor; write NAME=FACTOR")
    variation.scalable(name)
    return name, written[0]


def _setting(variation: Variation, text: str) -> tuple[str, dict[str, float]]:
    """Parse a setting. Returns the name of a quantity or group, and a value for each quantity with that name or in
    that group. The quantities are those that at least one world has.
    """
    name, equals, value = (part.strip() for part in text.partition("="))
    if not equals:
        raise BadArgument(f"{quoted(text)} is not a setting; write NAME=VALUE")
    values = {quantity.name: value_of(quantity, value) for quantity in variation.select(name)}
    for quantity_name, each in values.items():
        variation.quantities[quantity_name].check(each)
    return name, values


def value_of(quantity: WritableQuantity, text: str) -> float:
    """Parse the value of a quantity and return it in SI units. A number without a unit is in the unit of the
    quantity. Raises BadArgument if the text is not a possible value.
    """
    written = split_value(text)
    if written is None:
        raise BadArgument(f"{quantity.name} cannot be {quoted(text)}, which is not a number")
    number, word = written
    value = number * (_unit(quantity, word) if word else quantity.measure).size
    low, high = (limit * quantity.measure.size for limit in quantity.limits)
    if not (np.isfinite(value) and low <= value <= high):
        raise BadArgument(f"{quantity.name} cannot be {quoted(text)}{_limits(quantity)}")
    return value


def _unit(quantity: WritableQuantity, word: str) -> Unit:
    """Return the unit written after a number. Raises BadArgument if the unit does not fit the quantity."""
    unit, wanted = unit_named(word), quantity.measure.dimension
    if unit is None or unit.dimension != wanted:
        known = [name for name, other in UNITS.items() if name and other.dimension == wanted]
        near = suggestion(word, known) or f"known: {', '.join(map(quoted, sorted(known)))}"
        raise BadArgument(f"{quantity.name} is not measured in {quoted(word)}; {near}")
    return unit


def _limits(quantity: WritableQuantity) -> str:
    (low, high), unit = quantity.limits, quantity.unit and f" {quantity.unit}"
    if np.isinf(high):
        return "" if np.isinf(low) else f"; it must be at least {low:g}{unit}"
    return f"; it must be between {low:g} and {high:g}{unit}"


_SECONDS: Final = re.compile(r"(\d{1,6}(?:\.\d{1,3})?|\.\d{1,3}) ?s")  # when a fault begins, such as `30s`
StageNumber = Callable[[str], int]  # returns the number, from 1, of a stage as written; raises NoSuchName


def faults(catalogue: Catalogue, texts: Iterable[str], stage: StageNumber) -> tuple[Fault, ...]:
    """Parse faults from options and sort them by name. Raises BadArgument if a fault is given twice, or if a name,
    value or stage is unknown.
    """
    found = tuple(sorted((_fault(catalogue, text, stage) for text in texts), key=lambda fault: fault.name))
    catalogue.check(found)
    return found


def _fault(catalogue: Catalogue, text: str, stage: StageNumber) -> Fault:
    what, at, where = text.partition("@")
    name, equals, value = (part.strip() for part in what.partition("="))
    where = where.strip().strip('"').strip()
    if not name or (at and not where) or (equals and not value):
        raise BadArgument(f"{quoted(text)} is not a fault; write NAME, NAME=VALUE, NAME@STAGE or NAME@30s")
    kind = catalogue.kind(name)
    if time := _SECONDS.fullmatch(where):
        return Fault(name=name, value=_value(kind, value), after=float(time[1]))
    return Fault(name=name, value=_value(kind, value), stage=stage(where) if at else kind.usual_stage)


def _value(kind: FaultKind, text: str) -> float | None:
    if not text:
        return kind.usual().value
    if kind.size is None:
        raise BadArgument(f"the fault {quoted(kind.name)} takes no value; leave out {quoted(f'={text}')}")
    return value_of(kind, text)


def by_number(text: str) -> int:
    """Parse the number of a stage, counted from 1. Callers use this function if they do not know the names of the
    stages.
    """
    if not (text.isascii() and text.isdigit() and len(text) < 10 and int(text) > 0):
        raise BadArgument(f"{quoted(text)} is not the number of a stage; stages are numbered from 1")
    return int(text)


def from_start_only(text: str) -> int:
    """Refuse a stage given with a fault (the part after `@`), because the command has no stages."""
    raise BadArgument(
        f"this command has no stages; leave out {quoted(f'@{text}')}, or write a time such as `@30s` if the fault can "
        "begin after a time"
    )
