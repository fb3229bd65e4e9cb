"""Set-points of a motion, one per servo period, and whether the arm can be there."""

from dataclasses import dataclass

import numpy as np

from handeye.arm.kinematics import SLACK, IKResult, forward
from handeye.arm.model import ArmModel
from handeye.pose import Array, Pose


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Samples:
    """Where the joints are to be at the end of servo periods 1 to N; each shape (N, n), rad and m, per s."""

    q: Array
    qd: Array
    qdd: Array

    def __len__(self) -> int:
        return len(self.q)


def length(X_WT: Pose) -> float:
    """How far the hand goes over poses of shape (N, 4, 4), m."""
    return float(np.linalg.norm(np.diff(X_WT[:, :3, 3], axis=0), axis=1).sum())


def check_samples(arm: ArmModel, samples: Samples, *, floor: float | None = None) -> IKResult | None:
    """What the arm cannot take: a joint beyond its limit, or the hand below `floor` (m).

    Returns:
        None if all can be taken; else how far the joint that is first beyond its limit goes, and where it passes it.
    """
    beyond = np.maximum(samples.q - arm.upper, arm.lower - samples.q)
    bad = beyond > SLACK
    if bad.any():
        tick = int(np.argmax(bad.any(axis=1)))
        joint = int(np.argmax(bad[tick]))
        x, lower, upper = samples.q[np.argmax(beyond[:, joint]), joint], arm.lower[joint], arm.upper[joint]
        return IKResult(
            reason="out of reach" if arm.joints[joint].kind == "prismatic" else "joint limit", joint=joint,
            amount=float(x), limit=float(upper if x > upper else lower),
            along=length(forward(arm, samples.q[: tick + 1])),
        )  # fmt: skip
    if floor is not None:
        height = float(forward(arm, samples.q)[:, 2, 3].min(initial=floor))
        if height < floor:
            return IKResult(reason="below the table", amount=height, limit=floor)
    return None
