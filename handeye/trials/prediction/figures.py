"""Figures of a prediction: a line for each operation, the worst worlds, and the agreement with whole trials."""

from collections.abc import Callable, Sequence

import numpy as np

from handeye.core.pose import Array
from handeye.core.record import Record
from handeye.tasks.interface import Predicted
from handeye.trials.batch.row import Row
from handeye.trials.prediction.predicting import Prediction


class OperationFigures(Record, frozen=True, kw_only=True):
    """How far off one thing of a contact operation is over all worlds, in its unit."""

    operation: str
    at: str
    """The position."""
    what: str
    unit: str
    room: float
    """How far off it may be."""
    median: float
    p95: float
    worst: float
    used: float
    """Share of the room in the worst world."""
    worst_seed: int
    beyond: float
    """Share of the worlds in which there is no room."""


class ThinWorld(Record, frozen=True, kw_only=True):
    """A world by what is thinnest in it."""

    seed: int
    used: float
    """Share of the room; beyond 1 it is predicted to fail."""
    operation: str
    at: str
    what: str
    off: float
    room: float
    unit: str
    command: str
    """Carries the whole trial out."""


class Agreement(Record, frozen=True, kw_only=True):
    """One figure as predicted and as whole trials had it."""

    name: str
    unit: str
    n: int
    correlation: float | None
    """Of ranks, after Spearman; None: too few, or all alike."""
    predicted: float
    """Median."""
    measured: float
    """Median."""
    close: float
    """Share of the trials in which both differ by no more than 1 place or .1 mm."""


class Outcome(Record, frozen=True, kw_only=True):
    """Whole trials beside what was predicted of them."""

    n: int
    predicted: int
    """That something was predicted to fail in."""
    failed: int
    """That were not assembled."""
    both: int
    silent: int
    """Taken for success by the program."""
    agreements: tuple[Agreement, ...]


class PredictionFigures(Record, frozen=True, kw_only=True):
    """What a prediction comes to."""

    n: int
    beyond: float
    """Share of the worlds in which anything is predicted to fail."""
    operations: tuple[OperationFigures, ...]
    worst: tuple[ThinWorld, ...]
    """Worlds with the thinnest margins, the thinnest first."""
    outcome: Outcome | None = None
    wall_s: float = 0.0


def figures(
    found: Prediction,
    command: Callable[[int], str],
    *,
    worst: int,
    rows: Sequence[Row] = (),
    wall_s: float = 0.0,
) -> PredictionFigures:
    """The figures of a prediction.

    Args:
        command: the command that carries a seed's whole trial out.
        worst: how many of the worst worlds.
        rows: whole trials of some of the worlds.
    """
    return PredictionFigures(
        n=len(found.seeds),
        beyond=float((found.used > 1).mean()),
        operations=tuple(_operation(found, each) for each in found.each),
        worst=tuple(_thin(found, k, command) for k in worst_of(found, worst)),
        outcome=_outcome(found, rows) if rows else None,
        wall_s=round(wall_s, 3),
    )


def worst_of(found: Prediction, count: int) -> list[int]:
    """Numbers of the worlds with the thinnest margins, the thinnest first."""
    return [int(k) for k in np.argsort(-found.used, kind="stable")[:count]]


def _operation(found: Prediction, each: Predicted) -> OperationFigures:
    worst = int(each.off.argmax())
    median, p95 = (float(value) for value in np.quantile(each.off, (0.5, 0.95)))
    return OperationFigures(
        operation=each.operation, at=each.at, what=each.what, unit=each.unit, room=round(each.room, 6),
        median=round(median, 6), p95=round(p95, 6), worst=round(float(each.off[worst]), 6),
        used=round(float(each.used[worst]), 6), worst_seed=found.seeds[worst],
        beyond=float((each.used > 1).mean()),
    )  # fmt: skip


def _thin(found: Prediction, world: int, command: Callable[[int], str]) -> ThinWorld:
    each, seed = found.thinnest[world], found.seeds[world]
    return ThinWorld(
        seed=seed, used=round(float(found.used[world]), 6), operation=each.operation, at=each.at, what=each.what,
        off=round(float(each.off[world]), 6), room=round(each.room, 6), unit=each.unit, command=command(seed),
    )  # fmt: skip


# -- beside whole trials ------------------------------------------------------------------------------


def _outcome(found: Prediction, rows: Sequence[Row]) -> Outcome:
    number = {seed: k for k, seed in enumerate(found.seeds)}
    known = [row for row in rows if row.seed in number]
    expected = [bool(found.used[number[row.seed]] > 1) for row in known]
    failed = [row.verdict != "assembled" for row in known]
    pairs = [(each, *_pairs(each, number, known)) for each in found.each]
    return Outcome(
        n=len(known),
        predicted=sum(expected),
        failed=sum(failed),
        both=sum(a and b for a, b in zip(expected, failed, strict=True)),
        silent=sum(row.verdict == "silent" for row in known),
        agreements=tuple(_agreement(*pair) for pair in pairs if len(pair[1])),
    )


def _pairs(each: Predicted, number: dict[int, int], rows: Sequence[Row]) -> tuple[Array, Array]:
    """A figure as predicted and as measured, in the trials that have it."""
    pairs = []
    for row in rows:
        k = number[row.seed]
        measured = _measured(each, row)
        if measured is not None:
            pairs.append((float(each.off[k] if each.places is None else each.places[k]), measured))
    predicted, measured_ = np.array(pairs).reshape(-1, 2).T
    return predicted, measured_


def _measured(each: Predicted, row: Row) -> float | None:
    """Places that the first search around a position has tried, or a finding of the referee."""
    if each.places is not None:
        tried = [search.places for search in row.searches if search.at == each.at]
        return float(tried[0]) if tried else None
    checks = row.result.referee if row.result is not None else {}
    return checks[each.finding].value if each.finding in checks else None


def _agreement(each: Predicted, predicted: Array, measured: Array) -> Agreement:
    unit, near = ("places", 1.0) if each.places is not None else (each.unit, 0.1)
    return Agreement(
        name=f"{each.operation}, {each.at}" if each.places is not None else each.finding,
        unit=unit,
        n=len(predicted),
        correlation=_correlation(predicted, measured),
        predicted=float(np.median(predicted)),
        measured=float(np.median(measured)),
        close=float((np.abs(predicted - measured) <= near).mean()),
    )


def _correlation(first: Array, second: Array) -> float | None:
    from scipy.stats import rankdata

    a, b = rankdata(first), rankdata(second)
    if len(a) < 3 or not a.std() or not b.std():
        return None
    return round(float(np.corrcoef(a, b)[0, 1]), 3)
