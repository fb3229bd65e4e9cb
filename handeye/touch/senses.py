"""Can a sense be believed? Limits of what each may read where something is known of what it should read.

They allow for the errors that devices are stated to have (the tables of variation of the tasks), twice as large, as
in worlds of the high level.
"""

from typing import Final

import numpy as np

from handeye.core.pose import Array
from handeye.core.units import INCH, OUNCE_FORCE, OUNCE_INCH

FREED: Final = 0.12 * INCH
"""Opening of the gap after which a finger stands off whatever it touched, m. Half of it is each finger's: the arm
gives that much way (1.5 mm) only to a push of some 18 N."""
FOLLOWED: Final = 0.1 * INCH
"""Difference between the gap and what it was driven to, m. The servo of the fingers closes on their
potentiometer and stops within some hundredths of an inch. Placeholder."""
STILL: Final = 0.02 * INCH
"""Change of the gap that may be noise, m: twenty times what a reading wavers by."""
IN_AIR: Final = 45 * OUNCE_FORCE
"""Force that the hand may feel in free air, N: 12.5. By arithmetic, masses and mass centres of the links, gains of the
drives and the friction of the joints, which may hold the arm up or down, are felt as 6.1 N at most in 400 nominal
worlds, at 15 places on the table, and as 8.9 N at the high level; what the base weighs more than its declared load
adds 2 N there."""
STARTING: Final = 3 * OUNCE_INCH
"""Torque that a motor shows at least when it starts, N m: it takes 7 ounce-inches, and its current wavers by .6."""


def off_zero(force: Array) -> bool:
    """A force (N, shape (3,)) is more than may be felt in free air."""
    return bool(np.linalg.norm(force) > IN_AIR)


def followed(gap: float, goal: float) -> bool:
    """A gap is what the fingers were driven to, m."""
    return abs(gap - goal) <= FOLLOWED


def stood_still(change: float, driven: float) -> bool:
    """The gap has not changed although the fingers were driven together by more than the gap may be wrong by, m."""
    return driven > FOLLOWED and abs(change) < STILL
