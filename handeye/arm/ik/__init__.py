"""Inverse kinematics: joint positions for a hand pose, or the reason why there are none.

Each kind of arm structure has its own solver. The functions of this module call the solver of the given arm.
"""

from collections.abc import Mapping
from typing import Final, Protocol

import numpy as np
from numpy.typing import NDArray

from handeye.arm.ik import cartesian, gantry, spherical_wrist
from handeye.arm.ik.nearest import nearest_within
from handeye.arm.ik.result import IKResult
from handeye.arm.model import ArmModel, Structure
from handeye.core.pose import Array, Pose
from handeye.program.diagnosis.reach import InLine

__all__ = ["IKResult", "branches", "rates", "singular", "solve"]


class Solver(Protocol):
    """Inverse kinematics of one arm structure. Each function raises ValueError for an arm of another structure."""

    def solve(self, arm: ArmModel, X_WT: Pose, near: Array, /) -> IKResult: ...

    def branches(
        self, arm: ArmModel, X_WT: Pose, start: Array | None, /
    ) -> tuple[Array, NDArray[np.bool_]]: ...

    def singular(self, arm: ArmModel, q_start: Array, q: Array, V: Array, /) -> tuple[int, InLine] | None: ...

    def rates(self, arm: ArmModel, q: Array, J: Array, V: Array, /) -> Array: ...


_SOLVERS: Final[Mapping[Structure, Solver]] = {
    "spherical wrist": spherical_wrist,
    "gantry": gantry,
    "cartesian": cartesian,
}


def solve(arm: ArmModel, X_WT: Pose, near: Array) -> IKResult:
    """Find joint positions that bring the hand to `X_WT`. Of the branches within the joint limits, the result is the
    one nearest to `near`.

    The distance between configurations is the sum of the travel times of the joints. Joints that do not affect the
    pose stay as in `near`, and held joints stay at their fixed positions. If the pose is out of reach only because its
    numbers are rounded, the result is the configuration within the limits whose pose is nearest to `X_WT`.
    """
    found = _SOLVERS[arm.structure].solve(arm, X_WT, near)
    if found.q is not None:
        return found
    every, exist = branches(arm, X_WT, arm.middle)
    q = nearest_within(arm, X_WT, every[exist])
    return found if q is None else IKResult(q=q)


def branches(arm: ArmModel, X_WT: Pose, start: Array | None = None) -> tuple[Array, NDArray[np.bool_]]:
    """Return all closed-form solutions for hand poses of shape (..., 4, 4), whether or not they are within the
    joint limits.

    The first result is joint positions, shape (..., k, n), with revolute joints in (-pi, pi]. The second result is a
    mask of the branches that exist, shape (..., k). Free joints, which do not affect the pose, and held joints stay as
    in `start`, the configuration in which a motion along the poses begins. Without `start`, free joints are 0 and held
    joints are at their fixed positions.
    """
    return _SOLVERS[arm.structure].branches(arm, X_WT, start)


def singular(arm: ArmModel, q_start: Array, q: Array, V: Array) -> tuple[int, InLine] | None:
    """Among N configurations on a branch, find the first that is singular for the wanted twist of the hand. Returns
    the index of this configuration and the reason, or None if no configuration is singular.

    `V` are the twists at T in world axes, shape (N, 6), of a motion that begins at `q_start`.
    """
    return _SOLVERS[arm.structure].singular(arm, q_start, q, V)


def rates(arm: ArmModel, q: Array, J: Array, V: Array) -> Array:
    """Return the joint rates, shape (N, n), for twists `V` at T in world axes, shape (N, 6). The configurations `q`
    must not be singular. `J` is the Jacobian at `q`.
    """
    return _SOLVERS[arm.structure].rates(arm, q, J, V)
