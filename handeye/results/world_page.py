"""Writes a page for the terminal, or one JSON object, with the quantities of a world."""

from collections.abc import Iterator
from itertools import groupby
from textwrap import fill
from typing import Literal

import msgspec
from rich.console import Group, RenderableType
from rich.text import Text

from handeye.core.distributions import Choice, Fixed, Noise, Normal, Range, Step, Uniform
from handeye.core.resources import page
from handeye.core.variation import Quantity, Variation, World, WorldSpec


class QuantityReport(msgspec.Struct, frozen=True, kw_only=True):
    """A quantity of a world with its value. `si` is in SI units; all other figures are in `unit`."""

    name: str
    value: float
    unit: str
    si: float
    distribution: str
    spread: float | tuple[float, ...] | None
    """For an error: its size at the level of this world (sigma, half range or magnitude). For a range: the least and
    the greatest value. For a choice: the possible values.
    """
    nominal: float
    override: Literal["off", "set"] | None
    source: str  # description of the quantity's group, and origin of its size


class WorldReport(msgspec.Struct, frozen=True, kw_only=True):
    """All quantities of a world."""

    world: WorldSpec
    quantities: tuple[QuantityReport, ...]


def report(table: Variation, world: World) -> WorldReport:
    """Make the report on the quantities of a world, in the order of the table."""
    return WorldReport(world=world.spec, quantities=tuple(_reported(table, world)))


def world_json(table: Variation, world: World) -> bytes:
    """Return the quantities of a world as one JSON object."""
    return msgspec.json.format(msgspec.json.encode(report(table, world)), indent=1) + b"\n"


def world_page(table: Variation, world: World, columns: int) -> RenderableType:
    """Return the quantities of a world, grouped by source, as a page for a terminal that is `columns` wide."""
    found = report(table, world).quantities
    parts: list[RenderableType] = [Text(fill(f"The world of {world.spec}", columns), "bold")]
    if not found:
        parts.append(Text("Worlds of this task have no quantity that can be set."))
    width = min(max((len(quantity.name) for quantity in found), default=0), columns - 20)
    for source, quantities in groupby(found, lambda quantity: quantity.source):
        parts += [
            Text(),
            Text(fill(source, columns), "dim"),
            *(_row(quantity, width, columns) for quantity in quantities),
        ]
    if any("study" in quantity.source for quantity in found):
        parts += [Text(), Text(f"The studies: {page('studies.md')}", "dim")]
    return Group(*parts)


def _reported(table: Variation, world: World) -> Iterator[QuantityReport]:
    off = {q.name for name in world.spec.overrides.without for q in table.select(name)}
    for name, quantity in table.present(world.spec.overrides.set).items():
        given: Literal["off", "set"] | None = "off" if name in off else None
        yield QuantityReport(
            name=name,
            value=world[name] / quantity.measure.size,
            unit=quantity.unit,
            si=world[name],
            distribution=quantity.distribution.name,
            spread=_spread(quantity, table.factor(quantity, world.spec)),
            nominal=quantity.nominal,
            override="set" if name in world.spec.overrides.set else given,
            source=quantity.source + (f" No source: {quantity.unsourced}" if quantity.unsourced else ""),
        )


def _spread(quantity: Quantity, factor: float) -> float | tuple[float, ...] | None:
    match quantity.distribution:
        case Choice(values):
            return values
        case Range(low, high):
            return low, high
        case Step(spread):
            return spread
        case Normal(spread) | Uniform(spread) | Noise(spread) | Fixed(spread):
            return factor * spread
    return None


def _row(quantity: QuantityReport, width: int, columns: int) -> Text:
    """Return a quantity as one line of the page, or as two lines if the quantity does not fit on one line. Names are
    padded to `width` columns.
    """
    drawn = f"({how(quantity)})" if quantity.override else how(quantity)
    row = Text(f"  {quantity.name.ljust(width)} {quantity.value:10.4g} {quantity.unit:5}")
    told = (
        Text(" ")
        .append(quantity.override or "", "yellow")
        .append(" " * bool(quantity.override))
        .append(drawn)
    )
    return row.append("" if len(row) + len(told) <= columns else "\n     ").append(told)


def how(quantity: QuantityReport) -> str:
    """Describe the distribution of a quantity in words."""
    unit = quantity.unit and f" {quantity.unit}"
    nominal = f"{quantity.nominal:g}{unit}"
    mean, of = (f"mean {nominal}, ", f" of {nominal}") if quantity.nominal else ("", "")
    match quantity.spread:
        case tuple(values) if quantity.distribution == Choice.name:
            return " or ".join(f"{value:g}{unit}" for value in values)
        case (low, high):
            return f"{low:g} to {high:g}{unit}"
        case float(spread) if quantity.distribution == Normal.name:
            return f"{mean}sigma {spread:g}{unit}"
        case float(spread) if quantity.distribution == Uniform.name:
            return f"within {spread:g}{unit}{of}"
        case float(spread) if quantity.distribution == Noise.name:
            return f"noise, sigma {spread:g}{unit}"
        case float(spread):
            return f"always {spread:g}{unit}"
    return "any angle"
