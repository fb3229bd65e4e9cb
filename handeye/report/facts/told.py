"""Collects the sensor readings of a run at one moment, and the events that have captions."""

from dataclasses import dataclass
from typing import Final, NamedTuple

import msgspec
from msgspec import UNSET

from handeye.core.errors import BadFile
from handeye.program import events as happened
from handeye.program.events import AnyEvent
from handeye.report.recorded import RecordedRun
from handeye.trace.channels import HAND, nanoseconds
from handeye.trace.hand_message import Axes, read_hand

SENSED: Final = (
    happened.Adjusted,
    happened.CameraBusy,
    happened.CameraStarted,
    happened.ErrorRaised,
    happened.ErrorTested,
    happened.ExperimentMade,
    happened.GuardFaint,
    happened.GuardTripped,
    happened.HandTold,
    happened.LineTyped,
    happened.OperatorAnswered,
    happened.OperatorCalled,
    happened.PanicStopped,
    happened.PartInspected,
    happened.PartMatched,
    happened.PartSeen,
    happened.PeriodsCommanded,
    happened.PictureTaken,
    happened.PositionDefined,
    happened.Saved,
    happened.SearchAdvanced,
    happened.SystemEvent,
)


class CaptionedEvent(NamedTuple):
    """An event that has a caption."""

    time: float  # s since the run began
    event: AnyEvent


def told(run: RecordedRun) -> tuple[CaptionedEvent, ...]:
    """Return all events that have captions, the earliest first."""
    return tuple(CaptionedEvent(event.time, event) for event in run.trace.events if isinstance(event, SENSED))


@dataclass(frozen=True, slots=True, kw_only=True)
class Senses:
    """Sensor readings of the hand in one servo period."""

    gap: float  # Opening of the fingers, m
    fingers: tuple[bool, bool]
    force: float | None  # Size of the force of the hand, N; None: it was not estimated


def senses_at(run: RecordedRun, seconds: float) -> Senses | None:
    """Return the sensor readings at a time since the run began (s), or None if no readings were recorded. Raises
    InvalidInput if the trace is damaged.
    """
    until = nanoseconds(seconds)
    told = [message for message in run.trace.messages if message.topic == HAND and message.time <= until]
    if not told:
        return None
    try:
        message = read_hand(told[-1].data)
        force = message.force
        size = (
            None
            if force is UNSET or not isinstance(force, Axes)
            else float((force.array() ** 2).sum() ** 0.5)
        )
        return Senses(gap=message.gap, fingers=(message.finger_1, message.finger_2), force=size)
    except msgspec.DecodeError:
        raise BadFile(f"{run.trace.name}: a message about the hand cannot be decoded") from None
