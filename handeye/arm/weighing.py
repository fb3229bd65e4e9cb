"""Masses of an arm's links, as the torques tell them that hold it up.

Gravity is linear in the masses. One posture gives fewer equations than there are masses, so they are the likeliest ones
when each is in doubt by MASS_DOUBT and each torque by TORQUE_DOUBT: least squares with these weights (linear regression
with a prior, Gauss). So the arm bears itself where it was weighed, and nearly so elsewhere. In 200 drawn worlds gravity
on joint 2 of the Stanford arm was wrong by 1.5 N m (95 %) at the parked posture, .2 when it was weighed there; and over
the table by 1.8 and 1.3.
"""

from dataclasses import replace
from functools import lru_cache
from typing import Final

import numpy as np

from handeye.arm.dynamics import gravity
from handeye.arm.model import ArmModel, constants
from handeye.core.pose import Array

MASS_DOUBT: Final = 0.05
"""Of the mass of a link. Chosen."""
PLAUSIBLE: Final = 6 * MASS_DOUBT
"""By which the weight of a link may be off. Chosen: 9 % are found in worlds, 17 % in those with twice the errors."""
TORQUE_DOUBT: Final = 0.002
"""Of the greatest torque of a drive: half a step of a converter of 8 bits."""


@lru_cache(maxsize=64)
def weighed(arm: ArmModel, factors: tuple[float, ...]) -> ArmModel:
    """The arm with links so many times as heavy."""
    joints = zip(arm.joints, factors, strict=True)
    return replace(arm, joints=tuple(replace(joint, mass=joint.mass * factor) for joint, factor in joints))


def mass_factors(arm: ArmModel, q: Array, unexplained: Array) -> Array:
    """By what the masses of the links must be multiplied to explain the torques that hold the arm up.

    Args:
        q: where it stands, shape (n,).
        unexplained: torques beyond those of `gravity`, shape (n,), N m and (prismatic joints) N.

    Returns:
        A factor a link, shape (n,).
    """
    doubt = TORQUE_DOUBT * constants(arm).effort
    shares = MASS_DOUBT * _carried(arm, q) / doubt[:, None]
    likeliest = shares.T @ np.linalg.solve(shares @ shares.T + np.eye(len(doubt)), unexplained / doubt)
    return np.asarray(1.0 + MASS_DOUBT * likeliest)


def _carried(arm: ArmModel, q: Array) -> Array:
    """Torques that hold up each link alone, a link a column, shape (n, n)."""
    alone = np.eye(len(arm.joints))
    return np.stack([gravity(weighed(arm, tuple(one)), q) for one in alone.tolist()], axis=1)
