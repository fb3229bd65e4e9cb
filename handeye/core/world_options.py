"""Parsing of world options from the words typed."""

from collections.abc import Iterable
from typing import Protocol

import numpy as np

from handeye.core.diagnostics import quoted, suggestion
from handeye.core.errors import BadArgument
from handeye.core.units import UNITS, Unit, split_value, unit_named
from handeye.core.variation import Overrides, Variation, within


class Measured(Protocol):
    """Something with a name whose value can be written with a unit."""

    @property
    def name(self) -> str:
        """Its name."""

    @property
    def unit(self) -> str:
        """The name of its own unit."""

    @property
    def measure(self) -> Unit:
        """That unit, with its size."""

    @property
    def limits(self) -> tuple[float, float]:
        """Its least and its greatest value, in its own unit."""


def overrides(variation: Variation, without: Iterable[str], settings: Iterable[str]) -> Overrides:
    """Overrides of a world from its options.

    Args:
        without: names of quantities and groups that are to have their nominal values.
        settings: `NAME=VALUE` each, for a quantity or for each of a group; of two for one quantity, the later.
    """
    off = sorted(set(without))
    for name in off:
        variation.select(name)
    widest = (name for name in off if not any(group != name and within(name, group) for group in off))
    values: dict[str, float] = {}
    for setting in settings:
        values |= _setting(variation, setting)
    return Overrides(without=tuple(widest), set=dict(sorted(values.items())))


def _setting(variation: Variation, text: str) -> dict[str, float]:
    """The values (SI) that `NAME=VALUE` gives to quantities."""
    name, equals, value = (part.strip() for part in text.partition("="))
    if not equals:
        raise BadArgument(f"{quoted(text)} sets nothing; write NAME=VALUE")
    return {quantity.name: value_of(quantity, value) for quantity in variation.select(name)}


def value_of(quantity: Measured, text: str) -> float:
    """A value of a quantity as written, SI; without a unit it is in the quantity's own."""
    written = split_value(text)
    if written is None:
        raise BadArgument(f"{quantity.name} cannot be {quoted(text)}, which is not a number")
    number, word = written
    value = number * (_unit(quantity, word) if word else quantity.measure).size
    low, high = (limit * quantity.measure.size for limit in quantity.limits)
    if not (np.isfinite(value) and low <= value <= high):
        raise BadArgument(f"{quantity.name} cannot be {quoted(text)}{_limits(quantity)}")
    return value


def _unit(quantity: Measured, word: str) -> Unit:
    """The unit of a word behind a number. Raises InvalidInput if the quantity is not measured in it."""
    unit, wanted = unit_named(word), quantity.measure.dimension
    if unit is None or unit.dimension != wanted:
        known = [name for name, other in UNITS.items() if name and other.dimension == wanted]
        near = suggestion(word, known) or f"known: {', '.join(map(quoted, sorted(known)))}"
        raise BadArgument(f"{quantity.name} is not measured in {quoted(word)}; {near}")
    return unit


def _limits(quantity: Measured) -> str:
    """The least and the greatest value of a quantity, as the end of a sentence."""
    (low, high), unit = quantity.limits, quantity.unit and f" {quantity.unit}"
    if np.isinf(high):
        return "" if np.isinf(low) else f"; {low:g}{unit} is the least"
    return f"; it can be {low:g} to {high:g}{unit}"
