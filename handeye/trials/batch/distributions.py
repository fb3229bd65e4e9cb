"""How quantities of trials are spread: times of stages, places of searches, margins to the referee's limits."""

from collections.abc import Iterable, Iterator, Sequence
from typing import Final

import numpy as np

from handeye.core.record import Record
from handeye.results.result import Check
from handeye.trials.batch.row import Row

ALIKE: Final = 1e-3
"""Part of their mean by which margins may vary and still count as equal."""


class StageTime(Record, frozen=True, kw_only=True):
    """Arm time (s) of a stage in the trials that came through it."""

    stage: str
    n: int
    median_s: float
    p5_s: float
    p95_s: float


class SearchPlaces(Record, frozen=True, kw_only=True):
    """Places that searches around one position have tried."""

    at: str
    n: int
    found: int
    """How many did not end in vain."""
    median: float
    p95: float
    most: int


class Margin(Record, frozen=True, kw_only=True):
    """How far a finding of the referee stays within its limit, over the trials that were judged; in its unit."""

    finding: str
    unit: str
    n: int
    median: float
    p5: float
    worst: float
    """Negative: beyond the limit."""
    worst_seed: int
    deviations: float | None
    """Mean margin in standard deviations: the finding with the fewest is the next to fail. None: they hardly vary."""


def stage_times(rows: Sequence[Row]) -> Iterator[StageTime]:
    """Times of the stages, in the order of the program."""
    results = [row.result for row in rows if row.result is not None]
    for name in dict.fromkeys(stage.name for result in results for stage in result.stages):
        seconds = [
            s.arm_s for result in results for s in result.stages if s.name == name and s.status == "done"
        ]
        if seconds:
            p5, median, p95 = _quantiles(seconds, 0.05, 0.5, 0.95)
            yield StageTime(stage=name, n=len(seconds), median_s=median, p5_s=p5, p95_s=p95)


def search_places(rows: Sequence[Row]) -> Iterator[SearchPlaces]:
    """Places tried, by the position that was searched around."""
    ends = [end for row in rows for end in row.searches]
    for at in dict.fromkeys(end.at for end in ends):
        here = [end for end in ends if end.at == at]
        median, p95 = _quantiles([end.places for end in here], 0.5, 0.95)
        yield SearchPlaces(
            at=at, n=len(here), found=sum(end.found for end in here), median=median, p95=p95,
            most=max(end.places for end in here),
        )  # fmt: skip


def margins(rows: Sequence[Row]) -> tuple[Margin, ...]:
    """Margins of all findings, the next to fail first."""
    judged = [(row.seed, row.result.referee) for row in rows if row.result is not None and row.result.referee]
    names = dict.fromkeys(name for _, referee in judged for name in referee)
    found = [
        _margin(name, [(seed, referee[name]) for seed, referee in judged if name in referee])
        for name in names
    ]
    return tuple(sorted(found, key=lambda each: np.inf if each.deviations is None else each.deviations))


def margin_of(check: Check) -> float:
    """How far a finding is within its limit, in its unit; negative: beyond it."""
    return check.limit - check.value if check.relation == "at most" else check.value - check.limit


def _margin(name: str, checks: Sequence[tuple[int, Check]]) -> Margin:
    values = np.array([margin_of(check) for _, check in checks])
    worst = int(np.argmin(values))
    median, p5 = _quantiles(values.tolist(), 0.5, 0.05)
    spread = float(values.std())
    return Margin(
        finding=name,
        unit=checks[0][1].unit,
        n=len(values),
        median=median,
        p5=p5,
        worst=float(values[worst]),
        worst_seed=checks[worst][0],
        deviations=round(float(values.mean()) / spread, 3) if spread > ALIKE * abs(values.mean()) else None,
    )


def _quantiles(values: Iterable[float], *at: float) -> list[float]:
    return [round(float(value), 6) for value in np.quantile(np.array([*values], dtype=float), at)]
