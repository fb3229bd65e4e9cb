"""Computes distributions over trials: times of stages, numbers of search places, and margins to the referee's
limits."""

from collections.abc import Iterable, Iterator, Sequence
from typing import Final

import numpy as np

from handeye.core.record import Record
from handeye.results.result import Check
from handeye.trials.figures import rate
from handeye.trials.plans.row import Row
from handeye.trials.sweep import Details

ALIKE: Final = 1e-3  # Margins that vary by less than this fraction of their mean count as equal


class StageTime(Record, frozen=True, kw_only=True):
    """Arm time of a stage (s), over the trials that completed the stage."""

    stage: str
    n: int
    p5_s: float
    median_s: float
    p95_s: float


class SearchPlaces(Record, frozen=True, kw_only=True):
    """The distribution of the number of places that a search around one position tried."""

    at: str
    n: int
    found: int  # Number of searches that found the right place
    median: float
    p95: float
    most: int


class Margin(Record, frozen=True, kw_only=True):
    """Statistics of the distance between a finding and its limit in the judged trials, in the finding's unit."""

    finding: str
    unit: str
    n: int
    median: float
    p5: float
    worst: float  # Negative: beyond the limit
    worst_seed: int
    deviations: float | None
    """Mean margin in standard deviations. The finding for which this number is smallest is the most likely to fail
    next. None if the margins hardly vary.
    """


class OperationRate(Record, frozen=True, kw_only=True):
    """Success rate of a contact operation. An operation succeeded if the program continued after it."""

    operation: str
    successes: int
    trials: int
    low_share: float | None  # Wilson's interval, 95 %
    rate_share: float | None
    high_share: float | None
    at_least_share: float | None  # Exact lower bound, 95 %


def operations(rows: Sequence[Row]) -> Iterator[OperationRate]:
    """Yield the success rates of all contact operations."""
    done: dict[str, list[bool]] = {}
    for contact in (contact for row in rows for contact in row.contacts):
        done.setdefault(contact.operation, []).append(contact.done)
    for name, each in done.items():
        sure = rate(sum(each), len(each))
        low, high = sure.wilson95 or (None, None)
        yield OperationRate(
            operation=name, successes=sure.successes, trials=sure.trials, low_share=low, rate_share=sure.rate,
            high_share=high, at_least_share=sure.p_s,
        )  # fmt: skip


def stage_times(rows: Sequence[Row]) -> Iterator[StageTime]:
    """Yield the times of the stages, in program order."""
    results = [row.result for row in rows if row.result is not None]
    for name in dict.fromkeys(stage.name for result in results for stage in result.stages):
        seconds = [
            s.arm_s for result in results for s in result.stages if s.name == name and s.status == "done"
        ]
        if seconds:
            p5, median, p95 = _quantiles(seconds, 0.05, 0.5, 0.95)
            yield StageTime(stage=name, n=len(seconds), median_s=median, p5_s=p5, p95_s=p95)


def search_places(rows: Sequence[Row]) -> Iterator[SearchPlaces]:
    """For each position around which programs searched, yield statistics on the number of places that the searches
    tried.
    """
    ends = [end for row in rows for end in row.searches]
    for at in dict.fromkeys(end.at for end in ends):
        here = [end for end in ends if end.at == at]
        median, p95 = _quantiles([end.places for end in here], 0.5, 0.95)
        yield SearchPlaces(
            at=at, n=len(here), found=sum(end.found for end in here), median=median, p95=p95,
            most=max(end.places for end in here),
        )  # fmt: skip


def details(rows: Sequence[Row]) -> tuple[Details, ...]:
    """Return tables of operations, stages, searches and margins."""
    return (
        Details(
            name="operations", title="Contact operations", rows=tuple(operations(rows)),
            heads=("contact operation", "succeeded", "of", "from", "rate", "to", "at least"),
            span=("low_share", "rate_share", "high_share"),
        ),
        Details(
            name="stages", title="Arm time by stage", rows=tuple(stage_times(rows)),
            heads=("stage", "trials", "5 %", "median", "95 %"), span=("p5_s", "median_s", "p95_s"),
        ),
        Details(
            name="searches", title="Searches", rows=tuple(search_places(rows)),
            heads=("search around", "searches", "found", "places: median", "95 %", "maximum"),
        ),
        margin_details(rows),
    )  # fmt: skip


def margin_details(rows: Sequence[Row]) -> Details:
    """Return the table of margins to the referee's limits. The finding with the smallest margin, in standard
    deviations, comes first, because this finding is the most likely to fail.
    """
    return Details(
        name="margins", title="Margins to the referee’s limits, the smallest first", rows=margins(rows),
        heads=("margin to the limit of", "unit", "trials", "median", "5 %", "worst", "seed", "deviations"),
        span=("worst", "p5", "median"),
    )  # fmt: skip


def margins(rows: Sequence[Row]) -> tuple[Margin, ...]:
    """Return the margins of all findings. The findings most likely to fail come first."""
    judged = [(row.seed, row.result.referee) for row in rows if row.result is not None and row.result.referee]
    names = dict.fromkeys(name for _, referee in judged for name in referee)
    found = [
        _margin(name, [(seed, referee[name]) for seed, referee in judged if name in referee])
        for name in names
    ]
    return tuple(sorted(found, key=lambda each: np.inf if each.deviations is None else each.deviations))


def margin_of(check: Check) -> float:
    """Return the margin between a finding and its limit, in the finding's unit. The margin is negative if the limit is
    exceeded.
    """
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
