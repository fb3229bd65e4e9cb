"""The folder in which the tables of a trace are handed to other programs."""

import csv
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from io import BytesIO, StringIO
from pathlib import Path
from typing import Final, Literal, get_args

import numpy as np

from handeye.core.extras import MissingExtra
from handeye.core.folders import FolderKind, check_folder, write_folder
from handeye.core.plain_text import printable
from handeye.trace.table import Column, Table
from handeye.trace.tables import tables
from handeye.trace.trace import Trace

Format = Literal["csv", "parquet"]
README: Final = "README.md"
_SI: Final = "Figures are in SI units"
_BEGINS: Final = "# Tables of a run of handeye\n"
EXPORT: Final = FolderKind(
    name="tables of handeye",
    known_by=README,
    begins=_BEGINS.encode(),
    holds=(README, *(f"*.{ending}" for ending in get_args(Format))),
)


def export_tables(
    path: Path, trace: Callable[[], Trace], kind: Format, *, overwrite: bool
) -> tuple[Table, ...]:
    """Write the tables of a trace to a folder, with a README on their columns; the tables that were written.

    Args:
        trace: called once the folder has been checked.
    """
    check_folder(path, EXPORT, overwrite=overwrite)
    made = tables(trace())
    write_tables(path, made, kind)
    return made


def check_tables(path: Path, kind: Format) -> None:
    """Raises CannotWrite or MissingExtra if tables cannot be written to a folder."""
    check_folder(path, EXPORT, overwrite=True)
    _WRITERS[kind](Table(name="", about="", columns=()))


def write_tables(path: Path, made: Sequence[Table], kind: Format, units: str = _SI) -> None:
    """Write tables to a folder, replacing those that are there, with a README on their columns.

    Args:
        units: a sentence on the units of figures.
    """
    check_folder(path, EXPORT, overwrite=True)
    written = _WRITERS[kind]
    files = {f"{table.name}.{kind}": written(table) for table in made}
    write_folder(path, {README: _readme(made, kind, units).encode(), **files})


def csv_bytes(table: Table) -> bytes:
    """A table as CSV: its columns' names, then a row a line; numbers as exact as they are, none an empty cell."""
    text = StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow([column.name for column in table.columns])
    rows.writerows(zip(*map(_cells, table.columns), strict=True))
    return text.getvalue().encode()


def _cells(column: Column) -> Iterable[object]:
    values = column.values
    if isinstance(values, np.ndarray):
        return ("" if value != value else value for value in values.tolist())  # NaN is not itself
    return values


def parquet_bytes(table: Table) -> bytes:
    """A table as Parquet; units and meanings are metadata of its fields."""
    try:
        import pyarrow as pa
        from pyarrow import parquet
    except ImportError:
        raise MissingExtra("parquet", "pyarrow", "export") from None
    arrays = [pa.array(column.values, from_pandas=True) for column in table.columns]  # NaN is none
    fields = [
        pa.field(column.name, array.type, metadata={"unit": column.unit, "about": column.about})
        for column, array in zip(table.columns, arrays, strict=True)
    ]
    made = pa.Table.from_arrays(arrays, schema=pa.schema(fields, metadata={"about": table.about}))
    file = BytesIO()
    parquet.write_table(made, file)
    return file.getvalue()


_WRITERS: Final[Mapping[Format, Callable[[Table], bytes]]] = {"csv": csv_bytes, "parquet": parquet_bytes}


def _readme(made: Iterable[Table], kind: Format, units: str) -> str:
    """The content of the files, column by column."""
    return "\n".join([_BEGINS, f"{units}; a cell without a figure is empty.", *_told(made, kind), ""])


def _told(made: Iterable[Table], kind: Format) -> Iterator[str]:
    for table in made:
        yield from (
            "",
            f"## {table.name}.{kind}",
            "",
            table.about,
            "",
            "| column | unit | |",
            "|---|---|---|",
        )
        for column in table.columns:
            yield f"| `{printable(column.name)}` | {column.unit} | {printable(column.about)} |"
