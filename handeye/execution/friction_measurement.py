"""Measures joint friction and link weights with the arm itself, before the first step of the program.

This is the textbook method: each joint moves slowly out and back over the same range at a constant rate. The friction
torque changes sign between the motion out and the motion back, so friction is half the difference between the two
drive torques. One part of the friction is proportional to the rate. A second, quicker pass makes it possible to remove
this part: a line through the results of both passes gives the Coulomb friction, which is the friction at rate 0. See
the section on identification in Armstrong-Helouvry, Dupont and Canudas de Wit, Automatica 30, 1994. All joints move at
the same time, because the friction of a joint appears only in the torque of that joint. The mean of the two drive
torques is the weight torque, whatever the friction.
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

RAMP: Final = 0.1  # s to reach the constant rate, and again until the servo has compensated friction; chosen
MIN_TRAVEL: Final = 0.5  # least fraction of the commanded path; a joint that moves less is stuck; chosen
MAX_RATIO: Final = 1.8
"""Greatest plausible ratio of the measured friction of a joint to the friction in the joint's data.

Almost all sound joints have a smaller ratio. If a drive gives only half of its torque, its joint often has a larger
ratio. In sixty measured worlds, the ratio of a sound joint was at most 1.61. In eighty worlds with doubled errors,
only one sound joint exceeded the limit, with a ratio of 1.87. If the drive of a joint gave half of its torque, the
ratio was 1.4 to 2.3.
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Pass:
    """A motion out and back at a constant rate. Torques are averaged over `seconds` in each direction."""

    rate: float
    seconds: float


@dataclass(frozen=True, slots=True, kw_only=True)
class JointMeasurement:
    """Coulomb friction of each joint (N m, or N if prismatic), and measured link weights divided by the weights in
    the model. Each array has shape (n,).
    """

    friction: Array
    links: Array


SLOW: Final = Pass(rate=0.01, seconds=0.4)
QUICK: Final = Pass(rate=0.03, seconds=0.2)
"""Settings of the quick pass. We chose the rate because it is about twenty steps of a 12-bit tachometer, and because
joints move at about this rate while the hand presses. The pass takes 3.3 s, and moves the hand by about 2 in.
"""


def measure_joints(
    cell: Workcell,
    arm: ArmModel,
    state: DriveState,
    halt: Callable[[], bool] = lambda: False,
    arithmetic: Callable[[ArmModel], ArmArithmetic] = Formulas,
) -> JointMeasurement:
    """Measure joint friction and link weights. The arm ends where it began.

    The arm moves back and forth around the set-point in `state`. Raises FrictionUnknown if a joint does not move as
    commanded, if its friction is far greater than stated, or if a link weight is implausible. Raises Halted if the
    panic button is pressed.
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
    """Compute the Coulomb friction of each joint. `slow` and `quick` are the friction in the slow pass and in the
    quick pass. All arrays have shape (n,).

    A line through a joint's two values gives its Coulomb friction, which is the friction at rate 0. In our model of
    friction, friction cannot fall as the rate rises. If the friction of a joint seems to fall, the function returns
    the mean of the two values, weighted by the durations of the passes.
    """
    line = (QUICK.rate * slow - SLOW.rate * quick) / (QUICK.rate - SLOW.rate)
    level = (SLOW.seconds * slow + QUICK.seconds * quick) / (SLOW.seconds + QUICK.seconds)
    return np.asarray(np.where(quick >= slow, line, level))


def _check_weighed(arm: ArmModel, links: Array) -> None:
    """Raise FrictionUnknown if a link weight is implausible."""
    doubted = int(np.argmax(np.abs(links - 1)))
    if abs(links[doubted] - 1) > PLAUSIBLE:
        joint = arm.joints[doubted].name
        raise FrictionUnknown(
            f"the measured weights of the links are not plausible: the link of the {joint} seems "
            f"{links[doubted]:.2f} times as heavy as in its drawing, so a drive does not give its commanded torque"
        )


def _check_rubbing(arm: ArmModel, coulomb: Array) -> None:
    """Raise FrictionUnknown if the measured friction of a joint is far greater than its stated friction. Joints
    without friction data are not checked.
    """
    stated = np.array(arm.compliance.friction)
    times = np.divide(coulomb, stated, out=np.zeros(len(stated)), where=stated > 0)
    doubted = int(np.argmax(times))
    if times[doubted] > MAX_RATIO:
        raise FrictionUnknown(
            f"the {arm.joints[doubted].name} needs {times[doubted]:.1f} times its stated friction torque to move: "
            f"its drive does not give the commanded torque, or the joint binds"
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class _PassTorques:
    """The torques of a pass minus the torques that the arm model explains. This difference is separated into friction
    and weight, each of shape (n,).
    """

    rubbing: Array  # opposing the motion
    weight: Array  # equal out and back


def _drag(drive: ArmDrive, periods: list[ServoPeriod], way: Pass) -> _PassTorques:
    """Execute a pass and return its torques. The servo periods of the pass are appended to `periods`."""
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
    """Return the rate at the end of each servo period, as a fraction of the constant rate of the pass. The profile is
    symmetric in time.
    """
    ramp, measured = round(RAMP / period), round(way.seconds / period)
    rise = np.linspace(0.0, 1.0, ramp + 1)
    return np.concatenate((rise[1:], np.ones(measured + 2 * ramp), rise[-2::-1]))


def _stroke(q: Array, rate: Array, share: Array, period: float) -> Samples:
    """Return the set-points of a motion from rest at `q` to rest. `rate`, shape (n,), is the constant rate;
    `share` is the fraction of this rate that is reached at the end of each servo period.
    """
    before = np.concatenate(([0.0], share[:-1]))
    gone = np.cumsum((before + share) / 2) * period
    shares = (gone, share, (share - before) / period)
    far, fast, hard = (np.outer(each, rate) for each in shares)
    return Samples(q=q + far, qd=fast, qdd=hard)


def _go(drive: ArmDrive, samples: Samples, periods: Sequence[ServoPeriod]) -> None:
    """Follow set-points. Raises FrictionUnknown if the motion fails."""
    outcome = drive.follow(samples)
    if len(periods) >= len(samples):
        _check_moved(drive.arm, samples, periods)
    if outcome.error is not None:
        why = "the drives were cut off" if outcome.cause is None else cause_sentence(outcome.cause)
        raise FrictionUnknown(f"while measuring joint friction, {why}")


def _check_moved(arm: ArmModel, samples: Samples, periods: Sequence[ServoPeriod]) -> None:
    """Raise FrictionUnknown if a joint did not move."""
    wanted = samples.q[-1] - samples.q[0]
    gone = periods[-1].sensed.q - periods[0].sensed.q
    stuck = np.flatnonzero(gone / wanted < MIN_TRAVEL)
    if stuck.size:
        joint = arm.joints[int(stuck[0])].name
        raise FrictionUnknown(f"joint friction could not be measured: the {joint} does not move as commanded")


def _unexplained(arm: ArmModel, periods: Sequence[ServoPeriod], period: float) -> Array:
    """Subtract the torques of weight and inertia from the mean torque of each joint, and return the differences, shape
    (n,). The mean is taken over the time after the first servo period.
    """
    before, *after = periods
    q = np.array([each.sensed.q for each in after])
    efforts = np.array([each.effort for each in after])
    gained = after[-1].sensed.qd - before.sensed.qd
    inertia = mass_matrix(arm, q.mean(axis=0)) @ gained / (len(after) * period)
    return np.asarray((efforts - gravity(arm, q)).mean(axis=0) - inertia)
