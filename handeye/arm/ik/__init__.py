"""Inverse kinematics: joint positions for a hand pose, or why there are none.

One solver for each structure; `solve` and its like choose the arm's.
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
    """Inverse kinematics of a structure; each function raises ValueError for an arm of another."""

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
    """Joint positions for the hand at `X_WT`: the branch within limits nearest to `near`.

    Nearest in the sum of joint travel times. Joints that the pose leaves free stay as in `near`; held joints go to
    where they are held. A pose that only rounding keeps out of reach has the solution within limits nearest to it.
    """
    found = _SOLVERS[arm.structure].solve(arm, X_WT, near)
    if found.q is not None:
        return found
    every, exist = branches(arm, X_WT, arm.middle)
    q = nearest_within(arm, X_WT, every[exist])
    return found if q is None else IKResult(q=q)


def branches(arm: ArmModel, X_WT: Pose, start: Array | None = None) -> tuple[Array, NDArray[np.bool_]]:
    """All closed-form solutions for poses of shape (..., 4, 4), ignoring limits.

    Joint positions (..., k, n), revolute ones in (-pi, pi], and which exist, (..., k). Free and held joints stay as in
    `start`, where a motion along the poses begins; without it free joints are 0, held ones where they are held.
    """
    return _SOLVERS[arm.structure].branches(arm, X_WT, start)


def singular(arm: ArmModel, q_start: Array, q: Array, V: Array) -> tuple[int, InLine] | None:
    """The first of N configurations of a branch in which joints cannot give the hand its twist, and why, or None.

    `V` are the twists at T in world axes, shape (N, 6), on a motion from `q_start`.
    """
    return _SOLVERS[arm.structure].singular(arm, q_start, q, V)


def rates(arm: ArmModel, q: Array, J: Array, V: Array) -> Array:
    """Joint rates, (N, n), for twists `V` at T in world axes, (N, 6), where not singular; `J`: Jacobian at `q`."""
    return _SOLVERS[arm.structure].rates(arm, q, J, V)
