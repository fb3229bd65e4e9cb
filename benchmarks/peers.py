"""Ways to do one and the same thing, ours and those of other libraries, measured side by side in one run."""

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from statistics import median
from typing import Self, TypeVar

T = TypeVar("T")


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """What one way made of one task."""

    error: float | None
    """How far off; None: not found."""
    read: float | None = None
    """Share of the picture that was read, if that is counted."""


Trial = tuple[Callable[[], T], Callable[[T], Outcome]]
"""Work that is timed, and the check of its result, which is not."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Way:
    """One way to do something."""

    task: str
    name: str
    unit: str
    """Of its errors."""
    outcomes: tuple[Outcome, ...]
    seconds: tuple[float, ...]
    """Of this computer's clock, for each task: the median of several times."""

    @classmethod
    def measured(cls, task: str, name: str, *, unit: str, trials: Iterable[Trial[T]], times: int) -> Self:
        """One method, tried on each of several tasks a number of times."""
        outcomes, seconds = [], []
        for work, judge in trials:
            result, spent = timed(work, times)
            outcomes.append(judge(result))
            seconds.append(spent)
        return cls(task=task, name=name, unit=unit, outcomes=tuple(outcomes), seconds=tuple(seconds))

    @property
    def errors(self) -> list[float]:
        """Of what was found, the least first."""
        return sorted(outcome.error for outcome in self.outcomes if outcome.error is not None)

    @property
    def median_s(self) -> float:
        """The middle of its times."""
        return median(self.seconds)

    def as_json(self, ours: "Way") -> dict[str, object]:
        """Measured values, beside our own way."""
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
    """Ways to do the same."""

    ours: Way
    others: tuple[Way, ...] = ()
    missing: tuple[str, ...] = ()
    """Libraries that could not be measured here."""

    @property
    def ways(self) -> tuple[Way, ...]:
        """All of them, ours first."""
        return self.ours, *self.others

    def as_json(self) -> dict[str, object]:
        """All of it."""
        return {"ways": [way.as_json(self.ours) for way in self.ways], "not_measured": list(self.missing)}

    def lines(self) -> list[str]:
        """One for each way, and one for each library that was not measured."""
        told = [_line(way, self.ours) for way in self.ways]
        return told + [
            f"{self.ours.task:12} {name}: not measured, it is not installed" for name in self.missing
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
    """What comes of some work, and the median of its times, s."""
    seconds = []
    for _ in range(times):
        begun = time.perf_counter()
        result = work()
        seconds.append(time.perf_counter() - begun)
    return result, median(seconds)
