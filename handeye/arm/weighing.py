"""Estimates link masses from the torques that hold the arm up.

Gravity torques are linear in the masses. One posture gives fewer equations than there are masses, so the most likely
masses are computed. This is a linear regression with a prior (Gauss): MASS_DOUBT is the standard deviation of each
mass, and TORQUE_DOUBT that of each torque. The gravity model then nearly agrees with the true torques at the posture
of the weighing. At other postures, the weighing improves the model less. In 200 worlds, the arm was weighed at the
parked posture. The weighing reduced the error of the gravity torque on joint 2 of the Stanford arm from 1.5 to .2 N m
at the parked posture, and from 1.8 to 1.3 N m over the table. Each figure is the limit within which 95 % of the errors
lie.
"""

from dataclasses import replace
from functools import lru_cache
from typing import Final

import numpy as np

from handeye.arm.dynamics import gravity
from handeye.arm.model import ArmModel, constants
from handeye.core.pose import Array

MASS_DOUBT: Final = 0.05  # of a link's mass; chosen
PLAUSIBLE: Final = 6 * MASS_DOUBT
"""Greatest plausible relative error of the weight of a link. Our choice, well above the errors that occur: 9 % in
nominal worlds, and 17 % in worlds with twice the errors.
"""
TORQUE_DOUBT: Final = 0.002  # of a drive's greatest torque: half a step of 8 bits


@lru_cache(maxsize=64)
def weighed(arm: ArmModel, factors: tuple[float, ...]) -> ArmModel:
    """Return the arm with its link masses multiplied by `factors`."""
    joints = zip(arm.joints, factors, strict=True)
    return replace(arm, joints=tuple(replace(joint, mass=joint.mass * factor) for joint, factor in joints))


def mass_factors(arm: ArmModel, q: Array, unexplained: Array) -> Array:
    """Find the factors on the link masses, shape (n,), that explain the torques `unexplained` (N m or N): the torques
    that hold the arm up, less the torques that the function `gravity` computes from the model.
    """
    doubt = TORQUE_DOUBT * constants(arm).effort
    alone = [gravity(weighed(arm, tuple(one)), q) for one in np.eye(len(arm.joints)).tolist()]  # of each link
    shares = MASS_DOUBT * np.stack(alone, axis=1) / doubt[:, None]
    likeliest = shares.T @ np.linalg.solve(shares @ shares.T + np.eye(len(doubt)), unexplained / doubt)
    return np.asarray(1.0 + MASS_DOUBT * likeliest)
