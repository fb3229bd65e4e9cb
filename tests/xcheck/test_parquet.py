"""pandas and DuckDB open the tables of a trace that are written as Parquet, and find in them what we say is there.

They are large, so the ordinary suite does without them: `pip install --group xcheck`, then `pytest tests/xcheck`.
"""

from pathlib import Path

import duckdb
import numpy as np
import pandas as pd
import pytest
from recordings import record

from handeye.trace.reading import read_trace
from handeye.trace.table import Table
from handeye.trace.tables import export_tables, tables

NAMES = ("joints", "forces", "events")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the tables of a trace."""
    folder = tmp_path_factory.mktemp("parquet")
    record(folder / "a.mcap")
    export_tables(folder / "told", lambda: read_trace(folder / "a.mcap"), "parquet", overwrite=False)
    return folder / "told"


@pytest.fixture(scope="module")
def made(folder: Path) -> dict[str, Table]:
    """The same tables as they are here."""
    return {table.name: table for table in tables(read_trace(folder.parent / "a.mcap"))}


@pytest.mark.parametrize("name", NAMES)
def test_pandas_reads_every_value(folder: Path, made: dict[str, Table], name: str) -> None:
    frame = pd.read_parquet(folder / f"{name}.parquet")
    assert list(frame.columns) == [column.name for column in made[name].columns]
    for column in made[name].columns:
        np.testing.assert_array_equal(frame[column.name].to_numpy(), np.array(column.values))


@pytest.mark.parametrize("name", NAMES)
def test_duckdb_reads_every_value(folder: Path, made: dict[str, Table], name: str) -> None:
    rows = duckdb.sql(f"SELECT * FROM '{folder}/{name}.parquet'").fetchall()  # noqa: S608
    columns = [
        [None if value != value else value for value in np.array(column.values).tolist()]
        for column in made[name].columns
    ]
    assert rows == list(zip(*columns, strict=True))


def test_a_question_in_sql_is_answered(folder: Path, made: dict[str, Table]) -> None:
    asked = (
        f"SELECT stage, count(*) FROM '{folder}/events.parquet' WHERE event = 'GuardTripped' GROUP BY stage"  # noqa: S608
    )
    assert dict(duckdb.sql(asked).fetchall()) == {"open": 3, "close": 3, "again": 3}


def test_the_same_trace_gives_the_same_bytes(folder: Path) -> None:
    again = folder.parent / "again"
    export_tables(again, lambda: read_trace(folder.parent / "a.mcap"), "parquet", overwrite=False)
    for name in NAMES:
        assert (again / f"{name}.parquet").read_bytes() == (folder / f"{name}.parquet").read_bytes()


@pytest.mark.parametrize("name", NAMES)
def test_a_data_frame_has_every_value_of_a_table(made: dict[str, Table], name: str) -> None:
    frame = made[name].to_pandas()
    assert list(frame.columns) == [column.name for column in made[name].columns]
    assert len(frame) == made[name].rows
    for column in made[name].columns:
        assert frame[column.name].tolist() == pytest.approx(list(column.values), nan_ok=True)
