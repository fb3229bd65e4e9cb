"""Compares the two sensors of each joint, tachometer and potentiometer, over a motion."""

from dataclasses import dataclass, field
from functools import lru_cache
from typing import Final

import numpy as np

from handeye.arm.converters import position_step, rate_step, torque_step
from handeye.arm.dynamics import Dynamics
from handeye.arm.model import ArmModel, constants
from handeye.core.pose import Array
from handeye.core.record import Record

MAX_TURN_GAP: Final = 0.0063
MAX_SLIDE_GAP: Final = 0.0011
"""Difference between the two sensors of a joint (rad or m) that the waviness of a potentiometer can cause: twice
the largest amplitude of the waviness. At the high level of errors, this amplitude is twice the stated one (.09
degrees, .011 in).
"""
READING_STEPS: Final = 1.5
"""Tolerance for two readings of one position, in converter steps: half a step for each, and their noise."""
PATH_SHARE: Final = 0.013
"""Tolerance for the difference between the two sensors, as a fraction of the path of the joint: three standard
deviations of the scale error of a potentiometer (.22 %), doubled.
"""
JUMP_STEPS: Final = 4.0
"""Tolerance, in converter steps, for a change of the potentiometer reading within one servo period that the
tachometer does not show.

One step for rounding, and five standard deviations of the noise (.2 steps per reading, .4 at the high level).
"""
STRUCK: Final = 3.0
"""If a joint is struck, its path in one servo period is uncertain by half the change of its rate, times the period,
times this factor. The factor is our choice.
"""


SINGULAR: Final = 0.05
"""Directions in which the joints hardly move the hand, by less than this fraction of the largest movement, are left
out when a blow is estimated from the joints. The fraction is our choice.
"""
REST_STEPS: Final = 4
"""Tolerance, in converter steps, for a change of the potentiometer reading while the brakes are set and the
tachometer reads zero.

Two steps allow for the noise at the high level, the others for an arm that creeps.
"""


UNEVEN: Final = 0.25
"""If a swing of a joint differs from the next by more than this fraction of the swing, the tachometer of the joint
is examined more closely. Our choice: of 278 measurements in three runs without faults, two were above this fraction.
"""
STILL_STEPS: Final = 2.0
"""Tolerance, in converter steps, for the median deviation of the rate readings of a joint that is held still.

A steady rate deviates by at most one step, by rounding; the stated noise is .03 steps. The other step is for an arm
that creeps.
"""


class Disagreement(Record, frozen=True, kw_only=True):
    """Displacement of a joint (rad or m) according to each of its two sensors, since a motion began or the brakes
    were set.
    """

    joint: int
    potentiometer: float
    tachometer: float
    braked: bool = False


def crept(arm: ArmModel, change: Array) -> Disagreement | None:
    """Find the joint whose potentiometer changed most while the brakes were set; `change` has shape (n,). Returns
    None if the change is tolerable.
    """
    excess = np.abs(change) / (REST_STEPS * position_step(arm))
    if (excess <= 1).all():
        return None
    joint = int(np.argmax(excess))
    return Disagreement(joint=joint, potentiometer=float(change[joint]), tachometer=0.0, braked=True)


class Scatter(Record, frozen=True, kw_only=True):
    """Scatter of the rate readings of a joint at rest, and the limit of this scatter. Both are median deviations
    from the median, in rad/s or m/s.
    """

    joint: int
    scatter: float
    limit: float


def swings_unevenly(arm: ArmModel, M: Array, dither: Array, rates: Array) -> bool:
    """Return True if the rate readings of a joint, shape (N, n), change from each swing to the next by more than two
    converter steps plus the fraction `UNEVEN` of the swing.

    The torques `dither`, shape (n,), in N m and N, shake the joints, and change sign in each servo period. The swing
    is computed for a joint without friction, from the inertia and from the damping of the servo.
    """
    period = arm.servo.period
    swing = np.abs(np.linalg.inv(M)) @ dither * period / (2 - 2 * constants(arm).frequency * period)
    change = np.median(np.abs(rates[2:] - rates[:-2]), axis=0)
    return bool((change > UNEVEN * swing + 2 * rate_step(arm)).any())


def scattered(arm: ArmModel, M: Array, friction: Array, rates: Array) -> Scatter | None:
    """Find the joint whose rate readings, shape (N, n), scatter most while the arm holds still. Returns None if all
    scatter is tolerable.

    The median ignores a single jerk, as when a held part slips. A joint whose friction, shape (n,), in N m or N, is
    less than half a step of its torque converter may swing at rest: its torque then alternates between two
    neighbouring steps. `M` is the mass matrix, shape (n, n).
    """
    scatter = np.median(np.abs(rates - np.median(rates, axis=0)), axis=0)
    swing = np.diag(np.linalg.inv(M)) * torque_step(arm) / 2 * arm.servo.period
    limit = STILL_STEPS * rate_step(arm) + np.where(friction < torque_step(arm) / 2, swing, 0.0)
    joint = int((scatter / limit).argmax())
    if scatter[joint] <= limit[joint]:
        return None
    return Scatter(joint=joint, scatter=float(scatter[joint]), limit=float(limit[joint]))


@dataclass(slots=True, kw_only=True)
class JointAgreement:
    """Compares the sensors of all joints from the start of a motion; arrays have shape (n,), in rad and m."""

    arm: ArmModel
    start: Array  # potentiometers at the start
    rate: Array  # tachometers one period ago
    _way: Array = field(init=False)
    _path: Array = field(init=False)
    _between: Array = field(init=False)
    _moving: Array = field(init=False)
    _gain: Array = field(init=False)
    _slack: Array = field(init=False)
    _creep: Array = field(init=False)
    _two_steps: Array = field(init=False)

    def __post_init__(self) -> None:
        slack = np.where(constants(self.arm).prismatic, MAX_SLIDE_GAP, MAX_TURN_GAP)
        self._slack = slack + READING_STEPS * position_step(self.arm)
        self._creep = rate_step(self.arm) / 4 * self.arm.servo.period
        self._two_steps = 2 * rate_step(self.arm)
        self._clear()

    def _clear(self) -> None:
        self._way, self._path, self._between, self._moving, self._gain = (
            np.zeros(len(self.start)) for _ in range(5)
        )

    def begin_anew(self, q: Array, qd: Array) -> None:
        """Start the comparison again from these readings. Used for a tool that chatters in step with the servo and
        shakes the arm.

        Tachometers that are read once per period then show a steady rate although the joint does not move on
        average.
        """
        self.start, self.rate = q, qd
        self._clear()

    def step(self, q: Array, qd: Array) -> Disagreement | None:
        """Compare the readings of the next servo period. Returns the joint whose sensors disagree most, or None if
        all agree.

        While the rate changes evenly, the mean of two successive rates is the mean rate in between. While the rate
        changes unevenly, for example when a casting breaks loose and strikes the joint, the motion in between is
        unknown. The unknown parts of different periods are independent, so their squares are added.
        """
        half = self.arm.servo.period / 2
        gone, gain = (self.rate + qd) * half, qd - self.rate
        self._way, self._path = self._way + gone, self._path + np.abs(gone)
        self._between = np.hypot(self._between, STRUCK * self._unsteady(gain) * half)
        self._moving = self._moving + (qd != 0) * self._creep
        self.rate, self._gain = qd, gain
        by_pot = q - self.start
        allowed = self._slack + PATH_SHARE * self._path + self._between + self._moving
        excess = np.abs(by_pot - self._way) / allowed
        joint = int(excess.argmax())
        if excess[joint] <= 1:
            return None
        return Disagreement(
            joint=joint, potentiometer=float(by_pot[joint]), tachometer=float(self._way[joint])
        )

    def _unsteady(self, gain: Array) -> Array:
        """Return the part of a change of rate that differs by more than two converter steps from the last change."""
        return np.maximum(np.abs(gain - self._gain) - self._two_steps, 0.0)


def jumped(
    arm: ArmModel, by_pot: Array, before: Array, after: Array, blow: Array | None = None
) -> Disagreement | None:
    """Find the joint whose potentiometer disagrees with its rates before and after a servo period. Returns None if
    all agree.

    A reading that jumps is detected at once, whatever the arm does. `blow` are the changes of rate that a blow on
    the hand may have caused within the period, see `blown`. All arrays have shape (n,).
    """
    half, change = arm.servo.period / 2, np.abs(after - before)
    gone = (before + after) * half
    struck = STRUCK * (change if blow is None else change + blow) * half
    excess = np.abs(by_pot - gone) / (_jump(arm) + struck)
    joint = int(excess.argmax())
    if excess[joint] <= 1:
        return None
    return Disagreement(joint=joint, potentiometer=float(by_pot[joint]), tachometer=float(gone[joint]))


@lru_cache(maxsize=16)
def _jump(arm: ArmModel) -> Array:
    return JUMP_STEPS * position_step(arm)


def blown(here: Dynamics, impulse: Array) -> Array:
    """Return the largest change of rate, shape (n,), that a blow on the hand may have caused in each joint, even if
    the joint was stopped again within the same servo period.

    `impulse`, shape (n,), N m s and N s, is the part of the change of momentum that the drives, the weight and the
    friction of the arm do not explain. It gives the impulse and the angular impulse on the hand. Their directions
    may have changed within the period, so each may have acted on each joint in the worst direction.
    """
    wrench = np.linalg.lstsq(here.J.T, impulse, rcond=SINGULAR)[0]
    force, moment = np.linalg.norm(wrench[:3]), np.linalg.norm(wrench[3:])
    lever, turn = np.linalg.norm(here.J[:3], axis=0), np.linalg.norm(here.J[3:], axis=0)
    return np.asarray(np.linalg.inv(here.M).diagonal() * (lever * force + turn * moment))
