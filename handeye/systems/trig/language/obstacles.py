"""Obstacles: what stops an arm that undoes a step, as facts, and as sentences.

Going back, an arm takes the world for what it was. It may be another one by now: a block has fallen, or somebody has
taken it away. So every step is undone under guards, and the first that trips ends it.
"""

from handeye.core.plain_text import distinct_digits
from handeye.core.record import Record
from handeye.core.units import MILLIMETRE
from handeye.systems.trig.language.place import AXES, SIZES, UNITS


class Resisted(Record, frozen=True, kw_only=True, tag="resisted"):
    """The finger has met a force."""

    force: float
    """N, as `limit`."""
    limit: float


class HoldOff(Record, frozen=True, kw_only=True, tag="hold_off"):
    """The fingers do not stand where they stood then: they hold something else, or nothing."""

    gap: float
    """m, as `kept`."""
    kept: float


class LeftBehind(Record, frozen=True, kw_only=True, tag="left_behind"):
    """An axis does not follow."""

    axis: int
    """From 0, as AXES has them."""
    off: float
    """m or rad, as `limit`."""
    limit: float


class Missed(Record, frozen=True, kw_only=True, tag="missed"):
    """A guarded move has met something at this place, and there is nothing now."""


class Unsupported(Record, frozen=True, kw_only=True, tag="unsupported"):
    """What the hand holds was taken up from something at this place, and there is nothing now to set it down on."""


Obstacle = Resisted | HoldOff | LeftBehind | Missed | Unsupported


def told_obstacle(obstacle: Obstacle) -> str:
    """What has stopped an arm, in words."""
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
