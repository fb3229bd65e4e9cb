"""Compares handeye's method for a task with those of other libraries, measured in the same process."""

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from statistics import median
from typing import Self, TypeVar

T = TypeVar("T")


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """The outcome of one method on one example."""

    error: float | None
    """Error of the result, in the unit of the method; None: no result was found."""
    read: float | None = None
    """Fraction of the picture that was read; None if this was not counted."""


Trial = tuple[Callable[[], T], Callable[[T], Outcome]]
"""A function whose time is measured, and a function that checks the result, whose time is not measured."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Way:
    """One method, with its results on several examples."""

    task: str
    name: str
    unit: str
    """Unit of the errors."""
    outcomes: tuple[Outcome, ...]
    seconds: tuple[float, ...]
    """Wall-clock time for each example: the median of several measurements."""

    @classmethod
    def measured(cls, task: str, name: str, *, unit: str, trials: Iterable[Trial[T]], times: int) -> Self:
        """Try a method on several examples, `times` times on each."""
        outcomes, seconds = [], []
        for work, judge in trials:
            result, spent = timed(work, times)
            outcomes.append(judge(result))
            seconds.append(spent)
        return cls(task=task, name=name, unit=unit, outcomes=tuple(outcomes), seconds=tuple(seconds))

    @property
    def errors(self) -> list[float]:
        """The errors of the results that were found, in increasing order."""
        return sorted(outcome.error for outcome in self.outcomes if outcome.error is not None)

    @property
    def median_s(self) -> float:
        """The median of its times (s)."""
        return median(self.seconds)

    def as_json(self, ours: "Way") -> dict[str, object]:
        """Return the measured values. `ratio` compares the time with that of handeye's own method."""
        read = [outcome.read for outcome in self.outcomes if outcome.read is not None]
        return {
            "task": self.task,
            "way": self.name,
            "tried": len(self.outcomes),
            "found": len(self.errors),
            "unit": self.unit,
            "median_error": median(self.errors) if self.errors else None,
            "worst_error": self.errors[-1] if self.errors else None,
            "median_read": median(read) if read else None,
            "median_wall_s": self.median_s,
            "ratio": self.median_s / ours.median_s,
        }


@dataclass(frozen=True, slots=True, kw_only=True)
class Comparison:
    """Several methods for the same task."""

    ours: Way
    others: tuple[Way, ...] = ()
    missing: tuple[str, ...] = ()
    """Libraries that are not installed, and so were not measured."""

    @property
    def ways(self) -> tuple[Way, ...]:
        """All methods, handeye's own first."""
        return self.ours, *self.others

    def as_json(self) -> dict[str, object]:
        """Return the measured values of all methods."""
        return {"ways": [way.as_json(self.ours) for way in self.ways], "not_measured": list(self.missing)}

    def lines(self) -> list[str]:
        """Return one line for each method, and one for each library that was not measured."""
        told = [_line(way, self.ours) for way in self.ways]
        return told + [
            f"{self.ours.task:12} {name}: not measured, because it is not installed" for name in self.missing
        ]


def _line(way: Way, ours: Way) -> str:
    shown = way.as_json(ours)
    off = f"{shown['median_error']:.2g}, at worst {shown['worst_error']:.2g} {way.unit}" if way.errors else ""
    read = "" if shown["median_read"] is None else f"{shown['median_read']:.1%} read"
    times = "" if way is ours else f"{shown['ratio']:.2f} times ours"
    found = f"{shown['found']} of {shown['tried']}"
    seconds = f"{way.median_s * 1e3:.3f} ms"
    return f"{way.task:12} {way.name:34} {found:>12}  {off:32} {read:11} {seconds:>10}  {times}".rstrip()


def timed(work: Callable[[], T], times: int) -> tuple[T, float]:
    """Return the result of a function, and the median of its times (s)."""
    seconds = []
    for _ in range(times):
        begun = time.perf_counter()
        result = work()
        seconds.append(time.perf_counter() - begun)
    return result, median(seconds)
