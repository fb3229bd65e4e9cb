"""What the senses told at a moment."""

from dataclasses import dataclass

import msgspec
from msgspec import UNSET

from handeye.core.errors import BadFile
from handeye.report.recorded import RecordedRun
from handeye.trace.channels import HAND, nanoseconds
from handeye.trace.hand_message import Axes, HandMessage, read_hand


@dataclass(frozen=True, slots=True, kw_only=True)
class Senses:
    """What hand and fingers told in a servo period."""

    gap: float
    """Opening of the fingers, m."""
    fingers: tuple[bool, bool]
    """Their switches are closed."""
    force: float | None
    """Size of the force of the hand, N; None: it was not estimated."""


def senses_at(run: RecordedRun, seconds: float) -> Senses | None:
    """What the senses told at a time since the run began; None: that was not recorded; raises InvalidInput if a message
    about the hand cannot be understood.
    """
    until = nanoseconds(run.trace.head.time + seconds)
    told = [message for message in run.trace.messages if message.topic == HAND and message.time <= until]
    if not told:
        return None
    try:
        return _senses(read_hand(told[-1].data))
    except msgspec.DecodeError:
        raise BadFile(f"{run.trace.name}: a message about the hand cannot be understood") from None


def _senses(message: HandMessage) -> Senses:
    force = message.force
    size = None if force is UNSET or not isinstance(force, Axes) else float((force.array() ** 2).sum() ** 0.5)
    return Senses(gap=message.gap, fingers=(message.finger_1, message.finger_2), force=size)
