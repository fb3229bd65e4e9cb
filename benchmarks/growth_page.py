"""Shows how costs grow, as a page for the terminal."""

from collections.abc import Sequence
from typing import Final

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from benchmarks.growth import LINEAR, Growth

_UNITS: Final = {"cpu_s": "CPU s", "mib": "MiB"}


def page(growths: Sequence[Growth]) -> RenderableType:
    """Return the page: one table for statements and one for cells. For statements, the cost of each is below the cost
    of all.
    """
    counted = dict.fromkeys(growth.of for growth in growths)
    tables = [_table(of, [growth for growth in growths if growth.of == of]) for of in counted]
    rule = (
        "power: the cost grows with this power of the size, fitted over the last two powers of ten; "
        f"up to {LINEAR} counts as linear"
    )
    return Group(*(part for table in tables for part in (table, Text())), Text(rule, style="dim"))


def _table(of: str, growths: Sequence[Growth]) -> Table:
    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column(of)
    for size in growths[0].sizes:
        table.add_column(f"{size:,}", justify="right", no_wrap=True)
    table.add_column("power", justify="right")
    for growth in growths:
        power = Text(f"{growth.power:.2f}", "" if growth.is_linear else "red")
        table.add_row(f"{growth.what}, {_UNITS[growth.unit]}", *map(figure, growth.values), power)
        if growth.unit == "cpu_s" and growth.of == "statements":
            each = (value / size * 1e6 for value, size in zip(growth.values, growth.sizes, strict=True))
            table.add_row(Text("  µs each", "dim"), *(Text(f"{cost:,.0f}", "dim") for cost in each))
    return table


def figure(value: float) -> str:
    """Return a number with a suitable number of decimals."""
    return f"{value:,.0f}" if value >= 100 else f"{value:.2f}" if value >= 1 else f"{value:.4f}"
