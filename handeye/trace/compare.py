"""Compares two traces. Finds their first difference, and checks whether the traces differ only in the last digits of
numbers.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import zip_longest

from handeye.tasks import known
from handeye.trace.channels import EVENTS, JOINTS, LOG, MOMENTS
from handeye.trace.quantities import differing, has_quantities, quantity_text, values_text
from handeye.trace.records import RawMessage, until
from handeye.trace.sentences import sentence
from handeye.trace.trace import Trace


@dataclass(frozen=True, slots=True, kw_only=True)
class Repetition:
    """The result of a comparison of two traces: two sentences. One describes the first difference that is more than
    rounding, and the other describes the first difference that is only rounding. If both sentences are missing, the
    traces are identical, byte for byte.
    """

    parts: str | None = None  # the first difference that is more than rounding
    rounded: str | None = None  # the first difference that is only in the last digits of numbers


def compared(a: Trace, b: Trace, *, events: int | None = None, unseen: int = 0) -> Repetition:
    """Compare the contents of two traces, which may be compressed differently.

    If `events` is given, stop after this number of events. Messages after the last compared event are then not
    compared. Messages recorded before event number `unseen` are left out. The two runs may have used different
    processors and different versions of handeye.
    """
    if a.plan != b.plan:
        return Repetition(parts="the traces belong to different plans")
    so_far, rounded, reworded = _SoFar(), None, None
    for here, there in zip_longest(*(_compared(trace, events, unseen) for trace in (a, b))):
        if here is not None and here.topic == JOINTS:
            so_far.periods, so_far.last = so_far.periods + 1, here.time
        if here is None or there is None or (here.topic, here.time) != (there.topic, there.time):
            return Repetition(parts=reworded or _difference(a, b, here, there, so_far), rounded=rounded)
        same = here.data == there.data
        if here.topic == LOG:  # the sentence of the event that follows
            reworded = reworded if same else _difference(a, b, here, there, so_far)
        elif not same and not (so_far.events == 0 and _begin_alike(a, b)):
            if not _differ_in_last_places(here, there):
                return Repetition(parts=_difference(a, b, here, there, so_far, rounded=True), rounded=rounded)
            rounded, reworded = rounded or _difference(a, b, here, there, so_far), None
        elif here.topic == EVENTS and reworded is not None and same:
            return Repetition(parts=reworded, rounded=rounded)
        so_far.events += here.topic == EVENTS
    return Repetition(parts=reworded, rounded=rounded)


def first_difference(a: Trace, b: Trace, *, events: int | None = None, unseen: int = 0) -> str | None:
    """Return a sentence on the first difference between two traces, even if only the last digits of a number
    differ. Returns None if there is no difference. The arguments are those of `compared`.
    """
    found = compared(a, b, events=events, unseen=unseen)
    return found.rounded or found.parts


def _begin_alike(a: Trace, b: Trace) -> bool:
    """Return True if two runs begin in the same way. Their processors and versions may differ."""
    return a.head.made_alike == b.head.made_alike


@dataclass(slots=True)
class _SoFar:
    events: int = 0
    periods: int = 0
    last: int = 0  # when the last servo period ended, ns


def _compared(trace: Trace, events: int | None, unseen: int) -> Iterator[RawMessage]:
    """Yield the messages to compare. Messages recorded before event number `unseen` are left out."""
    count = 0
    for message in until(trace.messages, events):
        if count >= unseen or message.topic not in MOMENTS:
            yield message
        count += message.topic == EVENTS


def _differ_in_last_places(here: RawMessage, there: RawMessage) -> bool:
    return has_quantities(here) and differing(here, there, rounded=True) is None


def _difference(
    a: Trace,
    b: Trace,
    here: RawMessage | None,
    there: RawMessage | None,
    so_far: _SoFar,
    *,
    rounded: bool = False,
) -> str:
    """Describe the difference in a sentence. If `rounded` is True, ignore differences that are due to rounding."""
    events = so_far.events
    last = a.events[events - 1] if events else None
    after = "before the first event" if last is None else f"after event {events} ({sentence(last)})"
    if here is None or there is None:
        short, long = (a, b) if here is None else (b, a)
        return f"{short.name} ends and {long.name} continues {after}"
    if {here.topic, there.topic} <= {EVENTS, LOG}:  # a sentence precedes its event
        return f"event {events + 1} differs: {_events(a, b, events)}"
    if here.topic == there.topic and here.time == there.time:
        period = f"in servo period {so_far.periods}, " if here.time == so_far.last else ""
        return f"{period}at {_when(a, here.time / 1e9)}, {_quantity(a, here, there, rounded)}, {after}"
    first, second = (
        f"{found.topic} at {_when(of, found.time / 1e9)}" for of, found in ((a, here), (b, there))
    )
    return f"the next message is {first} in one trace, and {second} in the other, {after}"


def _quantity(a: Trace, here: RawMessage, there: RawMessage, rounded: bool) -> str:
    task = known(a.head.task)
    found = differing(here, there, None if task is None else task.arm, rounded=rounded)
    if found is None:
        return f"{here.topic} differs"
    one, other = values_text(found)
    return f"{quantity_text(found.quantity)} differs: {one} and {other}"


def _when(trace: Trace, clock: float) -> str:
    return f"{clock:.3f} s"


def _events(a: Trace, b: Trace, number: int) -> str:
    one, other = a.events[number], b.events[number]
    when = _when(a, one.time)
    kinds = type(one).__name__, type(other).__name__
    if kinds[0] != kinds[1]:
        return f"{kinds[0]} at {when} in one trace, {kinds[1]} at {_when(b, other.time)} in the other"
    values = ((name, getattr(one, name), getattr(other, name)) for name in one.__struct_fields__)
    name, first, second = next((found for found in values if found[1] != found[2]), ("", None, None))
    if not name:
        return f"{kinds[0]} at {when} has a different text"
    return f"{name} of {kinds[0]} at {when} is {first} in one trace, {second} in the other"
