"""Do the two sensors of a joint agree? What a tachometer has told of a motion against what its potentiometer tells."""

from dataclasses import dataclass, field
from typing import Final

import numpy as np

from handeye.arm.converters import position_step
from handeye.arm.model import ArmModel, constants
from handeye.core.pose import Array

TURNED: Final = 0.03
SLID: Final = 0.01
"""Way, rad and m, by which they may differ. Far over what both are stated to be off by: a step of a 12-bit converter
(.0015 rad, .24 mm), the waviness of a potentiometer (.003 rad), half a step of the tachometer's converter for five
seconds (.007 rad, 1.3 mm)."""
SHARE: Final = 0.05
"""Share of the way by which they may differ besides: scales off by .2 % (potentiometers), and what a converter loses.
Placeholder."""


RESTED: Final = 4
"""Steps of its converter by which a potentiometer may change under set brakes while its tachometer reads nothing: two
for its noise, as at the high level, and one for an arm that creeps."""


def crept(arm: ArmModel, change: Array) -> "Disagreement | None":
    """The joint that is farthest from rest, if any is, by the change of potentiometers under set brakes, shape (n,)."""
    excess = np.abs(change) / (RESTED * position_step(arm))
    if (excess <= 1).all():
        return None
    joint = int(np.argmax(excess))
    return Disagreement(joint=joint, potentiometer=float(change[joint]), tachometer=0.0, braked=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class Disagreement:
    """Ways of a joint (rad or m) since a motion began, by its two sensors."""

    joint: int
    potentiometer: float
    tachometer: float
    braked: bool = False
    """Since the brakes were set, that is."""


@dataclass(slots=True, kw_only=True)
class JointAgreement:
    """The sensors of all joints from the beginning of a motion on; arrays have shape (n,), rad and m."""

    arm: ArmModel
    start: Array
    """Potentiometers when the motion began."""
    rate: Array
    """Tachometers a servo period ago."""
    _way: Array = field(init=False)
    _path: Array = field(init=False)
    _between: Array = field(init=False)

    def __post_init__(self) -> None:
        self._way, self._path, self._between = (np.zeros(len(self.start)) for _ in range(3))

    def step(self, q: Array, qd: Array) -> Disagreement | None:
        """Look at the readings of the next servo period; the joint whose sensors disagree most, if any do.

        Nobody knows how the rate went from one reading to the next: between them the joint went as far as with either
        of them, or between that, and half their difference is what their mean may be wrong by. Where a joint is struck,
        as by a casting that comes off what it stuck to, that is several degrees.
        """
        period = self.arm.servo.period
        gone, unknown = (self.rate + qd) / 2 * period, np.abs(qd - self.rate) / 2 * period
        self._way, self._path, self.rate = self._way + gone, self._path + np.abs(gone), qd
        self._between = self._between + unknown
        by_pot = q - self.start
        slack = np.where(constants(self.arm).prismatic, SLID, TURNED)
        allowed = slack + SHARE * self._path + self._between
        excess = np.abs(by_pot - self._way) / allowed
        joint = int(np.argmax(excess))
        if excess[joint] <= 1:
            return None
        return Disagreement(
            joint=joint, potentiometer=float(by_pot[joint]), tachometer=float(self._way[joint])
        )
