"""Set-points of a motion, one per servo period, and whether the arm can be there."""

from dataclasses import dataclass

import numpy as np

from handeye.arm.kinematics import SLACK, IKResult, forward
from handeye.arm.model import ArmModel
from handeye.pose import Array


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Samples:
    """Where the joints are to be at the end of servo periods 1 to N; each shape (N, 6), rad and m, per s."""

    q: Array
    qd: Array
    qdd: Array

    def __len__(self) -> int:
        return len(self.q)


def check_samples(arm: ArmModel, samples: Samples, *, floor: float | None = None) -> IKResult | None:
    """The first set-point the arm cannot take: beyond a joint limit, or with the hand below `floor` (m).

    Returns:
        None if all can be taken.
    """
    beyond = np.maximum(samples.q - arm.upper, arm.lower - samples.q)
    bad = beyond > SLACK
    if bad.any():
        tick = int(np.argmax(bad.any(axis=1)))
        joint = int(np.argmax(bad[tick]))
        x, lower, upper = float(samples.q[tick, joint]), float(arm.lower[joint]), float(arm.upper[joint])
        reason = "out of reach" if arm.joints[joint].kind == "prismatic" else "joint limit"
        return IKResult(reason=reason, joint=joint, amount=x, limit=upper if x > upper else lower)
    if floor is not None:
        height = float(forward(arm, samples.q)[:, 2, 3].min(initial=floor))
        if height < floor:
            return IKResult(reason="below the table", amount=height, limit=floor)
    return None
