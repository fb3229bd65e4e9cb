"""Kinematics and dynamics of an arm for Python programs. Arguments are checked.

Joint positions `q` are in rad, and in m for prismatic joints (joint 3 of the Stanford arm). W is the frame of the
table, T the frame of the hand. `arm` is the model of the arm: by default `STANFORD`, the arm of the drawing, or
`handeye.Run.arm`, the arm that a run has measured.
"""

import numpy as np
from numpy.typing import ArrayLike

from handeye.arm import dynamics, kinematics
from handeye.arm.ik import IKResult, solve
from handeye.arm.model import ArmModel
from handeye.arm.robots.stanford import STANFORD
from handeye.core.errors import BadArgument
from handeye.core.pose import Array, Pose

_RIGID = 1e-6  # by which the rotation of a pose may deviate from a rotation

__all__ = ["STANFORD", "forward", "gravity", "inverse", "jacobian", "mass_matrix"]


def forward(q: ArrayLike, arm: ArmModel | None = None) -> Pose:
    """Return the pose `X_WT` of the hand at joint positions `q`: origin midway between the finger tips, z along the
    approach direction, y along the finger line. Shape (..., n) gives shape (..., 4, 4), in m.

    Raises:
        BadArgument: `q` has the wrong number of joints, or is not finite.
    """
    return kinematics.forward(_arm(arm), _joints(q, _arm(arm)))


def inverse(X_WT: ArrayLike, near: ArrayLike | None = None, arm: ArmModel | None = None) -> IKResult:
    """Return joint positions, within the joint limits, that bring the hand to the pose `X_WT`, shape (4, 4), in m.

    Of several solutions, the result is the one that the joints reach soonest from the positions `near`, shape (n,). By
    default, `near` is the middle of the joints' ranges.

    Returns: a record with the joint positions `q`, shape (n,). If no joint positions bring the hand to the pose, `q`
    is None, and `message(arm)` gives the reason as a sentence.

    Raises:
        BadArgument: `X_WT` is not a pose, or `near` has the wrong number of joints.
    """
    model, pose = _arm(arm), _numbers(X_WT, "X_WT")
    if (
        pose.shape != (4, 4)
        or not np.allclose(pose[:3, :3] @ pose[:3, :3].T, np.eye(3), atol=_RIGID)
        or np.linalg.det(pose[:3, :3]) < 0
        or not np.array_equal(pose[3], (0.0, 0.0, 0.0, 1.0))
    ):
        raise BadArgument("X_WT must be a pose: a rotation and a position in a matrix of shape (4, 4)")
    start = model.middle if near is None else _joints(near, model, name="near")
    if start.ndim != 1:
        raise BadArgument(f"near must have shape ({len(model.joints)},), not {start.shape}")
    return solve(model, pose, start)


def jacobian(q: ArrayLike, arm: ArmModel | None = None) -> Array:
    """Return the geometric Jacobian of the hand at T in the axes of W: three rows for the velocity of the hand's
    origin (m/s), then three for the hand's angular velocity (rad/s). Shape (..., n) gives shape (..., 6, n).

    The transpose of the Jacobian converts a force (N) and a moment (N m) on the hand to joint torques.

    Raises:
        BadArgument: `q` has the wrong number of joints, or is not finite.
    """
    return kinematics.jacobian(_arm(arm), _joints(q, _arm(arm)))


def gravity(q: ArrayLike, arm: ArmModel | None = None) -> Array:
    """Return the joint torques that hold the arm up at rest, with an empty hand: shape (..., n), in N m, or in N for
    prismatic joints.

    Raises:
        BadArgument: `q` has the wrong number of joints, or is not finite.
    """
    return dynamics.gravity(_arm(arm), _joints(q, _arm(arm)))


def mass_matrix(q: ArrayLike, arm: ArmModel | None = None) -> Array:
    """Return the mass matrix of the arm, including the inertia of its drives: shape (..., n) gives shape (..., n, n).

    Raises:
        BadArgument: `q` has the wrong number of joints, or is not finite.
    """
    return dynamics.mass_matrix(_arm(arm), _joints(q, _arm(arm)))


def _arm(arm: object) -> ArmModel:
    if arm is None:
        return STANFORD
    if not isinstance(arm, ArmModel):
        raise BadArgument(f"the arm must be an ArmModel, such as handeye.arm.STANFORD, not {arm!r}")
    return arm


def _joints(given: ArrayLike, arm: ArmModel, name: str = "q") -> Array:
    q, joints = _numbers(given, name), len(arm.joints)
    if not q.ndim or q.shape[-1] != joints:
        raise BadArgument(f"{name} must have shape (..., {joints}), not {q.shape}")
    return q


def _numbers(given: ArrayLike, name: str) -> Array:
    try:
        found = np.asarray(given, dtype=np.float64)
    except (TypeError, ValueError):
        found = np.array(np.nan)
    if not np.isfinite(found).all():
        raise BadArgument(f"{name} must consist of finite numbers, not {given!r}")
    return found
