"""Plausible sensor readings: their limits, and models of the gap between closed fingers.

Limits allow for twice the stated errors of the devices (the variation tables of the tasks), as worlds of the high level
have.
"""

from typing import Final

import numpy as np

from handeye.core.pose import Array
from handeye.core.units import INCH, OUNCE_FORCE

FREE_OPENING: Final = 0.12 * INCH
"""Opening after which a finger is clear of anything it touched, m.

Half of it is each finger's: the arm gives that much (1.5 mm) only to a push of some 18 N.
"""
GAP_ERROR: Final = 0.1 * INCH
"""Allowed difference between gap and goal, m; the finger servo stops within some hundredths of an inch. Placeholder."""
GAP_NOISE: Final = 0.02 * INCH  # m; twenty times the sensor noise
FREE_FORCE: Final = 45 * OUNCE_FORCE
"""Largest force felt in free air, N: 12.5.

By arithmetic, masses and mass centres of the links, drive gains and joint friction, which may hold the arm up or
down, are felt as 6.1 N at most in 400 nominal worlds, at 15 places on the table, and as 8.9 N at the high level; the
base's weight beyond its declared load adds 2 N there.
"""
SWITCH_FORCE: Final = 10 * OUNCE_FORCE
"""Force with which fingers press that have been centred, N: both switches report it.

They fire at 2 ounces, and at 4.4 at most (three times twice their stated spread of .4). One finger may bear 3 ounces
less than the other: the arm holds the difference, and the gap is known to a step of its converter.
"""
GAP_OFFSET: Final = (
    0.06 * INCH
)  # m by which the gap may be off, as GAP_SCALE: three times twice its stated errors
GAP_SCALE: Final = 0.03  # of the gap
STARTING_TORQUE: Final = 0.05
"""Torque of a starting motor, N m: 7 ounce-inches, until the spindle turns as fast as it should."""
STALLED_TORQUE: Final = 0.37  # N m, at most: that of the clutch, and of the spindle beside it
STARTING_PERIODS: Final = (
    4  # servo periods that a motor takes to start at the speed of driving; measured: 4.2
)
PLATEAU: Final = 1.0
"""s that a torque must last to be that of a motor held fast: at the speed of driving, three turns. Chosen."""
HELD_FAST: Final = 0.3
"""Share of the torque asked for that shows a motor held fast, while the hand does not get on.

Of 42 ounce-inches it is .09 N m. A screw that turns takes .02, a bit that slips under 22 ounces at most .025 (all of
that force as friction, at the edge of a head), and five times the noise of the current are .04 more.
"""
CURRENT_NOISE: Final = 0.008  # N m, of a reading: twice the stated noise of the current


def off_zero(force: Array) -> bool:
    """True if a force (N, shape (3,)) is too large for free air."""
    return bool(np.linalg.norm(force) > FREE_FORCE)


def followed(gap: float, goal: float) -> bool:
    """True if the gap is at its goal, m."""
    return abs(gap - goal) <= GAP_ERROR


def leapt(change: float, reach: float) -> bool:
    """True if the gap has changed by more than its motor drives the fingers in that time (m)."""
    return abs(change) > reach + GAP_NOISE


def thick(gap: float, thickness: float) -> bool:
    """True if a gap can be that of fingers that hold an object of known thickness (m), between grips full and light,
    straight or askew."""
    return abs(gap - thickness) <= GAP_OFFSET + GAP_SCALE * thickness + SKEW


def kept_apart(gap: float, goal: float) -> bool:
    """True if something keeps the fingers at a gap (m) that are driven together: a light grip closes no switch."""
    return gap > EMPTY_GAP and gap - goal > GAP_ERROR


def stood_still(change: float, driven: float) -> bool:
    """True if the gap has not changed although the fingers were driven together by more than its error, m."""
    return driven > GAP_ERROR and abs(change) < GAP_NOISE


EMPTY_GAP: Final = 0.05 * INCH
"""The largest reading of empty closed fingers, m: their potentiometer is off by up to .02 in, .04 at the high level."""
SAME_HOLD: Final = 5e-4  # m that the gap may differ on the same hold
SKEW: Final = 1e-3
"""m that the gap may differ on an object that has turned between the fingers: 2 degrees on an inch are .9.

Grasped again it is straighter, and CENTER holds lightly; pushed on its blocks since, it lies more skew. Measured:
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
