"""Agreement of the two sensors of a joint: tachometer against potentiometer over a motion."""

from dataclasses import dataclass, field
from typing import Final

import numpy as np

from handeye.arm.converters import position_step
from handeye.arm.model import ArmModel, constants
from handeye.core.pose import Array

MAX_TURN_GAP: Final = 0.03
MAX_SLIDE_GAP: Final = 0.01
"""Allowed difference, rad and m, far over the stated errors of both.

Those are a step of a 12-bit converter (.0015 rad, .24 mm), the waviness of a potentiometer (.003 rad), half a step of
the tachometer's converter for five seconds (.007 rad, 1.3 mm).
"""
PATH_SHARE: Final = 0.05
"""Allowed difference as a fraction of the path: scales are off by .2 % (potentiometers), and converters lose some.

Placeholder.
"""


REST_STEPS: Final = 4
"""Converter steps that a potentiometer may change under set brakes while its tachometer reads zero.

Two for its noise, as at the high level, and more for an arm that creeps.
"""


def crept(arm: ArmModel, change: Array) -> "Disagreement | None":
    """The joint farthest from rest, if any, by the change of potentiometers under set brakes, shape (n,)."""
    excess = np.abs(change) / (REST_STEPS * position_step(arm))
    if (excess <= 1).all():
        return None
    joint = int(np.argmax(excess))
    return Disagreement(joint=joint, potentiometer=float(change[joint]), tachometer=0.0, braked=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class Disagreement:
    """Displacements of a joint (rad or m) since a motion began, or since the brakes were set, by its two sensors."""

    joint: int
    potentiometer: float
    tachometer: float
    braked: bool = False


@dataclass(slots=True, kw_only=True)
class JointAgreement:
    """The sensors of all joints from the start of a motion; arrays have shape (n,), rad and m."""

    arm: ArmModel
    start: Array  # potentiometers at the start
    rate: Array  # tachometers one period ago
    _way: Array = field(init=False)
    _path: Array = field(init=False)
    _between: Array = field(init=False)

    def __post_init__(self) -> None:
        self._way, self._path, self._between = (np.zeros(len(self.start)) for _ in range(3))

    def step(self, q: Array, qd: Array) -> Disagreement | None:
        """Compare the readings of the next servo period: the joint that disagrees most, if any.

        How the rate went between two readings is unknown: the joint went as far as with either of them, or in between,
        so half their difference is the error of their mean. Where a joint is struck, as by a casting that breaks loose,
        that is several degrees.
        """
        period = self.arm.servo.period
        gone, unknown = (self.rate + qd) / 2 * period, np.abs(qd - self.rate) / 2 * period
        self._way, self._path, self.rate = self._way + gone, self._path + np.abs(gone), qd
        self._between = self._between + unknown
        by_pot = q - self.start
        slack = np.where(constants(self.arm).prismatic, MAX_SLIDE_GAP, MAX_TURN_GAP)
        allowed = slack + PATH_SHARE * self._path + self._between
        excess = np.abs(by_pot - self._way) / allowed
        joint = int(np.argmax(excess))
        if excess[joint] <= 1:
            return None
        return Disagreement(
            joint=joint, potentiometer=float(by_pot[joint]), tachometer=float(self._way[joint])
        )
