"""Measurement of joint friction and link weights by the arm itself, before its first instruction.

The textbook method: each joint moves slowly out and back over the same range at a constant rate. Drive torque besides
weight and inertia changes sign between out and back, so half the difference is friction. Its part proportional to the
rate is removed by a second, quicker pass: the line through both meets rate 0 at the Coulomb friction (Armstrong-
Helouvry, Dupont and Canudas de Wit, Automatica 30, 1994, on identification). All joints move at once, as each one's
friction stays in it. The mean of out and back is weight, whatever the friction.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.arm.arithmetic import ArmArithmetic, Formulas
from handeye.arm.dynamics import gravity, mass_matrix
from handeye.arm.model import ArmModel, constants
from handeye.arm.samples import Samples
from handeye.arm.weighing import PLAUSIBLE, mass_factors
from handeye.core.errors import FrictionUnknown
from handeye.core.pose import Array
from handeye.execution.drive import ArmDrive
from handeye.execution.servo import ServoPeriod
from handeye.execution.state import DriveState
from handeye.ports.workcell import Workcell
from handeye.program.diagnosis.cause_text import cause_sentence

RAMP: Final = 0.1  # s to the constant rate, and again until the servo has taken friction up; chosen
MIN_TRAVEL: Final = 0.5  # fraction of its range that a joint must move, or it is stuck; chosen
MAX_RATIO: Final = 1.8
"""Greatest plausible ratio of friction to the joint's data.

Chosen between faultless joints and drives that give half of their torque. Measured: at most 1.61 in sixty worlds; at
most 1.87 in eighty with twice the errors, of which one goes beyond; 1.4 to 2.3 at half a drive.
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Pass:
    """A motion out and back at a constant rate, a fraction of the joint limits, with `seconds` averaged each way."""

    rate: float
    seconds: float


@dataclass(frozen=True, slots=True, kw_only=True)
class JointMeasurement:
    """Coulomb friction (N m, N if prismatic) of each joint, and link weights over the model's, shape (n,) each."""

    friction: Array
    links: Array


SLOW: Final = Pass(rate=0.01, seconds=0.4)
QUICK: Final = Pass(rate=0.03, seconds=0.2)
"""Chosen: some twenty steps of a 12-bit tachometer, as slow as the hand presses; 3.3 s and a range of some 2 in."""


def measure_joints(
    cell: Workcell,
    arm: ArmModel,
    state: DriveState,
    halt: Callable[[], bool] = lambda: False,
    arithmetic: Callable[[ArmModel], ArmArithmetic] = Formulas,
) -> JointMeasurement:
    """Measure joint friction and link weights; the arm ends where it began.

    The arm is moved about the set-point of `state`. Raises FrictionUnknown if a joint does not move as driven or takes
    far more torque than its friction, or if a link weight is implausible; Halted on panic.
    """
    periods: list[ServoPeriod] = []
    drive = ArmDrive(cell=cell, arm=arm, state=state, watch=periods.append, halt=halt, arithmetic=arithmetic)
    slow, quick = (_drag(drive, periods, way) for way in (SLOW, QUICK))
    coulomb = at_rest(slow.rubbing, quick.rubbing)
    links = mass_factors(arm, state.q, slow.weight)
    _check_weighed(arm, links)
    _check_rubbing(arm, coulomb)
    return JointMeasurement(friction=np.maximum(coulomb, 0.0), links=links)


def at_rest(slow: Array, quick: Array) -> Array:
    """Coulomb friction from both passes, shape (n,): the line through them at rate 0.

    Friction cannot fall with the rate here: where it seems to, the line of least squares that does not is level.
    """
    line = (QUICK.rate * slow - SLOW.rate * quick) / (QUICK.rate - SLOW.rate)
    level = (SLOW.seconds * slow + QUICK.seconds * quick) / (SLOW.seconds + QUICK.seconds)
    return np.asarray(np.where(quick >= slow, line, level))


def _check_weighed(arm: ArmModel, links: Array) -> None:
    """Raise FrictionUnknown for implausible link weights."""
    doubted = int(np.argmax(np.abs(links - 1)))
    if abs(links[doubted] - 1) > PLAUSIBLE:
        joint = arm.joints[doubted].name
        raise FrictionUnknown(
            f"the links could not be weighed: that of the {joint} would be {links[doubted]:.2f} times as heavy as "
            f"drawn, so a drive does not give its commanded torque"
        )


def _check_rubbing(arm: ArmModel, coulomb: Array) -> None:
    """Raise FrictionUnknown if a joint takes far more torque than its data say, if they say anything."""
    stated = np.array(arm.compliance.friction)
    times = np.divide(coulomb, stated, out=np.zeros(len(stated)), where=stated > 0)
    doubted = int(np.argmax(times))
    if times[doubted] > MAX_RATIO:
        raise FrictionUnknown(
            f"the {arm.joints[doubted].name} takes {times[doubted]:.1f} times the torque of its friction: its drive "
            f"does not give the commanded torque, or the joint binds"
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class _PassTorques:
    """Torques beyond the model's in a pass, shape (n,)."""

    rubbing: Array  # opposing the motion
    weight: Array  # equal out and back


def _drag(drive: ArmDrive, periods: list[ServoPeriod], way: Pass) -> _PassTorques:
    """Torques of a pass; `periods` receives the servo periods."""
    k, share = constants(drive.arm), _profile(way, drive.period)
    inwards = np.where(drive.state.q < (k.lower + k.upper) / 2, 1.0, -1.0)
    first, ramp = drive.state.q, round(RAMP / drive.period)
    driving = []
    for sense in (inwards, -inwards):
        periods.clear()
        samples = _stroke(drive.state.q, sense * way.rate * k.speed, share, drive.period)
        _go(drive, samples, periods)
        driving.append(_unexplained(drive.arm, periods[2 * ramp - 1 : len(samples) - 2 * ramp], drive.period))
    drive.state.q = first  # to the last bit
    out, back = driving
    return _PassTorques(rubbing=inwards * (out - back) / 2, weight=(out + back) / 2)


def _profile(way: Pass, period: float) -> Array:
    """Fraction of the constant rate at the end of each servo period (s), symmetric in time."""
    ramp, measured = round(RAMP / period), round(way.seconds / period)
    rise = np.linspace(0.0, 1.0, ramp + 1)
    return np.concatenate((rise[1:], np.ones(measured + 2 * ramp), rise[-2::-1]))


def _stroke(q: Array, rate: Array, share: Array, period: float) -> Samples:
    """Set-points from rest at `q` to rest, at fractions `share` of a rate of each joint, shape (n,)."""
    before = np.concatenate(([0.0], share[:-1]))
    gone = np.cumsum((before + share) / 2) * period
    shares = (gone, share, (share - before) / period)
    far, fast, hard = (np.outer(each, rate) for each in shares)
    return Samples(q=q + far, qd=fast, qdd=hard)


def _go(drive: ArmDrive, samples: Samples, periods: Sequence[ServoPeriod]) -> None:
    """Follow set-points; raises FrictionUnknown on failure."""
    outcome = drive.follow(samples)
    if len(periods) >= len(samples):
        _check_moved(drive.arm, samples, periods)
    if outcome.error is not None:
        why = "the drives were cut off" if outcome.cause is None else cause_sentence(outcome.cause)
        raise FrictionUnknown(f"while measuring joint friction, {why}")


def _check_moved(arm: ArmModel, samples: Samples, periods: Sequence[ServoPeriod]) -> None:
    """Raise FrictionUnknown if a joint stood still."""
    wanted = samples.q[-1] - samples.q[0]
    gone = periods[-1].sensed.q - periods[0].sensed.q
    stuck = np.flatnonzero(gone / wanted < MIN_TRAVEL)
    if stuck.size:
        joint = arm.joints[int(stuck[0])].name
        raise FrictionUnknown(f"joint friction could not be measured: the {joint} does not move as commanded")


def _unexplained(arm: ArmModel, periods: Sequence[ServoPeriod], period: float) -> Array:
    """Mean torque beyond weight and inertia, shape (n,), from the end of the first period on."""
    before, *after = periods
    q = np.array([each.sensed.q for each in after])
    efforts = np.array([each.effort for each in after])
    gained = after[-1].sensed.qd - before.sensed.qd
    inertia = mass_matrix(arm, q.mean(axis=0)) @ gained / (len(after) * period)
    return np.asarray((efforts - gravity(arm, q)).mean(axis=0) - inertia)
