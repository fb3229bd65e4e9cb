"""Converts the statistics of a sweep to tables for other programs."""

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from handeye.core.files import Kind
from handeye.core.record import Record
from handeye.trace.table import Column, Table
from handeye.trials.figures import Figures
from handeye.trials.sweep import R, Sweep

ROWS: Final = Kind("table of trials", b"trial,seed,condition,", ending=".csv")


def tables(sweep: Sweep[R], rows: Sequence[R], found: Figures, camera: str = "") -> tuple[Table, ...]:
    """Return the tables of a batch: its trials, the details of its kind of trials, its conditions and its failures.
    Empty tables are left out."""
    made = [trials(sweep, rows, camera)]
    made += [_of_records(each.name, each.title, each.rows) for each in sweep.details(rows) if each.rows]
    flat: dict[str, Sequence[Record]] = {"conditions": found.conditions, "failures": found.failures}
    made += [
        _of_records(name, f"{name.capitalize()} of the sweep.", records)
        for name, records in flat.items()
        if records
    ]
    return tuple(table for table in made if table.rows)


def trials(sweep: Sweep[R], rows: Sequence[R], camera: str = "") -> Table:
    """Return a table with one row per trial: how it ended, why it failed, and all measured values. If `camera` is
    given, the table also names the renderer.
    """
    failed = [sweep.standing(row) != "right" for row in rows]
    columns = [
        column("trial", "number of the trial", [row.trial for row in rows]),
        column("seed", "seed of the world", [row.seed for row in rows]),
        column("condition", "condition of the trial", [row.condition for row in rows]),
        column("verdict", ", ".join(sweep.outcomes), [row.verdict for row in rows]),
        column(
            "stage",
            "stage in which the trial failed",
            [row.stage * bad for row, bad in zip(rows, failed, strict=True)],
        ),
        column(
            "cause",
            "why the trial failed",
            [row.cause * bad for row, bad in zip(rows, failed, strict=True)],
        ),
    ]
    known = [{**row.facts, **row.measures} for row in rows]
    for name in dict.fromkeys(name for each in known for name in each):
        words, _, unit = name.rpartition(", ")
        values = [each.get(name, np.nan) for each in known]
        columns.append(column(words or name, "measured", values, unit if words else ""))
    if camera:
        columns.append(column("camera", "renderer", [camera] * len(rows)))
    columns.append(column("cpu", "computing time", [row.cpu_s for row in rows], "s"))
    return Table(name="trials", about="One row per trial.", columns=tuple(columns))


def _of_records(name: str, about: str, records: Sequence[Record]) -> Table:
    columns = []
    for field in records[0].__struct_fields__:
        values = [getattr(record, field) for record in records]
        if all(value is None or isinstance(value, (int, float, str)) for value in values):
            columns.append(column(field, "", values, "s" if field.endswith("_s") and field != "p_s" else ""))
    return Table(name=name, about=about, columns=tuple(columns))


def column(name: str, about: str, values: Sequence[Any], unit: str = "") -> Column:
    """Return a column of words or numbers. None becomes an empty word or NaN."""
    if any(isinstance(value, str) for value in values):
        return Column(
            name=name, about=about, values=tuple("" if value is None else str(value) for value in values)
        )
    kind = np.int64 if all(isinstance(value, int) for value in values) else float
    return Column(
        name=name, about=about, unit=unit,
        values=np.array([np.nan if value is None else value for value in values], dtype=kind),
    )  # fmt: skip
