"""Finds what of an interrupted trace is worth going on with."""

from collections.abc import Iterable, Iterator, Sequence

from handeye.program.events import Event, to_line
from handeye.trace.channels import EVENTS
from handeye.trace.records import RawMessage, read_messages


def event_data(event: Event) -> bytes:
    """An event as it stands in a trace."""
    return to_line(event)[:-1]


def until(messages: Iterable[RawMessage], events: int | None) -> Iterator[RawMessage]:
    """The messages up to event number `events`; None: all."""
    if events == 0:
        return
    count = 0
    for message in messages:
        yield message
        count += message.topic == EVENTS
        if count == events:
            return


def known(data: bytes, events: Sequence[Event]) -> int:
    """Count of these events, from the first on, that a trace holds as they are here."""
    written = (message.data for message in read_messages(data, lenient=True) if message.topic == EVENTS)
    count = 0
    for event, there in zip(events, written, strict=False):
        if event_data(event) != there:
            break
        count += 1
    return count
