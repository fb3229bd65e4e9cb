"""The one entrance to the inverse kinematics of any arm, and what a solver of a structure has to give."""

from collections.abc import Mapping
from typing import Final, Protocol

import numpy as np
from numpy.typing import NDArray

from handeye.arm.ik import cartesian, gantry, spherical_wrist
from handeye.arm.ik.result import IKResult
from handeye.arm.model import ArmModel, Structure
from handeye.core.pose import Array, Pose
from handeye.program.reasons import InLine


class Solver(Protocol):
    """The inverse kinematics of a structure. Raises ValueError for an arm that is built otherwise."""

    def solve(self, arm: ArmModel, X_WT: Pose, near: Array, /) -> IKResult:
        """As `solve` of this module."""
        ...

    def branches(self, arm: ArmModel, X_WT: Pose, start: Array | None, /) -> tuple[Array, NDArray[np.bool_]]:
        """As `branches` of this module."""
        ...

    def singular(self, arm: ArmModel, q_start: Array, q: Array, V: Array, /) -> tuple[int, InLine] | None:
        """As `singular` of this module."""
        ...

    def rates(self, arm: ArmModel, q: Array, J: Array, V: Array, /) -> Array:
        """As `rates` of this module."""
        ...


_SOLVERS: Final[Mapping[Structure, Solver]] = {
    "spherical wrist": spherical_wrist,
    "gantry": gantry,
    "cartesian": cartesian,
}


def solve(arm: ArmModel, X_WT: Pose, near: Array) -> IKResult:
    """Joint positions that put the hand at `X_WT`: the branch inside the limits that is nearest to `near`.

    Nearest in the sum of travel times of the joints. What the pose leaves open stays as in `near`, except joints that
    are held: they go to where they are held.

    Args:
        X_WT: shape (4, 4).
        near: shape (n,), rad and m.
    """
    return _SOLVERS[arm.structure].solve(arm, X_WT, near)


def branches(arm: ArmModel, X_WT: Pose, start: Array | None = None) -> tuple[Array, NDArray[np.bool_]]:
    """All closed-form solutions for poses of shape (..., 4, 4), limits not considered.

    Args:
        start: where a motion along the poses begins, shape (n,): what they leave open, and joints that are held, stay
            as there. None: the former are 0, the latter where they are held.

    Returns:
        joint positions (..., k, n), revolute ones in (-pi, pi], and which exist, (..., k).
    """
    return _SOLVERS[arm.structure].branches(arm, X_WT, start)


def singular(arm: ArmModel, q_start: Array, q: Array, V: Array) -> tuple[int, InLine] | None:
    """The first of N configurations in which the joints cannot give the hand its twist, and why; None: none.

    Args:
        q_start: where the motion begins, shape (n,).
        q: the configurations of one branch, shape (N, n).
        V: twists at T in world axes, shape (N, 6).
    """
    return _SOLVERS[arm.structure].singular(arm, q_start, q, V)


def rates(arm: ArmModel, q: Array, J: Array, V: Array) -> Array:
    """Joint rates that give the hand its twist, where that is not singular; shape (N, n).

    Args:
        q: shape (N, n).
        J: Jacobian at T, shape (N, 6, n).
        V: twists at T in world axes, shape (N, 6).
    """
    return _SOLVERS[arm.structure].rates(arm, q, J, V)
