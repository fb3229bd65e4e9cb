"""Comparison of two traces: the first difference."""

from collections.abc import Iterator
from itertools import zip_longest

from handeye.trace.channels import EVENTS, LOG, MOMENTS, NEWER
from handeye.trace.records import RawMessage
from handeye.trace.resuming import until
from handeye.trace.sentences import sentence
from handeye.trace.trace import Trace


def first_difference(a: Trace, b: Trace, *, events: int | None = None, unseen: int = 0) -> str | None:
    """One sentence that names the first thing in which two traces differ; None if they say the same.

    How the files are packed does not matter, only what is in them; nor do channels that the older of two versions of
    the format does not have.

    Args:
        events: compare no more than so many events, and what came before and between them.
        unseen: compare of so many events, from the first on, nothing that was recorded beside them.
    """
    if a.plan != b.plan:
        return "the traces are of different plans"
    count, version = 0, min(a.version, b.version)
    sides = (_compared(trace, version, events, unseen) for trace in (a, b))
    for here, there in zip_longest(*sides):
        if here != there:
            return _difference(a, b, here, there, count)
        count += here.topic == EVENTS
    return None


def _compared(trace: Trace, version: int, events: int | None, unseen: int) -> Iterator[RawMessage]:
    """Messages that a trace of that version of the format has too, but what was recorded beside `unseen` events."""
    count = 0
    for message in until(trace.messages, events):
        if NEWER.get(message.topic, 1) <= version and (count >= unseen or message.topic not in MOMENTS):
            yield message
        count += message.topic == EVENTS


def _difference(a: Trace, b: Trace, here: RawMessage | None, there: RawMessage | None, events: int) -> str:
    """Tell what differs in the first two messages that do, with so many equal events before them."""
    last = a.events[events - 1] if events else None
    after = "before the first event" if last is None else f"after event {events} ({sentence(last)})"
    if here is None or there is None:
        short, long = (a, b) if here is None else (b, a)
        return f"{short.name} ends and {long.name} goes on {after}"
    if {here.topic, there.topic} <= {EVENTS, LOG}:  # a sentence stands before its event
        return f"event {events + 1} differs: {_events(a, b, events)}"
    if here.topic == there.topic and here.time == there.time:
        return f"{here.topic} differs at {_when(a, here.time / 1e9)}, {after}"
    first, second = (
        f"{found.topic} at {_when(of, found.time / 1e9)}" for of, found in ((a, here), (b, there))
    )
    return f"one goes on with {first}, the other with {second}, {after}"


def _when(trace: Trace, clock: float) -> str:
    return f"{trace.elapsed(clock):.3f} s"


def _events(a: Trace, b: Trace, number: int) -> str:
    """In what the events of a number differ."""
    one, other = a.events[number], b.events[number]
    when = _when(a, one.time)
    kinds = type(one).__name__, type(other).__name__
    if kinds[0] != kinds[1]:
        return f"{kinds[0]} at {when} in one, {kinds[1]} at {_when(b, other.time)} in the other"
    values = ((name, getattr(one, name), getattr(other, name)) for name in one.__struct_fields__)
    name, first, second = next((found for found in values if found[1] != found[2]), ("", None, None))
    if not name:
        return f"{kinds[0]} at {when} has another wording"
    return f"{name} of {kinds[0]} at {when} is {first} in one, {second} in the other"
