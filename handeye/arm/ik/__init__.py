"""Inverse kinematics: joint positions for a hand pose, or the reason why there are none.

There is one solver for each structure of arm; the functions here choose the solver of the given arm.
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
    """Inverse kinematics of one structure; each function raises ValueError for an arm of another structure."""

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
    """Joint positions for the hand at `X_WT`: the branch within the joint limits that is nearest to `near`.

    Distance is the sum of the joints' travel times. Joints that do not affect the pose stay as in `near`; held
    joints stay at their fixed positions. If a pose is out of reach only by rounding, the solution is the nearest
    one within the limits.
    """
    found = _SOLVERS[arm.structure].solve(arm, X_WT, near)
    if found.q is not None:
        return found
    every, exist = branches(arm, X_WT, arm.middle)
    q = nearest_within(arm, X_WT, every[exist])
    return found if q is None else IKResult(q=q)


def branches(arm: ArmModel, X_WT: Pose, start: Array | None = None) -> tuple[Array, NDArray[np.bool_]]:
    """All closed-form solutions for hand poses of shape (..., 4, 4), ignoring joint limits.

    Returns joint positions (..., k, n), revolute ones in (-pi, pi], and a mask of the branches that exist, (...,
    k). Free joints, which do not affect the pose, and held joints stay as in `start`, where a motion along the
    poses begins. Without `start`, free joints are 0 and held joints at their fixed positions.
    """
    return _SOLVERS[arm.structure].branches(arm, X_WT, start)


def singular(arm: ArmModel, q_start: Array, q: Array, V: Array) -> tuple[int, InLine] | None:
    """The first of N configurations of a branch that is singular for the wanted twist of the hand, with the reason;
    None if there is none.

    `V` are twists at T in world axes, shape (N, 6), of a motion that begins at `q_start`.
    """
    return _SOLVERS[arm.structure].singular(arm, q_start, q, V)


def rates(arm: ArmModel, q: Array, J: Array, V: Array) -> Array:
    """Joint rates, (N, n), for twists `V` at T in world axes, (N, 6), at configurations that are not singular; `J`
    is the Jacobian at `q`.
    """
    return _SOLVERS[arm.structure].rates(arm, q, J, V)
