"""Stretches of a trace: what was recorded from the beginning of a step to that of the next one."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Final

from handeye.program.events import AnyEvent, RunStarted, StageFinished, StageStarted, StepStarted
from handeye.trace.channels import EVENTS, FRAMES, HAND, JOINTS, LOG, MACHINES, MOMENTS, SCENE
from handeye.trace.records import RawMessage
from handeye.trace.trace import Trace

OF_A_PERIOD: Final = (JOINTS, HAND, MACHINES, FRAMES)
"""Channels of what is recorded of each servo period."""
_SAID_TWICE: Final = (LOG, SCENE)
"""Channels that say nothing of their own: sentences of events, and how bodies look."""


@dataclass(frozen=True, slots=True)
class Told:
    """A message, and the event that it holds, if it holds one."""

    message: RawMessage
    event: AnyEvent | None
    since: int
    """ns since the step began."""


@dataclass(slots=True)
class Stretch:
    """What was recorded of a step, and up to the next one."""

    started: StepStarted | None
    """None: before the first step."""
    begin: int
    """ns"""
    told: list[Told] = field(default_factory=list)

    def add(self, messages: Iterable[tuple[RawMessage, AnyEvent | None]]) -> None:
        """Add messages, each with its event."""
        self.told += (Told(message, event, message.time - self.begin) for message, event in messages)


def stretches(trace: Trace, *, unseen: int, periods: bool = True) -> Iterator[Stretch]:
    """The stretches of a trace. The stage that a step begins, and where everything is then, belong to that step.

    Args:
        unseen: without what was recorded beside so many events, from the first on.
        periods: with what was recorded of each servo period.
    """
    stretch = Stretch(None, trace.messages[0].time)
    waiting: list[tuple[RawMessage, AnyEvent | None]] = []
    events = iter(trace.events)
    count = 0
    for message in trace.messages:
        if message.topic in _SAID_TWICE:
            continue
        event = next(events) if message.topic == EVENTS else None
        count += event is not None
        if (message.topic in MOMENTS and count < unseen) or (message.topic in OF_A_PERIOD and not periods):
            continue
        if message.topic == FRAMES or isinstance(event, StageFinished | StageStarted):
            waiting.append((message, event))
            continue
        if isinstance(event, StepStarted):
            yield stretch
            stretch = Stretch(event, message.time)
        stretch.add(waiting)
        waiting.clear()
        if not isinstance(event, RunStarted | StepStarted):
            stretch.add([(message, event)])
    stretch.add(waiting)
    yield stretch
