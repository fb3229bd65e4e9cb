"""What the arm can hold up and press with, standing still: by the greatest torques of its joints, gravity included."""

from dataclasses import dataclass

import numpy as np

from handeye.arm.dynamics import gravity
from handeye.arm.kinematics import jacobian
from handeye.arm.model import ArmModel, constants
from handeye.pose import Array


@dataclass(frozen=True, slots=True, kw_only=True)
class Weakness:
    """A force on the hand that is beyond the arm."""

    joint: int
    """The one that gives out first, from 0."""
    most: float
    """How large the force could be, N."""


def weakness(arm: ArmModel, q: Array, force: Array, weight: float = 0.0) -> Weakness | None:
    """Whether the hand cannot exert `force` (N, shape (3,), table axes) in any of the configurations `q`, (N, 6).

    Args:
        weight: N, of what the hand carries besides.

    Returns:
        None if it can.
    """
    size = float(np.linalg.norm(force))
    if size == 0.0:
        return None
    linear = np.swapaxes(jacobian(arm, q)[:, :3], -1, -2)
    torque, standing = linear @ force, gravity(arm, q) + linear @ np.array([0.0, 0.0, weight])
    left = constants(arm).effort - np.sign(torque) * standing
    share = np.maximum(left, 0.0) / np.maximum(np.abs(torque), 1e-12)
    joint = int(np.argmin(share.min(axis=0)))
    least = float(share.min())
    return None if least >= 1.0 else Weakness(joint=joint, most=size * least)
