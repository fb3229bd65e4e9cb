"""Is something held? Models of the gap between the fingers after they have closed.

Something of a given thickness or more; something of a thickness within a range; anything at all; as much as before,
and in the middle as before.
"""

from typing import Final

from handeye.core.units import INCH

NEARLY_ZERO: Final = 0.05 * INCH
"""The most that fingers shut on nothing read, m: their potentiometer is off by up to .02 in, .04 in worlds of the high
level."""
SAME_HOLD: Final = 5e-4
"""m that fingers may stand off the gap that they had when they held the same."""
SKEW: Final = 1e-3
"""m that fingers may stand off it on what lies otherwise between them: on fingers an inch wide, 2 degrees are .9.
Grasped anew it lies straighter, and CENTER holds lightly; what was pushed on its blocks since lies skewer. Measured:
pins closer by .5; the pump's base by .8, and wider by .44 in seeds 1 to 6, by more than .5 in seed 1001."""
OFF_MIDDLE: Final = 3e-3
"""m that what was held may lie off the middle of fingers that close on it again, along their line. A thing that was
carried and set down has slid in its hold by SKEW and turned by 2 degrees: that is 2 mm where it is grasped 57 mm beside
that hold, as the pump's base is at its walls. Measured over eight pumps: there 1.8 at most, elsewhere (play of what
stands in a hole or a rack, what the arm gave way while it held it) 1.0."""


def least_gap(minimum: float) -> float:
    """The gap (m) that tells of something as thick as the minimum (m) or, for 0, of anything."""
    return minimum or NEARLY_ZERO


def at_least(gap: float, thickness: float) -> bool:
    """Something of at least this thickness is held (m)."""
    return gap >= thickness


def at_most(gap: float, thickness: float) -> bool:
    """Nothing thicker than this is held (m)."""
    return gap <= thickness


def as_before(gap: float, kept: float, closer: float = SKEW, wider: float = SAME_HOLD) -> bool:
    """Fingers hold as much as when their gap was the one kept: they are closer or farther apart by no more (m)."""
    return -closer <= gap - kept <= wider


def too_early(gap: float, kept: float) -> bool:
    """Fingers that touch something now are not yet where they were when they held it: it lies off the middle (m)."""
    return gap - kept > 2 * OFF_MIDDLE
