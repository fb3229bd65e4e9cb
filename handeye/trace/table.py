"""A table of named columns with units, which displays itself and converts to a DataFrame."""

from dataclasses import dataclass, replace
from math import isnan
from typing import Any, Final, overload

import numpy as np
from numpy.typing import NDArray

from handeye.core.brief import Brief
from handeye.core.errors import NoSuchName, Refused
from handeye.core.notebook import heading, line, page, table
from handeye.core.plain_text import counted, printable

SHOWN_ROWS: Final = 20
MAX_CELL_CHARS: Final = 90
Values = NDArray[np.float64] | NDArray[np.int64] | tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False, repr=False)
class Column(Brief):
    """A column of a table."""

    name: str
    about: str
    unit: str = ""  # SI; empty: none
    values: Values  # one for each row; NaN or an empty text: there is none


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Table:
    """A table of data. Each column is an array, or a tuple of texts.

    >>> events = handeye.open(handeye.demo).table("events")
    >>> events["event"][0], len(events[10:20])
    ('RunStarted', 10)
    """

    name: str
    about: str
    columns: tuple[Column, ...]

    @property
    def rows(self) -> int:
        """Number of rows."""
        return len(self.columns[0].values)

    def __len__(self) -> int:
        return self.rows

    @overload
    def __getitem__(self, which: str) -> Values: ...
    @overload
    def __getitem__(self, which: slice) -> "Table": ...
    def __getitem__(self, which: str | slice) -> "Values | Table":
        if isinstance(which, slice):
            return replace(self, columns=tuple(replace(c, values=c.values[which]) for c in self.columns))
        found = {column.name: column.values for column in self.columns}
        if which not in found:
            raise NoSuchName(
                f"there is no column {which!r} in the table {self.name}; the columns are {', '.join(found)}"
            )
        return found[which]

    def to_pandas(self) -> Any:
        """Convert the table to a pandas DataFrame, with the same columns.

        Raises:
            InvalidInput: pandas is not installed.
        """
        try:
            import pandas
        except ImportError:
            raise Refused("to_pandas() needs pandas, which is not installed: `pip install pandas`") from None
        return pandas.DataFrame({column.name: column.values for column in self.columns})

    def __repr__(self) -> str:
        return (
            f"<Table {self.name}: {counted(self.rows, 'row')} of {', '.join(c.name for c in self.columns)}>"
        )

    def _repr_html_(self) -> str:
        """Return the first rows as HTML. To see other rows, take a slice such as `table[100:110]`."""
        columns = [column for column in self.columns if column.name != "data"]
        heads = [f"{each.name}, {each.unit}" if each.unit else each.name for each in columns]
        rows = zip(*(each.values[:SHOWN_ROWS] for each in columns), strict=True)
        shown = [
            heading(f"{self.name}: {self.about}"),
            table(heads, ([_cell(v) for v in row] for row in rows)),
        ]
        if (rest := self.rows - SHOWN_ROWS) > 0:
            others = f"table[{SHOWN_ROWS}:{2 * SHOWN_ROWS}]"
            shown.append(line(f"… and {rest} more; a slice, such as {others}, shows other rows"))
        return page(*shown)


def _cell(value: str | float) -> str | None:
    if isinstance(value, str):
        text = printable(value)
        return text if len(text) <= MAX_CELL_CHARS else text[: MAX_CELL_CHARS - 1] + "…"
    return None if isnan(value) else f"{value:.6g}"
