"""Decides what explains the joint torques that remain beyond weight, inertia and load: a single joint, or a force on
the hand.

In free air the remaining torque is friction, which has the sign of the rate. If a joint moves in both directions and
carries the same weight in both, its friction is half the difference between its two torques, even if the model of the
weight is wrong (as in `execution.friction_measurement`). If the joint goes out over the table in one direction and
back near the column in the other, errors of the weight remain in the difference. What the arm has learnt of its weight
limits these errors (`torque_balance`).

A force on the hand acts on several joints at once, as J^T F. At the hand, a torque in one joint alone looks like a
couple, or like a force at the wrist centre. The lever arm of such a force about the tool centre point is longer than
any finger. The decision is therefore wrong in two cases. A force on the arm at its wrist centre looks like a fault of
a joint. If the hand points down under a level boom, an upward push looks the same as a shoulder that does not lift;
this case counts as a push.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.arm.computed_torque import external_wrench
from handeye.arm.converters import rate_step, torque_step
from handeye.arm.exertion import Exertion, columns
from handeye.arm.model import ArmModel, constants
from handeye.arm.torque_balance import weight_difference
from handeye.core.pose import Array

SLIDING_STEPS: Final = 4.0  # rate, in tachometer steps, at which a joint certainly slides; chosen
LEAST_PERIODS: Final = 15
"""A joint must slide for at least this number of servo periods before its torques are averaged. Our choice: the
rounding error of the average is then a quarter of that of a single torque.
"""
MAX_DRAG_RATIO: Final = 2.0
"""Greatest plausible ratio of a joint's present friction to the friction that was measured first. Half a converter
step is allowed in addition.

Measured friction is accurate to a quarter of a step plus 2 %, and so is the torque measured in a motion. If both
errors are twice as large as stated, the friction of a sound joint can seem to be 1.08 times its first value, plus half
a step. In twelve worlds, sound joints reached a ratio of 1.4.
"""
DAMPING_DOUBT: Final = 0.6  # of the viscous friction: its stated spread at twice its size
WEIGHT_DOUBT: Final = 0.2
"""Possible relative error of the calculated torques of weight and inertia. It counts only for a joint that slid in one
direction, because an unmodelled weight then feels like friction. The value allows for masses, mass centres and drives
whose errors are three times the spreads at the high level. At this level, every spread is twice the one that the
sources state.
"""
AT_HAND: Final = 0.15
"""Longest lever arm (m), about the tool centre point, that a force on the hand or on the held object can have. Our
choice: this distance reaches beyond the palm, but not to the wrist centre.
"""
ALONE: Final = 0.9  # share of the squares of all unexplained torques that one joint must have; chosen


@dataclass(frozen=True, slots=True, kw_only=True)
class Stiffness:
    """A joint that is too stiff. `torque` (N m; N if the joint is prismatic) is the mean torque that moved this joint,
    less the torque of the model.
    """

    joint: int
    torque: float
    friction: float  # friction torque at its first measurement
    one_way: bool  # it slid in one direction only, so an unmodelled weight would feel the same


def stiff(
    arm: ArmModel, taken: Sequence[Exertion], friction: Array, belief: Array | None = None
) -> Stiffness | None:
    """Find the joint whose resistance to a motion is much greater than its measured `friction`, shape (n,). Returns
    None if no joint is too stiff. In the periods `taken`, nothing may touch the hand: a force on the hand would count
    as friction. `arm` is the arm as weighed. `belief` is what the arm has learnt of its weight since that weighing
    (`torque_balance.balanced`).

    Torques are averaged over each direction of sliding of each joint, in arrays of shape (2, n).
    """
    postures, spare, modelled, rates = columns(taken)
    least = SLIDING_STEPS * rate_step(arm)
    sliding = np.stack((rates > least, rates < -least))  # in either direction, (2, N, n)
    counted = sliding.sum(axis=1)
    enough, periods = counted >= LEAST_PERIODS, np.maximum(counted, 1)
    mean, rate, weight = (
        (sliding * each).sum(axis=1) / periods for each in (spare, np.abs(rates), np.abs(modelled))
    )
    both = enough.all(axis=0)
    one = np.where(enough[0], mean[0], -mean[1])
    drag = np.where(both, (mean[0] - mean[1]) / 2, np.where(enough.any(axis=0), one, 0.0))
    allowed = MAX_DRAG_RATIO * friction + torque_step(arm) / 2
    allowed = allowed + DAMPING_DOUBT * constants(arm).damping * np.where(enough, rate, 0.0).max(axis=0)
    allowed = allowed + np.where(both, 0.0, WEIGHT_DOUBT * np.where(enough, weight, 0.0).max(axis=0))
    if (drag <= allowed).all():
        return None
    errors = weight_difference(arm, postures, sliding, belief)
    allowed = allowed + np.where(both, np.maximum(errors, 0.0), 0.0)
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
    """Find the single joint that explains the remaining torques `spare`, shape (n,). Returns None if a force on the
    hand explains the torques (see the module).
    """
    wrench = external_wrench(J, spare)
    if float(np.linalg.norm(wrench[3:])) <= AT_HAND * float(np.linalg.norm(wrench[:3])):
        return None
    parts = (spare / torque_step(arm)) ** 2
    joint = int(np.argmax(parts))
    return joint if parts[joint] >= ALONE * parts.sum() > 0 else None
