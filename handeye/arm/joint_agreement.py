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
"""Difference between the two sensors of a joint (rad or m) that the waviness of a potentiometer can cause: twice the
largest amplitude of the waviness. The stated amplitude is .09 degrees or .011 in; at the high level of errors, the
amplitude is twice as large.
"""
READING_STEPS: Final = 1.5
"""Permitted difference between two readings of one position, in converter steps: half a step for each reading, and the
noise of both.
"""
PATH_SHARE: Final = 0.013
"""Tolerance for the difference between the two sensors, as a fraction of the path of the joint: three standard
deviations of the scale error of a potentiometer in a world of the level `high`. The stated standard deviation is .22
%, and the level `high` doubles it.
"""
JUMP_STEPS: Final = 4.0
"""Tolerance for the difference between the motions that the two sensors show in one servo period, in converter steps
of the potentiometer. The tolerance is one step for rounding, plus five standard deviations of the noise in the
difference of two readings at the high level. The noise of one reading is .2 steps, and .4 steps at the high level.
"""
STRUCK: Final = 3.0
"""If a joint is struck, its path in one servo period is uncertain by this factor, times the change of the joint's
rate, times half the period. The factor is our choice.
"""


SINGULAR: Final = 0.05
"""When a blow is estimated from the joints, some directions are left out: those in which the joints move the hand by
less than this fraction of the largest movement. The fraction is our choice.
"""
REST_STEPS: Final = 4
"""Tolerance, in converter steps, for a change of the potentiometer reading while the brakes are set and the
tachometer reads zero.

Two of these steps allow for the noise in a world whose errors have the level `high`. The other two allow for an arm
that creeps.
"""


UNEVEN: Final = 0.25
"""If two successive swings of a joint differ by more than two converter steps plus this fraction of the computed
swing, the tachometer of the joint is examined more closely. Our choice: in three runs without faults, the difference
was above this fraction in two of 278 measurements.
"""
STILL_STEPS: Final = 2.0
"""Tolerance, in converter steps, for the median deviation of the rate readings of a joint that is held still.

One of the two steps is for rounding: the rounded reading of a steady rate deviates by at most one step. The stated
noise is only .03 steps. The second step is for an arm that creeps.
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
    """Scatter of the rate readings of a joint at rest, and the limit of this scatter. Scatter and limit are median
    deviations from the median, in rad/s or m/s.
    """

    joint: int
    scatter: float
    limit: float


def swings_unevenly(arm: ArmModel, M: Array, dither: Array, rates: Array) -> bool:
    """Return True if a joint swings unevenly. A joint does so if its rate readings differ between successive swings by
    more than a tolerance: two converter steps plus the fraction `UNEVEN` of the size of a swing. `rates` has shape (N,
    n).

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

    The scatter is the median distance of the readings from their own median, so a single jerk, for example when a held
    part slips, has no effect. A joint may swing at rest if its friction is less than half a step of its torque
    converter: its torque then alternates between two neighbouring steps. `friction` has shape (n,), in N m or N. `M`
    is the mass matrix, shape (n, n).
    """
    scatter = np.median(np.abs(rates - np.median(rates, axis=0)), axis=0)
    swing = np.diag(np.linalg.inv(M)) * torque_step(arm) / 2 * arm.servo.period
    limit = STILL_STEPS * rate_step(arm) + np.where(friction < torque_step(arm) / 2, swing, 0.0)
    joint = int((scatter / limit).argmax())
    if scatter[joint] <= limit[joint]:
        return None
    return Scatter(joint=joint, scatter=float(scatter[joint]), limit=float(limit[joint]))


@dataclass(slots=True, kw_only=True)
class _SensorPair:
    """Compares the two sensors of one joint in each servo period of a motion. The values are floats, which are faster
    than arrays for the few joints of an arm.
    """

    start: float  # potentiometer at the start
    rate: float  # tachometer one period ago
    slack: float  # difference that is always tolerable
    creep: float  # further tolerance for each period in which the joint moves
    steady: float  # change of the gain in rate that rounding may cause
    half: float  # half of a servo period, in s
    way: float = 0.0
    _path: float = 0.0
    between: float = 0.0  # unknown motion between the readings
    _moving: float = 0.0
    _gain: float = 0.0

    def step(self, q: float, qd: float) -> float:
        """Compare the readings of the next servo period. Returns the difference between the sensors as a multiple of
        the tolerated difference.
        """
        gone, gain = (self.rate + qd) * self.half, qd - self.rate
        self.way += gone
        self._path += abs(gone)
        unsteady = abs(gain - self._gain) - self.steady
        if unsteady > 0:
            self.between = float(np.hypot(self.between, STRUCK * unsteady * self.half))
        if qd:
            self._moving += self.creep
        self.rate, self._gain = qd, gain
        allowed = self.slack + PATH_SHARE * self._path + self.between + self._moving
        return abs(q - self.start - self.way) / allowed


@dataclass(slots=True, kw_only=True)
class JointAgreement:
    """Compares the sensors of all joints from the start of a motion; arrays have shape (n,), in rad and m."""

    arm: ArmModel
    start: Array  # potentiometers at the start
    rate: Array  # tachometers at the start
    _pairs: list[_SensorPair] = field(default_factory=list, init=False)  # empty at the start

    def begin_anew(self, q: Array, qd: Array) -> None:
        """Start the comparison again from these readings. The servo does this while a running tool shakes the arm.

        It can happen that a tool shakes the arm exactly once in each servo period. Tachometers that are read once per
        period then show a steady rate although the joint does not move on average.
        """
        self.start, self.rate, self._pairs = q, qd, []

    def step(self, q: Array, qd: Array, unseen: Array | None = None) -> Disagreement | None:
        """Compare the readings of the next servo period. Returns the joint whose sensors disagree most, or None if
        all agree.

        When an object shifts in the fingers, the joints may move farther than their rates show (see `thrown`).
        `unseen`, shape (n,), is this additional motion in the period.

        While the rate changes evenly, the mean of two successive rates is the mean rate of the period between them.
        While the rate changes unevenly, for example when a casting breaks loose and strikes the joint, the motion in
        between is unknown. The unknown parts of different periods are independent, so their squares are added.
        """
        self._pairs = self._pairs or self._begun()
        if unseen is not None:
            for pair, leap in zip(self._pairs, unseen.tolist(), strict=True):
                pair.between = float(np.hypot(pair.between, leap))
        found = list(map(_SensorPair.step, self._pairs, q.tolist(), qd.tolist()))
        if all(excess <= 1 for excess in found):  # not true for NaN
            return None
        joint = int(np.argmax(found))
        pair = self._pairs[joint]
        return Disagreement(joint=joint, potentiometer=float(q[joint]) - pair.start, tachometer=pair.way)

    def _begun(self) -> list[_SensorPair]:
        readings, half = zip(self.start.tolist(), self.rate.tolist(), strict=True), self.arm.servo.period / 2
        return [
            _SensorPair(start=start, rate=rate, slack=slack, creep=creep, steady=steady, half=half)
            for (start, rate), (slack, creep, steady) in zip(readings, _tolerances(self.arm), strict=True)
        ]


@lru_cache(maxsize=16)
def _tolerances(arm: ArmModel) -> list[tuple[float, float, float]]:
    """Return `slack`, `creep` and `steady` for each joint: the tolerances of its two sensors."""
    slack = np.where(constants(arm).prismatic, MAX_SLIDE_GAP, MAX_TURN_GAP) + READING_STEPS * position_step(
        arm
    )
    creep, steady = rate_step(arm) / 4 * arm.servo.period, 2 * rate_step(arm)
    return list(zip(slack.tolist(), creep.tolist(), steady.tolist(), strict=True))


def jumped(
    arm: ArmModel,
    by_pot: Array,
    before: Array,
    after: Array,
    blow: Array | None = None,
    throw: Array | float = 0.0,
) -> Disagreement | None:
    """Find the joint whose potentiometer moved in a servo period by a distance that contradicts the rates before and
    after this period. Returns None if the sensors of all joints agree.

    A reading that jumps is detected at once, whatever the arm does. `blow` gives the changes of rate that a blow on
    the hand may have caused within the period (see `blown`). `throw` is the distance that the joints may have moved
    because an object shifted in the fingers (see `thrown`). All arrays have shape (n,).
    """
    half, change = arm.servo.period / 2, np.abs(after - before)
    gone = (before + after) * half
    struck = STRUCK * (change if blow is None else change + blow) * half
    excess = np.abs(by_pot - gone) / (_jump(arm) + struck + throw)
    joint = int(excess.argmax())
    if excess[joint] <= 1:
        return None
    return Disagreement(joint=joint, potentiometer=float(by_pot[joint]), tachometer=float(gone[joint]))


@lru_cache(maxsize=16)
def _jump(arm: ArmModel) -> Array:
    return JUMP_STEPS * position_step(arm)


def blown(here: Dynamics, impulse: Array) -> Array:
    """Return the largest change of rate, shape (n,), that a blow on the hand may have caused in each joint. At the end
    of the servo period, this change may be gone, because something may have stopped the joint by then.

    `impulse`, shape (n,), N m s and N s, is the part of the change of momentum that the drives, the weight and the
    friction of the arm do not explain. The impulse and the angular impulse on the hand are computed from this part.
    The directions of both impulses may have changed within the period, so each impulse may have acted on each joint in
    the worst direction.
    """
    wrench = np.linalg.lstsq(here.J.T, impulse, rcond=SINGULAR)[0]
    force, moment = np.linalg.norm(wrench[:3]), np.linalg.norm(wrench[3:])
    lever, turn = np.linalg.norm(here.J[:3], axis=0), np.linalg.norm(here.J[3:], axis=0)
    return np.asarray(np.linalg.inv(here.M).diagonal() * (lever * force + turn * moment))


def thrown(M: Array, work: float, period: float) -> Array:
    """Return the distance that each joint can move within a servo period (s) if `work` (J) is done on the hand; shape
    (n,), in rad and m.

    If an object shifts in the fingers, the fingers close a little and do work, which throws the hand.
    The object may stop the hand again within the period, so afterwards neither rate nor momentum shows the throw. A
    joint moves farthest if all the work becomes motion of this joint, at the beginning of the period. `M` is the mass
    matrix, shape (n, n).
    """
    return np.asarray(period * np.sqrt(2 * work * np.linalg.inv(M).diagonal()))
