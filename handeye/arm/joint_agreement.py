"""Agreement of the two sensors of a joint: tachometer against potentiometer over a motion."""

from dataclasses import dataclass, field
from typing import Final

import numpy as np

from handeye.arm.converters import position_step, rate_step
from handeye.arm.model import ArmModel, constants
from handeye.core.pose import Array
from handeye.core.record import Record

MAX_TURN_GAP: Final = 0.0063
MAX_SLIDE_GAP: Final = 0.0011
"""Difference, rad and m, that the waviness of a potentiometer makes: twice its largest stated amplitude (.09 degrees,
.011 in), at twice the stated errors, as worlds of the high level have."""
READING_STEPS: Final = 1.5
"""Converter steps between two readings of one position: half a step each, and their noise."""
PATH_SHARE: Final = 0.013
"""Difference as a fraction of the path: three standard deviations of a potentiometer's scale (.22 %), twice."""
JUMP_STEPS: Final = 4.0
"""Converter steps between two readings a servo period apart that the tachometer does not show.

A step by rounding, and five standard deviations of the noise (.2 steps a reading, at the high level .4).
"""
STRUCK: Final = 3.0
"""How many times as far as by half the change of its rate a joint that is struck may go in a servo period. Chosen."""


REST_STEPS: Final = 4
"""Converter steps that a potentiometer may change under set brakes while its tachometer reads zero.

Two for its noise, as at the high level, and more for an arm that creeps.
"""


class Disagreement(Record, frozen=True, kw_only=True):
    """Displacements of a joint (rad or m) since a motion began, or since the brakes were set, by its two sensors."""

    joint: int
    potentiometer: float
    tachometer: float
    braked: bool = False


def crept(arm: ArmModel, change: Array) -> Disagreement | None:
    """The joint farthest from rest, if any, by the change of potentiometers under set brakes, shape (n,)."""
    excess = np.abs(change) / (REST_STEPS * position_step(arm))
    if (excess <= 1).all():
        return None
    joint = int(np.argmax(excess))
    return Disagreement(joint=joint, potentiometer=float(change[joint]), tachometer=0.0, braked=True)


@dataclass(slots=True, kw_only=True)
class JointAgreement:
    """The sensors of all joints from the start of a motion; arrays have shape (n,), rad and m."""

    arm: ArmModel
    start: Array  # potentiometers at the start
    rate: Array  # tachometers one period ago
    _way: Array = field(init=False)
    _path: Array = field(init=False)
    _between: Array = field(init=False)
    _moving: Array = field(init=False)
    _gain: Array = field(init=False)

    def __post_init__(self) -> None:
        self._clear()

    def _clear(self) -> None:
        self._way, self._path, self._between, self._moving, self._gain = (
            np.zeros(len(self.start)) for _ in range(5)
        )

    def begin_anew(self, q: Array, qd: Array) -> None:
        """Compare from these readings on, as a tool that chatters in step with the servo shakes the arm.

        Tachometers that are read once in each period then show a rate that is steady, of a joint that stands still.
        """
        self.start, self.rate = q, qd
        self._clear()

    def step(self, q: Array, qd: Array) -> Disagreement | None:
        """Compare the readings of the next servo period: the joint that disagrees most, if any.

        The mean of two rates is the rate between them for as long as it grows evenly. Where it does not, such as when
        a casting breaks loose and strikes the joint, the motion between them is unknown. What is not known in one
        period has nothing to do with what is not in the next: squares add up.
        """
        period, step = self.arm.servo.period, rate_step(self.arm)
        gone, gain = (self.rate + qd) / 2 * period, qd - self.rate
        self._way, self._path = self._way + gone, self._path + np.abs(gone)
        self._between = np.hypot(self._between, STRUCK * _unsteady(gain - self._gain, step) / 2 * period)
        self._moving = self._moving + np.where(qd != 0, step / 4 * period, 0.0)
        self.rate, self._gain = qd, gain
        by_pot = q - self.start
        slack = np.where(constants(self.arm).prismatic, MAX_SLIDE_GAP, MAX_TURN_GAP)
        slack = slack + READING_STEPS * position_step(self.arm)
        allowed = slack + PATH_SHARE * self._path + self._between + self._moving
        excess = np.abs(by_pot - self._way) / allowed
        joint = int(np.argmax(excess))
        if excess[joint] <= 1:
            return None
        return Disagreement(
            joint=joint, potentiometer=float(by_pot[joint]), tachometer=float(self._way[joint])
        )


def _unsteady(change: Array, step: Array) -> Array:
    """The part of a change that two steps of a converter do not make."""
    return np.maximum(np.abs(change) - 2 * step, 0.0)


def jumped(arm: ArmModel, by_pot: Array, before: Array, after: Array) -> Disagreement | None:
    """The joint, if any, whose potentiometer disagrees with its rates before and after a period.

    A reading that jumps shows so at once, whatever the arm does. All arrays have shape (n,).
    """
    period = arm.servo.period
    gone = (before + after) / 2 * period
    struck = STRUCK * np.abs(after - before) / 2 * period
    excess = np.abs(by_pot - gone) / (JUMP_STEPS * position_step(arm) + struck)
    joint = int(np.argmax(excess))
    if excess[joint] <= 1:
        return None
    return Disagreement(joint=joint, potentiometer=float(by_pot[joint]), tachometer=float(gone[joint]))
