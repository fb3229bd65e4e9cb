"""Motion of a single joint, the others held."""

from typing import Final

import numpy as np

from handeye.arm.ik import IKResult
from handeye.arm.model import ArmModel
from handeye.arm.samples import Samples, check_samples
from handeye.core.pose import Array
from handeye.program.diagnosis.reach import HeldJoint

_PEAK_SPEED: Final = 1.875
"""Peak rate of the quintic 10 s3 - 15 s4 + 6 s5, over its mean."""
_PEAK_ACCELERATION: Final = 5.774  # over distance / duration2


def jog(arm: ArmModel, q: Array, joint: int, goal: float, *, speed: float) -> Samples | IKResult:
    """Set-points of a smooth motion of one joint to `goal` (rad or m), or why there are none.

    Args:
        q: initial configuration, shape (n,).
        joint: index from 0.
        speed: fraction of the joint's rate limit; its square applies to the acceleration.
    """
    if arm.joints[joint].name in arm.held:
        return IKResult(reason=HeldJoint(joint, arm.held[arm.joints[joint].name]))
    distance, limits, period = goal - q[joint], arm.joints[joint], arm.servo.period
    least = max(
        _PEAK_SPEED * abs(distance) / (speed * limits.speed),
        float(np.sqrt(_PEAK_ACCELERATION * abs(distance) / (speed**2 * limits.acceleration))),
    )
    count = max(1, int(np.ceil(least / period)))
    duration, s = count * period, np.arange(1, count + 1) / count
    one = np.eye(len(q))[joint] * distance
    samples = Samples(
        q=q + np.outer(10 * s**3 - 15 * s**4 + 6 * s**5, one),
        qd=np.outer(30 * s**2 - 60 * s**3 + 30 * s**4, one) / duration,
        qdd=np.outer(60 * s - 180 * s**2 + 120 * s**3, one) / duration**2,
    )
    return check_samples(arm, samples, floor=0.0) or samples
