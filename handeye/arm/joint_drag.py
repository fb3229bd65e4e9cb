"""Torques that joints take beyond weight, inertia and load: whether one joint or a force at the hand explains them.

In free air what is left is friction: it has the sign of the rate, so that half the difference between what a joint
takes one way and the other is its friction, whatever weight is not as modelled (as in
`execution.friction_measurement`).

A force that meets the hand is felt by several joints at once, as J^T F. What one joint alone takes would be, of a
wrench at the hand, a couple or a force at the wrist centre: its arm about the tool centre point is longer than any
finger. The limits of this: what meets the arm at its wrist centre looks like a joint; and of a hand that points down
under a level boom, a push upwards and a shoulder that does not lift are the same, which counts as a push.
"""

from dataclasses import dataclass, field
from typing import Final

import numpy as np

from handeye.arm.computed_torque import external_wrench
from handeye.arm.converters import rate_step, torque_step
from handeye.arm.model import ArmModel, constants
from handeye.core.pose import Array

SLIDING_STEPS: Final = 4.0  # tachometer steps from which on a joint surely slides; chosen
LEAST_PERIODS: Final = (
    15  # servo periods of sliding that an average needs; chosen: a torque step wavers less by 4
)
MAX_DRAG_RATIO: Final = 2.0
"""Greatest plausible ratio of a joint's friction to what was measured first, beside half a step of the converter.

Measured friction is right within a quarter of a step and 2 %, and so is what a motion takes: at twice the stated errors
up to 1.08 times and half a step. The rest is left to weight that differs between one way and the other. Sound joints of
twelve worlds reach 1.4."""
DAMPING_DOUBT: Final = 0.6  # of the viscous friction: its stated spread at twice its size
WEIGHT_DOUBT: Final = 0.2
"""Fraction of weight and inertia torques that may be wrong where a joint went one way only: masses, mass centres and
drives at three times twice their stated spreads."""
AT_HAND: Final = 0.15
"""Longest arm about the tool centre point (m) of a force that meets the hand or what it holds. Chosen: beyond the palm,
and short of the wrist centre."""
ALONE: Final = 0.9  # share of the squares of all unexplained torques that one joint must have; chosen


@dataclass(frozen=True, slots=True, kw_only=True)
class Stiffness:
    """A joint, and the torque (N m, N if prismatic) that it takes against its motion beside what it should."""

    joint: int
    torque: float
    friction: float  # what it took at first
    one_way: bool  # it slid one way only, so that a weight beside the model's would feel the same


@dataclass(slots=True, kw_only=True)
class JointDrag:
    """Unexplained torques of a motion, averaged by the way in which each joint slides; arrays of shape (2, n)."""

    arm: ArmModel
    _sum: Array = field(init=False)
    _periods: Array = field(init=False)
    _rate: Array = field(init=False)
    _weight: Array = field(init=False)

    def __post_init__(self) -> None:
        self._sum, self._periods, self._rate, self._weight = (
            np.zeros((2, len(self.arm.joints))) for _ in range(4)
        )

    def step(self, spare: Array, modelled: Array, rate: Array) -> None:
        """Add a servo period: unexplained and modelled torques, and rates, shape (n,)."""
        least = SLIDING_STEPS * rate_step(self.arm)
        for way, sliding in enumerate((rate > least, rate < -least)):
            self._sum[way] += np.where(sliding, spare, 0.0)
            self._weight[way] += np.where(sliding, np.abs(modelled), 0.0)
            self._rate[way] += np.where(sliding, np.abs(rate), 0.0)
            self._periods[way] += sliding

    def stiff(self, friction: Array) -> Stiffness | None:
        """The joint, if any, that takes far more than the `friction` (n,) that was measured."""
        enough = self._periods >= LEAST_PERIODS
        periods = np.maximum(self._periods, 1.0)
        mean, rate, weight = (each / periods for each in (self._sum, self._rate, self._weight))
        both = enough.all(axis=0)
        one = np.where(enough[0], mean[0], -mean[1])
        drag = np.where(both, (mean[0] - mean[1]) / 2, np.where(enough.any(axis=0), one, 0.0))
        allowed = MAX_DRAG_RATIO * friction + torque_step(self.arm) / 2
        allowed = allowed + DAMPING_DOUBT * constants(self.arm).damping * np.where(enough, rate, 0.0).max(
            axis=0
        )
        allowed = allowed + np.where(both, 0.0, WEIGHT_DOUBT * np.where(enough, weight, 0.0).max(axis=0))
        joint = int(np.argmax(drag / allowed))
        if drag[joint] <= allowed[joint]:
            return None
        return Stiffness(
            joint=joint,
            torque=float(drag[joint]),
            friction=float(friction[joint]),
            one_way=not enough[:, joint].all(),
        )


def alone(arm: ArmModel, J: Array, spare: Array) -> int | None:
    """The joint that alone takes torques (n,), unless they are those of a force that meets the hand; see above."""
    wrench = external_wrench(J, spare)
    if float(np.linalg.norm(wrench[3:])) <= AT_HAND * float(np.linalg.norm(wrench[:3])):
        return None
    parts = (spare / torque_step(arm)) ** 2
    joint = int(np.argmax(parts))
    return joint if parts[joint] >= ALONE * parts.sum() > 0 else None
