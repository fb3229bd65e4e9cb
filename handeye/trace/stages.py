"""The stages and steps of a run, as they were executed."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Final, Literal

import numpy as np

from handeye.core.pose import Array
from handeye.core.record import Record
from handeye.program.events import (
    AnyEvent,
    OperatorCalled,
    RunFinished,
    StageFinished,
    StageStarted,
    StageUndone,
    StepFinished,
    StepStarted,
    UndoEnded,
    UndoStarted,
)

CLOCKS = 1e-4  # s by which the rounded clock of events may differ from the clock of servo periods


@dataclass(frozen=True, slots=True)
class Span:
    """The time from the beginning to the end of a stage or step (s)."""

    begin: float
    end: float

    def rows(self, times: Array) -> slice:
        """Return the servo periods within the span, as a slice of `times`. The array `times`, shape (n,), has the time
        at the end of each period.
        """
        first, last = np.searchsorted(times, [self.begin + CLOCKS, self.end + CLOCKS]).tolist()
        return slice(first, last)


@dataclass(slots=True)
class DoneStep:
    """A step, as it was executed."""

    started: StepStarted
    events: list[AnyEvent] = field(default_factory=list)  # including the step's end, if it ended

    @property
    def finished(self) -> bool:
        return bool(self.events) and isinstance(self.events[-1], StepFinished)

    @property
    def span(self) -> Span:
        """The time span of the step. An interrupted step lasts until the end of the run."""
        return Span(self.started.time, self.events[-1].time if self.finished else np.inf)


def done_steps(events: Iterable[AnyEvent]) -> Iterator[DoneStep]:
    """Yield the steps in the order in which they were executed."""
    step: DoneStep | None = None
    for event in events:
        if isinstance(event, StepStarted):
            step = DoneStep(event)
        elif step is not None:
            step.events.append(event)
            if step.finished:
                yield step
                step = None
    if step is not None:
        yield step


BROKEN_OFF: Final = "broken off"
Status = Literal["done", "stopped", "skipped", "broken off", "turned"]  # `turned`: the arm turned back


class Stage(Record, frozen=True, kw_only=True):
    """One execution of a stage. A repeated stage has several executions."""

    name: str
    begin: float  # s
    end: float  # s; if the stage was interrupted, the time of the last event
    status: Status
    back: bool = False  # True if the arm has undone the stage


def stages(events: Iterable[AnyEvent]) -> tuple[Stage, ...]:
    """Return the stages in the order in which they began."""
    found: list[Stage] = []
    begun: StageStarted | None = None
    time = 0.0
    for event in events:
        time = event.time
        if isinstance(event, StageStarted):
            begun = event
        elif isinstance(event, StageFinished) and begun is not None:
            found.append(Stage(name=begun.stage, begin=begun.time, end=time, status=event.status))
            begun = None
    if begun is not None:
        found.append(Stage(name=begun.stage, begin=begun.time, end=time, status=BROKEN_OFF))
    return tuple(found)


def stages_both_ways(events: Iterable[AnyEvent]) -> tuple[Stage, ...]:
    """Return the stages in the order in which the arm went through them: forwards, or backwards while it undid its
    work.
    """
    walk, time = _Walk(), 0.0
    for event in events:
        time = event.time
        walk.go(event)
    walk.end(time, BROKEN_OFF)
    return tuple(walk.found)


@dataclass(slots=True)
class _Walk:
    found: list[Stage] = field(default_factory=list)
    _done: list[str] = field(default_factory=list)  # stages begun and not undone, the latest one last
    _begun: float | None = None  # when the present stage began or was re-entered; None between stages
    _back: bool = False

    def go(self, event: AnyEvent) -> None:
        match event:
            case StageStarted():
                self._done.append(event.stage)
                self._begun, self._back = event.time, False
            case StageFinished():
                self.end(event.time, event.status)
            case StageUndone():
                self.end(event.time, "done")
                del self._done[-1:]
            case UndoStarted():
                self._turn(event.time, back=True)
            case StepStarted():
                self._turn(event.time, back=False)
            case UndoEnded():
                self.end(event.time, "turned")
            case OperatorCalled() if self._back:
                self.end(event.time, "stopped")
            case RunFinished():
                self.end(event.time, "done")

    def _turn(self, time: float, *, back: bool) -> None:
        """Change the direction in which the arm goes through stages."""
        if self._begun is not None and self._back != back:
            self.end(time, "turned")
        if self._begun is None:
            self._begun, self._back = time, back

    def end(self, time: float, status: Status) -> None:
        """End the present passage through a stage, if there is one."""
        if self._begun is not None and self._done:
            stage = Stage(name=self._done[-1], begin=self._begun, end=time, status=status, back=self._back)
            self.found.append(stage)
        self._begun = None
