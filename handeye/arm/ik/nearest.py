"""Finds the nearest configuration within limits for a pose that is out of reach only because its numbers are
rounded.

A pose at the edge of reach need not have an exact solution if it is written with a few digits, or computed from
joints at their limits. This search finds a solution with the hand as near to the pose as the digits determine it.
"""

from collections.abc import Iterable
from typing import Final

import numpy as np
from numpy.typing import NDArray

from handeye.arm.ik.result import WRITTEN
from handeye.arm.kinematics import forward, jacobian
from handeye.arm.model import ArmModel, constants
from handeye.core.pose import Array, Pose

_STEPS: Final = 8  # each squares the error, where two joints come into line halves it
_HOPELESS: Final = 1e4  # distance, in terms of `WRITTEN`, that no step mends
_ASIDE: Final = (0.0, 3e-4, -3e-4)  # of a turn
_LEAST: Final = 1e-6  # of a step's singular values: smaller ones belong to joints in line


def nearest_within(arm: ArmModel, X_WT: Pose, starts: Iterable[Array]) -> Array | None:
    """Joint positions within limits that bring the hand within `WRITTEN` of a pose, or None; the search begins at
    the solutions `starts`.

    It also begins a little beside these solutions: where joints are in line, no first step leads to some of the
    neighbouring poses.
    """
    turn = np.where(constants(arm).prismatic, 0.0, 2 * np.pi)
    turned = [q - turn * np.round((q - arm.middle) / (2 * np.pi)) for q in starts]
    best = (np.inf, arm.middle)
    for aside in _ASIDE:
        found = (_nearest(arm, X_WT, np.clip(q + aside * turn, arm.lower, arm.upper)) for q in turned)
        best = min(best, *found, key=lambda each: each[0]) if turned else best
        if best[0] < _LEAST or best[0] > _HOPELESS:
            break
    return best[1] if best[0] <= 1.0 else None


def _nearest(arm: ArmModel, X_WT: Pose, q: Array) -> tuple[float, Array]:
    """The least distance of the hand from the pose, in multiples of `WRITTEN`, and its configuration, from
    Gauss-Newton steps within limits.
    """
    best = (np.inf, q)
    for _ in range(_STEPS):
        miss = _miss(X_WT, forward(arm, q))
        apart = float(np.linalg.norm(miss))
        if apart < best[0]:
            best = (apart, q)
        if apart > _HOPELESS:
            break
        q = _stepped(arm, q, miss)
    return best


def _miss(X_WT: Pose, X: Pose) -> Array:
    """Displacement and turn from pose `X` to the wanted pose, in multiples of `WRITTEN`; shape (6,)."""
    R = X_WT[:3, :3] @ X[:3, :3].T
    turn = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    return np.concatenate([(X_WT[:3, 3] - X[:3, 3]) / WRITTEN[0], turn / WRITTEN[1]])


def _stepped(arm: ArmModel, q: Array, miss: Array) -> Array:
    """The configuration after the step that comes nearest; a joint that would pass its limit stops at it, and the
    others compensate.
    """
    J = jacobian(arm, q) / np.repeat(WRITTEN, 3)[:, None]
    free: NDArray[np.bool_] = np.array([joint.name not in arm.held for joint in arm.joints])
    there = q.copy()
    while free.any():
        rest = miss - J @ (there - q)
        wanted = there.copy()
        wanted[free] += np.linalg.lstsq(J[:, free], rest + J[:, free] @ (there - q)[free], rcond=_LEAST)[0]
        limited = np.clip(wanted, arm.lower, arm.upper)
        passed = free & (limited != wanted)
        if not passed.any():
            return wanted
        there[passed], free = limited[passed], free & ~passed
    return there
