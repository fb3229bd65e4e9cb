"""Models of the gap between closed fingers: whether something is held, how thick, and as before or not."""

from typing import Final

from handeye.core.units import INCH

EMPTY_GAP: Final = 0.05 * INCH
"""The largest reading of empty closed fingers, m: their potentiometer is off by up to .02 in, .04 at the high level."""
SAME_HOLD: Final = 5e-4  # m that the gap may differ on the same hold
SKEW: Final = 1e-3
"""m that the gap may differ on an object that has turned between the fingers: 2 degrees on an inch are .9.

Grasped anew it lies straighter, and CENTER holds lightly; pushed on its blocks since, it lies more skew. Measured:
pins closer by .5; the pump's base by .8, and wider by .44 in seeds 1 to 6, by more than .5 in seed 1001.
"""
OFF_MIDDLE: Final = 3e-3
"""m that an object may lie off the middle of fingers that close on it again, along their line.

An object carried and set down has slid in its hold by SKEW and turned by 2 degrees: that is 2 mm at a grasp 57 mm
beside that hold, as on the pump base's walls. Measured over eight pumps: there 1.8 at most, elsewhere (play in a hole
or rack, compliance of the arm while it held it) 1.0.
"""


def least_gap(minimum: float) -> float:
    """The gap (m) that shows an object as thick as `minimum` (m) or, for 0, any object."""
    return minimum or EMPTY_GAP


def at_least(gap: float, thickness: float) -> bool:
    """True if an object of at least this thickness (m) is held."""
    return gap >= thickness


def at_most(gap: float, thickness: float) -> bool:
    """True if nothing thicker (m) is held."""
    return gap <= thickness


def as_before(gap: float, kept: float, closer: float = SKEW, wider: float = SAME_HOLD) -> bool:
    """True if the gap is that of the earlier hold, within `closer` and `wider` (m)."""
    return -closer <= gap - kept <= wider


def too_early(gap: float, kept: float) -> bool:
    """True if closing fingers touch too wide (m) compared with the earlier hold: the object lies off the middle."""
    return gap - kept > 2 * OFF_MIDDLE
