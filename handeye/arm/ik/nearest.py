"""For a pose that is out of reach only because its numbers are rounded, finds the nearest configuration within the
joint limits.

If a pose at the edge of reach is written with few digits, or computed from joints at their limits, it can happen that
no configuration reaches the pose exactly. This search finds a configuration whose hand pose agrees with the given pose
to within the rounding of the given numbers.
"""

from collections.abc import Iterable
from typing import Final

import numpy as np
from numpy.typing import NDArray

from handeye.arm.ik.result import WRITTEN
from handeye.arm.kinematics import forward, jacobian
from handeye.arm.model import ArmModel, constants
from handeye.core.pose import Array, Pose

_STEPS: Final = 8  # each squares the error, or halves it where two joints come into line
_HOPELESS: Final = 1e4  # distance, in multiples of `WRITTEN`, from which no step helps
_ASIDE: Final = (0.0, 3e-4, -3e-4)  # of a turn
_LEAST: Final = 1e-6  # of a step's singular values: smaller ones belong to joints in line


def nearest_within(arm: ArmModel, X_WT: Pose, starts: Iterable[Array]) -> Array | None:
    """Find joint positions within the limits that bring the hand to within `WRITTEN` of a pose. Returns None if the
    search finds no positions.

    The first search begins at the solutions in `starts`. A second search begins at configurations that differ slightly
    from these solutions. The second search is needed for a solution in which joint axes are in line: from there, no
    first step leads towards some of the nearby poses.
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
    """Bring the hand towards the pose by Gauss-Newton steps within the joint limits. Returns the least distance from
    the pose, in multiples of `WRITTEN`, and the configuration that has this distance.
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
    """Return the displacement and turn from pose `X` to the wanted pose, in multiples of `WRITTEN`, shape (6,)."""
    R = X_WT[:3, :3] @ X[:3, :3].T
    turn = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    return np.concatenate([(X_WT[:3, 3] - X[:3, 3]) / WRITTEN[0], turn / WRITTEN[1]])


def _stepped(arm: ArmModel, q: Array, miss: Array) -> Array:
    """Return the configuration after the step that brings the hand nearest to the pose. If a joint would pass its
    limit, this joint stops at the limit, and the other joints compensate for the missing motion.
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
