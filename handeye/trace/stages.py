"""The stages of a run as they were carried out."""

from collections.abc import Iterable
from typing import Final, Literal

from handeye.events import AnyEvent, StageFinished, StageStarted
from handeye.record import Record

BROKEN_OFF: Final = "broken off"


class Stage(Record, frozen=True, kw_only=True):
    """A stage from its beginning to its end; one that was done again is another."""

    name: str
    begin: float
    """s"""
    end: float
    """s; of one that was broken off, the time of the last event."""
    status: Literal["done", "stopped", "skipped", "broken off"]


def stages(events: Iterable[AnyEvent]) -> tuple[Stage, ...]:
    """The stages in the order in which they were begun."""
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
