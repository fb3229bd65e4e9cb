"""The figures of a batch as tables for other programs."""

from collections.abc import Sequence

import numpy as np

from handeye.results.result import Result
from handeye.trace.table import Column, Table
from handeye.trials.batch.figures import Figures
from handeye.trials.batch.row import Row


def tables(rows: Sequence[Row], found: Figures) -> tuple[Table, ...]:
    """A table a subject: trials, operations, stages, searches, margins, failures."""
    return tuple(
        table
        for table in (
            _trials(rows), _operations(found), _stages(found), _searches(found), _margins(found), _failures(found),
        )
        if table.rows
    )  # fmt: skip


def _trials(rows: Sequence[Row]) -> Table:
    results = [row.result for row in rows]
    checks = {name: check for result in results if result for name, check in result.referee.items()}
    columns = (
        _numbers("trial", "number of the trial", [row.trial for row in rows]),
        _numbers("seed", "of its world", [row.seed for row in rows]),
        _words("verdict", "assembled, silent, stopped or failed", [row.verdict for row in rows]),
        _words("stage", "in which it failed", [row.stage if row.verdict != "assembled" else "" for row in rows]),
        _words("cause", "the same words for the same cause", [row.cause for row in rows]),
        _words("events", "digest of all that happened", [row.events for row in rows]),
        _numbers("working", "working phase", [r.timing.working_s if r else np.nan for r in results], "s"),
        *(
            _numbers(name, check.subject, [_value(r, name) for r in results], check.unit)
            for name, check in checks.items()
        ),
    )  # fmt: skip
    return Table(name="trials", about="A row a trial.", columns=columns)


def _value(result: Result | None, name: str) -> float:
    return np.nan if result is None or name not in result.referee else result.referee[name].value


def _operations(found: Figures) -> Table:
    each = found.operations
    low, high = (_bounds([rate.wilson95 for rate in each.values()], side) for side in (0, 1))
    return Table(name="operations", about="Success of each contact operation.", columns=(
        _words("operation", "its name", [*each]),
        _numbers("successes", "times that the program went on behind it", [rate.successes for rate in each.values()]),
        _numbers("trials", "times that it was begun", [rate.trials for rate in each.values()]),
        _numbers("wilson_low", "Wilson's interval, 95 %", low),
        _numbers("wilson_high", "the same", high),
        _numbers("p_s", "exact lower bound, 95 %", [_float(rate.p_s) for rate in each.values()]),
    ))  # fmt: skip


def _stages(found: Figures) -> Table:
    each = found.stages
    return Table(name="stages", about="Arm time of the stages that were done.", columns=(
        _words("stage", "its name", [s.stage for s in each]),
        _numbers("n", "trials", [s.n for s in each]),
        _numbers("p5", "5 % are shorter", [s.p5_s for s in each], "s"),
        _numbers("median", "half are shorter", [s.median_s for s in each], "s"),
        _numbers("p95", "95 % are shorter", [s.p95_s for s in each], "s"),
    ))  # fmt: skip


def _searches(found: Figures) -> Table:
    each = found.searches
    return Table(name="searches", about="Places that searches have tried.", columns=(
        _words("at", "position around which", [s.at for s in each]),
        _numbers("n", "searches", [s.n for s in each]),
        _numbers("found", "that did not end in vain", [s.found for s in each]),
        _numbers("median", "places", [s.median for s in each]),
        _numbers("p95", "places", [s.p95 for s in each]),
        _numbers("most", "places", [s.most for s in each]),
    ))  # fmt: skip


def _margins(found: Figures) -> Table:
    each = found.margins
    return Table(name="margins", about="Distance to the limits of the referee, in the unit of each.", columns=(
        _words("finding", "its name", [m.finding for m in each]),
        _words("unit", "of its figures", [m.unit for m in each]),
        _numbers("n", "trials that were judged", [m.n for m in each]),
        _numbers("median", "half have less", [m.median for m in each]),
        _numbers("p5", "5 % have less", [m.p5 for m in each]),
        _numbers("worst", "least", [m.worst for m in each]),
        _numbers("worst_seed", "world of the least", [m.worst_seed for m in each]),
        _numbers("deviations", "mean in standard deviations", [_float(m.deviations) for m in each]),
    ))  # fmt: skip


def _failures(found: Figures) -> Table:
    each = found.failures
    return Table(name="failures", about="Trials that were not assembled.", columns=(
        _numbers("trial", "number of the trial", [f.trial for f in each]),
        _numbers("seed", "of its world", [f.seed for f in each]),
        _words("verdict", "silent, stopped or failed", [f.verdict for f in each]),
        _words("stage", "in which", [f.stage for f in each]),
        _words("cause", "the same words for the same cause", [f.cause for f in each]),
        _words("detail", "with its figures", [f.detail for f in each]),
        _words("command", "carries it out again", [f.command for f in each]),
    ))  # fmt: skip


def _numbers(name: str, about: str, values: Sequence[float | int], unit: str = "") -> Column:
    whole = all(isinstance(value, int) for value in values)
    return Column(
        name=name, about=about, unit=unit, values=np.array(values, dtype=np.int64 if whole else float)
    )


def _words(name: str, about: str, values: Sequence[str]) -> Column:
    return Column(name=name, about=about, values=tuple(values))


def _bounds(intervals: Sequence[tuple[float, float] | None], side: int) -> list[float]:
    return [np.nan if interval is None else interval[side] for interval in intervals]


def _float(value: float | None) -> float:
    return np.nan if value is None else value
