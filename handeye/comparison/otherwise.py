"""What was recorded otherwise of a step that two runs carried out: the first quantity, and the servo period."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import zip_longest
from typing import Final

import msgspec

from handeye.arm.model import ArmModel
from handeye.comparison.stretches import OF_A_PERIOD, Stretch, Told
from handeye.program.events import AnyEvent, OperatorAnswered, StepFinished
from handeye.trace.channels import FRAMES, JOINTS
from handeye.trace.quantities import QuantityDifference, differing, differing_events

_CLOCKS: Final = 2000
"""ns by which times since a step began may differ by rounding."""
EVENT: Final = ("event",)
"""The quantity that differs where another kind of thing happened next."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Otherwise:
    """What was recorded otherwise."""

    differing: QuantityDifference
    period: int | None
    """The servo period of the step, from 1; None: it is of none."""
    next: tuple[AnyEvent | None, AnyEvent | None] = (None, None)
    """What happened next, where that is what differs; None: the step went on, or nothing more was recorded."""


def otherwise(a: Stretch, b: Stretch, arm: ArmModel | None) -> Otherwise | None:
    """The first that was recorded otherwise of the same step; None: nothing was.

    Args:
        arm: of which both tell, if it is known.
    """
    period = 0
    for number, (one, other) in enumerate(zip_longest(a.told, b.told)):
        topics = [told.message.topic for told in (one, other) if told is not None]
        period += topics == [JOINTS, JOINTS]
        found = _differing(one, other, arm)
        if found is not None:
            next = (_next(a.told, number), _next(b.told, number)) if found.quantity == EVENT else (None, None)
            beside = period > 0 and any(topic in OF_A_PERIOD for topic in topics)
            return Otherwise(differing=found, period=period if beside else None, next=next)
    return None


def _differing(one: Told | None, other: Told | None, arm: ArmModel | None) -> QuantityDifference | None:
    """What two messages tell differently."""
    if one is None or other is None or one.message.topic != other.message.topic:
        return _moved_alone(one, other, arm) or QuantityDifference(
            quantity=EVENT, a=_kind(one), b=_kind(other)
        )
    if one.event is not None and other.event is not None:
        return _events_differ(one.event, other.event) or _times_differ(one, other)
    if one.message.data == other.message.data:
        return _times_differ(one, other)
    return _times_differ(one, other) or differing(one.message, other.message, arm)


def _times_differ(one: Told, other: Told) -> QuantityDifference | None:
    if abs(one.since - other.since) <= _CLOCKS:
        return None
    return QuantityDifference(quantity=("time",), unit="s", a=one.since / 1e9, b=other.since / 1e9)


def _moved_alone(one: Told | None, other: Told | None, arm: ArmModel | None) -> QuantityDifference | None:
    """The body that moved in one of two runs, while it kept still in the other; None: what differs is not that."""
    a, b = (None if told is None or told.message.topic != FRAMES else told.message for told in (one, other))
    return differing(a, b, arm)


def _events_differ(one: AnyEvent, other: AnyEvent) -> QuantityDifference | None:
    """What two events tell differently, but for the numbers of steps, which another program counts otherwise."""
    if type(one) is not type(other):
        return QuantityDifference(quantity=EVENT, a=type(one).__name__, b=type(other).__name__)
    if isinstance(one, StepFinished | OperatorAnswered) and isinstance(
        other, StepFinished | OperatorAnswered
    ):
        other = msgspec.structs.replace(other, step=one.step)
    return differing_events(one, other)


def _kind(told: Told | None) -> str | None:
    return None if told is None or told.event is None else type(told.event).__name__


def _next(told: Sequence[Told], number: int) -> AnyEvent | None:
    """The event that comes next; None: a servo period comes first."""
    for each in told[number:]:
        if each.event is not None or each.message.topic in OF_A_PERIOD:
            return each.event
    return None
