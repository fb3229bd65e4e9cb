"""Finds the divergence of two runs: in each run, the first event at which their courses differ."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import zip_longest
from typing import Any

from handeye.comparison.pairing import Place, TwoRuns, place_of
from handeye.program import events as happened
from handeye.program.events import AnyEvent, StepStarted
from handeye.report.recorded import RecordedRun


@dataclass(frozen=True, slots=True, kw_only=True)
class DecidingEvent:
    """An event that decides how a run continues."""

    place: Place | None  # present step, or the last one; None before the first step
    event: AnyEvent


@dataclass(frozen=True, slots=True, kw_only=True)
class Divergence:
    """The first event, in each run, at which the courses of the runs differ. If a run has ended, its event is None."""

    a: DecidingEvent | None  # next event of the first run; None if the run has ended
    b: DecidingEvent | None  # next event of the second run, likewise

    @property
    def place(self) -> Place | None:
        """The step in progress in the first run or, if the first run has ended, in the second run."""
        turning = self.a or self.b
        return None if turning is None else turning.place


def parting(runs: TwoRuns) -> Divergence | None:
    """Find the divergence of two runs. Returns None if the runs do not diverge.

    The course of a run consists of its steps and of the events that decide which steps follow: tripped guards,
    raised errors, answers to tests, and user commands.
    """
    for a, b in zip_longest(_turnings(runs.a), _turnings(runs.b)):
        if a is None or b is None or not _alike(runs, a.event, b.event):
            return Divergence(a=a, b=b)
    return None


def _turnings(run: RecordedRun) -> Iterator[DecidingEvent]:
    place: Place | None = None
    for event in run.trace.events:
        if _decides(event) is not None:
            yield DecidingEvent(place=place, event=event)
        if isinstance(event, StepStarted):
            place = place_of(run, event)


def _alike(runs: TwoRuns, a: AnyEvent, b: AnyEvent) -> bool:
    """Return True if both runs continue in the same way after these two events."""
    if isinstance(a, StepStarted) and isinstance(b, StepStarted):
        return runs.are_beside(a.step, b.step)
    return type(a) is type(b) and _decides(a) == _decides(b)


def _decides(event: AnyEvent) -> Any:
    """Return the part of an event that decides how the run continues, or None if the event has no such part."""
    match event:
        case happened.StepStarted():
            return event.step
        case happened.GuardTripped():
            return event.guard
        case happened.ErrorRaised():
            return event.number
        case happened.ErrorTested():
            return event.number, event.occurred
        case happened.SearchAdvanced():
            return event.count
        case happened.PartInspected() | happened.PartMatched():
            return event.ok
        case happened.OperatorCalled():
            return event.message, event.error
        case happened.OperatorAnswered():
            return event.choice
        case happened.ExperimentMade():
            return event.what, event.name, event.value
        case happened.PeriodsCommanded():
            return event.by, event.periods
        case happened.LineTyped():
            return event.task, event.text
        case happened.PanicStopped():
            return "panic"
        case happened.RunFinished():
            return event.completed
    return None
