"""Figures of the insertion bench: what many trials of a condition come to."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.stats import binomtest

from handeye.core.record import Record
from handeye.trials.insertion import Condition, InsertionTrial

GENTLE: Final = 20.0
"""N that a peak is held against."""


class Spread(Record, frozen=True, kw_only=True):
    """How values are spread."""

    median: float
    p95: float
    """What 95 % of them are not over."""
    most: float

    @classmethod
    def of(cls, values: Sequence[float]) -> "Spread | None":
        """The spread of values, if there are any."""
        if not values:
            return None
        median, p95, most = np.percentile(values, [50, 95, 100]).round(6).tolist()
        return cls(median=median, p95=p95, most=most)


class Figures(Record, frozen=True, kw_only=True):
    """What the trials of one condition came to."""

    condition: Condition
    step_in: float
    """Step of the search."""
    n: int
    seated: int
    told: int
    """The operator was called."""
    silent: int
    """The program said done, and was wrong."""
    interval: tuple[float, float]
    """Wilson's interval of the share that was seated, at 95 %."""
    peak_n: Spread | None
    """Of all trials."""
    gentle: int
    """Trials in which the peak was at most 20 N."""
    felt_n: Spread | None
    """Of all trials."""
    seconds: Spread | None
    """Of those seated: from the first contact until seated."""
    whole_s: Spread | None
    """Of all trials: all of it, the way down to the face included."""
    places: Spread | None
    """Of those seated."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Bench:
    """All trials of a bench, and their figures."""

    conditions: tuple[Condition, ...]
    trials: tuple[InsertionTrial, ...]
    """In the order of condition, world and number."""

    @classmethod
    def of(cls, conditions: Iterable[Condition], trials: Iterable[InsertionTrial]) -> "Bench":
        """A bench of trials in any order."""
        ordered = sorted(trials, key=lambda each: (each.condition, each.seed, each.number))
        return cls(conditions=tuple(conditions), trials=tuple(ordered))

    def of_condition(self, index: int) -> list[InsertionTrial]:
        """The trials of a condition."""
        return [trial for trial in self.trials if trial.condition == index]

    def figures(self) -> Iterator[Figures]:
        """The figures of each condition of which there are trials."""
        for index, condition in enumerate(self.conditions):
            tried = self.of_condition(index)
            if tried:
                yield _figures(condition, tried)


def _figures(condition: Condition, tried: Sequence[InsertionTrial]) -> Figures:
    seated = [trial for trial in tried if trial.outcome == "seated"]
    share = binomtest(len(seated), len(tried)).proportion_ci(0.95, method="wilson")
    return Figures(
        condition=condition,
        step_in=round(condition.step, 3),
        n=len(tried),
        seated=len(seated),
        told=sum(trial.outcome == "told" for trial in tried),
        silent=sum(trial.outcome == "silent" for trial in tried),
        interval=(round(float(share.low), 6), round(float(share.high), 6)),
        peak_n=Spread.of([trial.peak for trial in tried]),
        gentle=sum(trial.peak <= GENTLE for trial in tried),
        felt_n=Spread.of([trial.felt for trial in tried]),
        seconds=Spread.of([trial.seconds for trial in seated if trial.seconds is not None]),
        whole_s=Spread.of([trial.whole for trial in tried]),
        places=Spread.of([float(trial.places) for trial in seated]),
    )
