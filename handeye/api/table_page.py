"""The page of a table for notebooks: its first rows, and how many more there are."""

from math import isnan
from typing import Final

from handeye.api.html import heading, line, page, table
from handeye.core.plain_text import printable
from handeye.trace.table import Table

SHOWN: Final = 20
"""Rows; a slice of a table shows others."""
LETTERS: Final = 90
"""Of a text, at most."""


def table_page(found: Table) -> str:
    """The first rows; `table[100:110]` shows others."""
    columns = [column for column in found.columns if column.name != "data"]
    heads = [f"{each.name}, {each.unit}" if each.unit else each.name for each in columns]
    rows = zip(*(each.values[:SHOWN] for each in columns), strict=True)
    shown = table(heads, ([_cell(value) for value in row] for row in rows))
    rest = found.rows - SHOWN
    more = (
        (line(f"… and {rest} more; a slice, as table[{SHOWN}:{2 * SHOWN}], shows others"),)
        if rest > 0
        else ()
    )
    return page(heading(f"{found.name}: {found.about}"), shown, *more)


def _cell(value: str | float) -> str | None:
    if isinstance(value, str):
        text = printable(value)
        return text if len(text) <= LETTERS else text[: LETTERS - 1] + "…"
    return None if isnan(value) else f"{value:.6g}"
