"""Is something held? Three models of the gap between the fingers after they have closed.

Something of a given thickness or more; something of a thickness within a range; or anything at all.
"""

from typing import Final

from handeye.units import INCH

NEARLY_ZERO: Final = 0.05 * INCH
"""The most that fingers shut on nothing read, m: their potentiometer is off by up to .02 in, .04 in worlds of the high
level."""


def least_gap(minimum: float) -> float:
    """The gap (m) that tells of something as thick as the minimum (m) or, for 0, of anything."""
    return minimum or NEARLY_ZERO


def at_least(gap: float, thickness: float) -> bool:
    """Something of at least this thickness is held (m)."""
    return gap >= thickness


def at_most(gap: float, thickness: float) -> bool:
    """Nothing thicker than this is held (m)."""
    return gap <= thickness
