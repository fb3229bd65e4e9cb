"""Set-points of a motion, one per servo period, and the check that they are within the limits of the arm."""

from dataclasses import dataclass

import numpy as np

from handeye.arm.ik import IKResult
from handeye.arm.ik.result import SLACK, beyond
from handeye.arm.kinematics import forward
from handeye.arm.model import ArmModel
from handeye.core.pose import Array, Pose
from handeye.program.diagnosis.reach import BelowTable


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Samples:
    """Set-points at the ends of servo periods 1 to N: joint positions, rates and accelerations. Each array has
    shape (N, n), in rad and m.
    """

    q: Array
    qd: Array
    qdd: Array

    def __len__(self) -> int:
        return len(self.q)


def length(X_WT: Pose) -> float:
    """Return the length (m) of the path of the hand along poses, shape (N, 4, 4)."""
    return float(np.linalg.norm(np.diff(X_WT[:, :3, 3], axis=0), axis=1).sum())


def check_samples(arm: ArmModel, samples: Samples, *, floor: float | None = None) -> IKResult | None:
    """Check set-points against the joint limits, and the height of the hand against `floor` (m).

    Returns None if all set-points are within the limits. If not, returns three values: the first joint that is beyond
    its limit, the extreme position of this joint, and the place on the path where this position occurs.
    """
    excess = np.maximum(samples.q - arm.upper, arm.lower - samples.q)
    bad = excess > SLACK
    if bad.any():
        tick = int(np.argmax(bad.any(axis=1)))
        joint = int(np.argmax(bad[tick]))
        worst = float(samples.q[np.argmax(excess[:, joint]), joint])
        along = length(forward(arm, samples.q[: tick + 1]))
        return IKResult(reason=beyond(arm.joints[joint], joint, worst), along=along)
    if floor is not None:
        height = float(forward(arm, samples.q)[:, 2, 3].min(initial=floor))
        if height < floor - SLACK:
            return IKResult(reason=BelowTable(floor - height))
    return None
