"""Obstacles that stop an arm while it reverses a step, as facts and as sentences.

A reversal assumes the world as it was. A block may have fallen since, or been taken away, so every step is reversed
under guards, and the first to trip ends it.
"""

from handeye.core.plain_text import distinct_digits
from handeye.core.record import Record
from handeye.core.units import MILLIMETRE
from handeye.systems.trig.language.place import AXES, SIZES, UNITS


class Resisted(Record, frozen=True, kw_only=True, tag="resisted"):
    """The finger met a force, N."""

    force: float
    limit: float


class HoldOff(Record, frozen=True, kw_only=True, tag="hold_off"):
    """The gap (m) differs from the one kept: the hand holds something else, or nothing."""

    gap: float
    kept: float


class LeftBehind(Record, frozen=True, kw_only=True, tag="left_behind"):
    """An axis (from 0, as in AXES) does not follow; m or rad."""

    axis: int
    off: float
    limit: float


class Missed(Record, frozen=True, kw_only=True, tag="missed"):
    """A guarded move met something here, and meets nothing now."""


class Unsupported(Record, frozen=True, kw_only=True, tag="unsupported"):
    """The object held was taken from a support that is gone."""


Obstacle = Resisted | HoldOff | LeftBehind | Missed | Unsupported


def told_obstacle(obstacle: Obstacle) -> str:
    """An obstacle in words."""
    match obstacle:
        case Resisted(force=force, limit=limit):
            felt, allowed = distinct_digits((force, limit), 1)
            return f"the finger met {felt} N, and going back may meet {allowed} N"
        case HoldOff(gap=gap, kept=kept):
            now, then = distinct_digits((gap / MILLIMETRE, kept / MILLIMETRE), 1)
            return f"the fingers are {now} mm apart, and were {then} mm apart then"
        case LeftBehind(axis=axis, off=off, limit=limit):
            far, allowed = distinct_digits((off / SIZES[axis], limit / SIZES[axis]), 1)
            return f"{AXES[axis]} is {far} {UNITS[axis]} from where it was told to be, and may be {allowed}"
        case Missed():
            return "the finger met something here then, and meets nothing now"
        case Unsupported():
            return "what the hand holds was taken up from something here, and there is nothing here now"
