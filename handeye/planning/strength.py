"""Loads and forces that the arm can bear and exert, standing still: by the greatest torques of its joints."""

from dataclasses import dataclass

import numpy as np

from handeye.arm.dynamics import gravity
from handeye.arm.kinematics import jacobian
from handeye.arm.model import ArmModel, constants
from handeye.core.pose import Array


@dataclass(frozen=True, slots=True, kw_only=True)
class Weakness:
    """A force or moment of the hand that is beyond the arm."""

    joint: int
    """The one that gives out first, from 0."""
    most: float
    """How large it could be, N or N m."""


def weakness(
    arm: ArmModel, q: Array, wanted: Array, *, turning: bool = False, weight: float = 0.0
) -> Weakness | None:
    """Find where the hand cannot exert a force in any of the configurations `q`, shape (N, n).

    Args:
        wanted: N, table axes, shape (3,); a moment (N m) if `turning`.
        weight: N, of what the hand carries besides.

    Returns:
        None if it can.
    """
    size = float(np.linalg.norm(wanted))
    if size == 0.0:
        return None
    J = np.swapaxes(jacobian(arm, q), -1, -2)
    torque = J[..., 3:] @ wanted if turning else J[..., :3] @ wanted
    left = constants(arm).effort - np.sign(torque) * (gravity(arm, q) + J[..., 2] * weight)
    share = np.maximum(left, 0.0) / np.maximum(np.abs(torque), 1e-12)
    joint = int(np.argmin(share.min(axis=0)))
    least = float(share.min())
    return None if least >= 1.0 else Weakness(joint=joint, most=size * least)
