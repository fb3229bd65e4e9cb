"""The steps of a run as they were carried out, and their servo periods."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

import numpy as np

from handeye.core.pose import Array
from handeye.program.events import AnyEvent, StepFinished, StepStarted

CLOCKS = 1e-4
"""s that the clock of the events, which is rounded, may be off that of the servo periods; far less than a period."""


@dataclass(frozen=True, slots=True)
class Span:
    """A time from when something began to when it ended, s."""

    begin: float
    end: float

    def rows(self, times: Array) -> slice:
        """The servo periods of it, which end at some times, shape (n,)."""
        first, last = np.searchsorted(times, [self.begin + CLOCKS, self.end + CLOCKS]).tolist()
        return slice(first, last)


@dataclass(slots=True)
class DoneStep:
    """A step as it was carried out."""

    started: StepStarted
    events: list[AnyEvent] = field(default_factory=list)
    """Everything that happened in it, its end included, if it came to that."""

    @property
    def finished(self) -> bool:
        """It came to its end."""
        return bool(self.events) and isinstance(self.events[-1], StepFinished)

    @property
    def span(self) -> Span:
        """The time it took; one that was broken off ends with the run."""
        return Span(self.started.time, self.events[-1].time if self.finished else np.inf)


def done_steps(events: Iterable[AnyEvent]) -> Iterator[DoneStep]:
    """The steps in the order in which they were carried out."""
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
