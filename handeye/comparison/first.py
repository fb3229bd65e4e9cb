"""Finds the first difference between two runs: the step, the quantity, and both values."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import zip_longest
from typing import Final

import msgspec
from google.protobuf.message import DecodeError

from handeye.arm.model import ArmModel
from handeye.comparison.pairing import Place, TwoRuns, place_of
from handeye.core.errors import BadFile
from handeye.core.plain_text import one_line
from handeye.inspection.difference import step_changes
from handeye.program.events import (
    AnyEvent,
    OperatorAnswered,
    RunStarted,
    StageFinished,
    StageStarted,
    StepFinished,
    StepStarted,
)
from handeye.report.recorded import RecordedRun
from handeye.tasks import known
from handeye.trace.channels import EVENTS, FRAMES, HAND, JOINTS, LOG, MACHINES, MOMENTS, SCENE
from handeye.trace.quantities import QuantityDifference, differing, differing_events
from handeye.trace.records import RawMessage
from handeye.trace.trace import Trace

OF_A_PERIOD: Final = (JOINTS, HAND, MACHINES, FRAMES)
"""Channels that are recorded in every servo period."""
_SAID_TWICE: Final = (LOG, SCENE)
"""Channels that only repeat what other channels contain. `LOG` contains a sentence for each event, and `SCENE`
contains the appearance of the bodies.
"""


@dataclass(frozen=True, slots=True)
class StepMessage:
    """A message that was recorded during a step. If the message contains an event, `event` is that event."""

    message: RawMessage
    event: AnyEvent | None
    since: int  # ns since the step began


@dataclass(slots=True)
class Stretch:
    """The messages recorded during one step, or before the first step."""

    started: StepStarted | None  # None before the first step
    begin: int  # ns
    told: list[StepMessage] = field(default_factory=list)

    def add(self, messages: Iterable[tuple[RawMessage, AnyEvent | None]]) -> None:
        """Add messages, each with its event, or with None if the message has no event."""
        self.told += (StepMessage(message, event, message.time - self.begin) for message, event in messages)


def stretches(trace: Trace, *, unseen: int, periods: bool = True) -> Iterator[Stretch]:
    """Split a trace into stretches, one per step. If a step begins a stage, its stretch includes the event of the
    stage, and the poses recorded with this event.

    Args:
        unseen: number of an event; messages that belong to earlier events are left out.
        periods: include the messages of each servo period.
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


_CLOCKS: Final = 2000  # in ns: times since a step began may differ by this much through rounding
EVENT: Final = ("event",)  # The quantity that differs if the next events differ in kind


def _differing(
    one: StepMessage | None, other: StepMessage | None, arm: ArmModel | None
) -> QuantityDifference | None:
    """Return the difference between two messages, or None if they agree."""
    if one is None or other is None or one.message.topic != other.message.topic:
        a, b = (each.message if each and each.message.topic == FRAMES else None for each in (one, other))
        return differing(a, b, arm) or QuantityDifference(quantity=EVENT, a=_kind(one), b=_kind(other))
    if one.event is not None and other.event is not None:
        return _events_differ(one.event, other.event) or _times_differ(one, other)
    if one.message.data == other.message.data:
        return _times_differ(one, other)
    return _times_differ(one, other) or differing(one.message, other.message, arm)


def _times_differ(one: StepMessage, other: StepMessage) -> QuantityDifference | None:
    if abs(one.since - other.since) <= _CLOCKS:
        return None
    return QuantityDifference(quantity=("time",), unit="s", a=one.since / 1e9, b=other.since / 1e9)


def _events_differ(one: AnyEvent, other: AnyEvent) -> QuantityDifference | None:
    """Return the difference between two events, or None if they agree. Step numbers are not compared, because
    another program numbers its steps differently.
    """
    if type(one) is not type(other):
        return QuantityDifference(quantity=EVENT, a=type(one).__name__, b=type(other).__name__)
    if isinstance(one, StepFinished | OperatorAnswered) and isinstance(
        other, StepFinished | OperatorAnswered
    ):
        other = msgspec.structs.replace(other, step=one.step)
    return differing_events(one, other)


def _kind(told: StepMessage | None) -> str | None:
    return None if told is None or told.event is None else type(told.event).__name__


def _next(told: Sequence[StepMessage], number: int) -> AnyEvent | None:
    """Return the next event, or None if a message of a servo period comes first."""
    for each in told[number:]:
        if each.event is not None or each.message.topic in OF_A_PERIOD:
            return each.event
    return None


@dataclass(frozen=True, slots=True, kw_only=True)
class First:
    """The first difference between two runs."""

    a: Place | None  # step of the first run; None before its first step, or after its end
    b: Place | None  # step of the second run, likewise
    period: int | None = None  # servo period of the step, counted from 1; None outside servo periods
    differing: QuantityDifference
    next: tuple[AnyEvent | None, AnyEvent | None] = (None, None)
    """The next event of each run in this step. Both are None if the runs differ in something other than their events.
    The entry of one run is None if, in this run, a servo period comes before the next event, or no further event comes
    in this step.
    """

    @property
    def place(self) -> Place | None:
        """The step in which the runs differ: the step of the first run or, if this run has not begun or has ended
        already, the step of the second run.
        """
        return self.a or self.b


def first_difference(runs: TwoRuns) -> First | None:
    """Find the first difference between two runs by comparing them step by step. Returns None if all recorded
    values agree.

    Times are compared from the beginning of each step, so that a delay in one step does not make all later
    steps differ. Raises BadFile if a message of a trace does not match its channel.
    """
    both = runs.a.trace, runs.b.trace
    unseen = max(trace.unseen for trace in both)
    try:
        for a, b in zip_longest(*(stretches(t, unseen=unseen, periods=not runs.thinned) for t in both)):
            found = _other_step(runs, a, b) or _recorded_otherwise(runs, a, b)
            if found is not None:
                return found
    except (DecodeError, msgspec.DecodeError, KeyError, ValueError):
        names = " or ".join(run.trace.name for run in (runs.a, runs.b))
        raise BadFile(f"a message in {names} cannot be decoded") from None
    return None


def _other_step(runs: TwoRuns, a: Stretch | None, b: Stretch | None) -> First | None:
    """Return the difference between the next steps of the two runs, or None if they are the same step."""
    here, there = (None if stretch is None else stretch.started for stretch in (a, b))
    if here is None and there is None:  # before the first step
        return None
    places = _place(runs.a, here), _place(runs.b, there)
    if here is None or there is None or not runs.are_beside(here.step, there.step):
        one, other = (None if place is None else one_line(place.text) for place in places)
        return First(
            a=places[0], b=places[1], differing=QuantityDifference(quantity=("step",), a=one, b=other)
        )
    if not runs.planned:
        return None
    steps = runs.a.program.steps[here.step], runs.b.program.steps[there.step]
    for what, was, now in step_changes(*steps):
        return First(a=places[0], b=places[1], differing=QuantityDifference(quantity=(what,), a=was, b=now))
    return None


def _place(run: RecordedRun, started: StepStarted | None) -> Place | None:
    return None if started is None else place_of(run, started)


def _recorded_otherwise(runs: TwoRuns, a: Stretch | None, b: Stretch | None) -> First | None:
    """Return the first difference between two recordings of the same step, or None if they agree."""
    assert a is not None
    assert b is not None
    task = known(runs.a.trace.head.task)
    arm, period = None if task is None else task.arm, 0
    for number, (one, other) in enumerate(zip_longest(a.told, b.told)):
        topics = [told.message.topic for told in (one, other) if told is not None]
        period += topics == [JOINTS, JOINTS]
        found = _differing(one, other, arm)
        if found is not None:
            next = (_next(a.told, number), _next(b.told, number)) if found.quantity == EVENT else (None, None)
            beside = period > 0 and any(topic in OF_A_PERIOD for topic in topics)
            return First(
                a=_place(runs.a, a.started),
                b=_place(runs.b, b.started),
                period=period if beside else None,
                differing=found,
                next=next,
            )
    return None
