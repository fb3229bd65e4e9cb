"""Is something held? Models of the gap between the fingers after they have closed.

Something of a given thickness or more; something of a thickness within a range; anything at all; as much as before.
"""

from typing import Final

from handeye.units import INCH

NEARLY_ZERO: Final = 0.05 * INCH
"""The most that fingers shut on nothing read, m: their potentiometer is off by up to .02 in, .04 in worlds of the high
level."""
SAME_HOLD: Final = 5e-4
"""m that fingers may stand off the gap that they had when they held the same."""
CLOSER: Final = 1e-3
"""m that fingers may be closer on what they hold: grasped anew it lies straighter in them, and CENTER holds lightly.
Measured: .8 on the pump's base after it was pushed, .5 on pins. On fingers an inch wide, 2 degrees are as much."""


def least_gap(minimum: float) -> float:
    """The gap (m) that tells of something as thick as the minimum (m) or, for 0, of anything."""
    return minimum or NEARLY_ZERO


def at_least(gap: float, thickness: float) -> bool:
    """Something of at least this thickness is held (m)."""
    return gap >= thickness


def at_most(gap: float, thickness: float) -> bool:
    """Nothing thicker than this is held (m)."""
    return gap <= thickness


def as_before(gap: float, kept: float, closer: float = CLOSER) -> bool:
    """Fingers hold as much as when their gap was the one kept: they are no farther apart, or closer by no more (m)."""
    return -closer <= gap - kept <= SAME_HOLD
