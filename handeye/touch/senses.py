"""Plausibility limits of sensors.

They allow for twice the stated errors of the devices (the variation tables of the tasks), as worlds of the high level
have.
"""

from typing import Final

import numpy as np

from handeye.core.pose import Array
from handeye.core.units import INCH, OUNCE_FORCE, OUNCE_INCH

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
STARTING_TORQUE: Final = 3 * OUNCE_INCH
"""Least torque shown by a starting motor, N m: it takes 7 ounce-inches, and its current wavers by .6."""


def off_zero(force: Array) -> bool:
    """True if a force (N, shape (3,)) is too large for free air."""
    return bool(np.linalg.norm(force) > FREE_FORCE)


def followed(gap: float, goal: float) -> bool:
    """True if the gap is at its goal, m."""
    return abs(gap - goal) <= GAP_ERROR


def stood_still(change: float, driven: float) -> bool:
    """True if the gap has not changed although the fingers were driven together by more than its error, m."""
    return driven > GAP_ERROR and abs(change) < GAP_NOISE
