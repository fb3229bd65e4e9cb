"""Friction of the joints and weight of the links, measured by the arm itself before its first instruction.

The method of the textbooks: each joint goes slowly out and back over the same way, at a constant rate. What drives it
besides weight and inertia has one sign out and the other back, so that half the difference is friction. The part of it
that grows with the rate is taken out by a second, quicker pass: the line through both meets rate 0 at the Coulomb
friction (Armstrong-Helouvry, Dupont and Canudas de Wit, Automatica 30, 1994, on identification). All joints go at once,
for the friction of a joint stays in it. The mean of out and back is weight, whatever the friction.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.arm.dynamics import gravity, mass_matrix
from handeye.arm.model import ArmModel, constants
from handeye.arm.samples import Samples
from handeye.arm.weighing import PLAUSIBLE, mass_factors
from handeye.core.errors import FrictionUnknown
from handeye.core.pose import Array
from handeye.execution.drive import ArmDrive
from handeye.execution.servo_period import ServoPeriod
from handeye.execution.state import DriveState
from handeye.ports.workcell import Workcell
from handeye.program.cause_text import cause_sentence

RAMP: Final = 0.1
"""s to the constant rate, and as long again at it until the servo has taken friction up. Chosen."""
LEAST: Final = 0.5
"""Share of its way that a joint goes, or it is stuck. Chosen."""
MOST: Final = 1.8
"""Times the friction of its data that a joint may rub with. Chosen between sound joints and drives that give half of
what they are told. Measured: at most 1.61 in sixty worlds; at most 1.87 in eighty with twice the errors, of which
one goes beyond; 1.4 to 2.3 at half a drive."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Pass:
    """Out and back at a constant rate."""

    rate: float
    """Share of the greatest rate of each joint."""
    seconds: float
    """For which torques are averaged, each way."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Joints:
    """What the arm has found of itself, shape (n,) each."""

    friction: Array
    """Coulomb friction of each joint, N m and (prismatic joints) N."""
    links: Array
    """How heavy each link is, times as heavy as its model's."""


SLOW: Final = Pass(rate=0.01, seconds=0.4)
QUICK: Final = Pass(rate=0.03, seconds=0.2)
"""Chosen: some twenty steps of a 12-bit tachometer, as slow as the hand presses; 3.3 s and a way of some 2 in."""


def measure_joints(
    cell: Workcell, arm: ArmModel, state: DriveState, halt: Callable[[], bool] = lambda: False
) -> Joints:
    """Friction of the joints and weight of the links. The arm ends where it began.

    Args:
        state: of the drive: the set-point about which the arm is moved.
        halt: the panic button.

    Raises:
        FrictionUnknown: a joint did not move as it should, a link would be too light or too heavy, or a joint takes far
            more to move it than its friction.
        Halted: the panic button was hit.
    """
    periods: list[ServoPeriod] = []
    drive = ArmDrive(cell=cell, arm=arm, state=state, watch=periods.append, halt=halt)
    slow, quick = (_drag(drive, periods, way) for way in (SLOW, QUICK))
    coulomb = at_rest(slow.rubbing, quick.rubbing)
    links = mass_factors(arm, state.q, slow.weight)
    _check_weighed(arm, links)
    _check_rubbing(arm, coulomb)
    return Joints(friction=np.maximum(coulomb, 0.0), links=links)


def at_rest(slow: Array, quick: Array) -> Array:
    """Coulomb friction by the friction in both passes, shape (n,): the line through them, where it meets rate 0.

    No friction falls with the rate here: of a joint that seems so, the line of least squares that does not is level.
    """
    line = (QUICK.rate * slow - SLOW.rate * quick) / (QUICK.rate - SLOW.rate)
    level = (SLOW.seconds * slow + QUICK.seconds * quick) / (SLOW.seconds + QUICK.seconds)
    return np.asarray(np.where(quick >= slow, line, level))


def _check_weighed(arm: ArmModel, links: Array) -> None:
    """Raises FrictionUnknown if it cannot be weight alone that the drives bore."""
    doubted = int(np.argmax(np.abs(links - 1)))
    if abs(links[doubted] - 1) > PLAUSIBLE:
        joint = arm.joints[doubted].name
        raise FrictionUnknown(
            f"the links could not be weighed: that of the {joint} would be {links[doubted]:.2f} times as heavy as "
            f"drawn, so that a drive does not give the torque it is told"
        )


def _check_rubbing(arm: ArmModel, coulomb: Array) -> None:
    """Raises FrictionUnknown if a joint takes far more to move it than its data say, if they say anything."""
    stated = np.array(arm.compliance.friction)
    times = np.divide(coulomb, stated, out=np.zeros(len(stated)), where=stated > 0)
    doubted = int(np.argmax(times))
    if times[doubted] > MOST:
        raise FrictionUnknown(
            f"the {arm.joints[doubted].name} takes {times[doubted]:.1f} times the torque that its friction should: "
            f"its drive does not give what it is told, or the joint binds"
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Drag:
    """Torques beyond those of the model in a pass, shape (n,)."""

    rubbing: Array
    """They oppose the joint out and back."""
    weight: Array
    """They are the same out and back."""


def _drag(drive: ArmDrive, periods: list[ServoPeriod], way: Pass) -> _Drag:
    """Torques of a pass. The drive tells `periods` what it does."""
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
    return _Drag(rubbing=inwards * (out - back) / 2, weight=(out + back) / 2)


def _profile(way: Pass, period: float) -> Array:
    """Share of the constant rate at the end of each servo period (s): the same forwards and backwards."""
    ramp, measured = round(RAMP / period), round(way.seconds / period)
    rise = np.linspace(0.0, 1.0, ramp + 1)
    return np.concatenate((rise[1:], np.ones(measured + 2 * ramp), rise[-2::-1]))


def _stroke(q: Array, rate: Array, share: Array, period: float) -> Samples:
    """Set-points from rest at `q` to rest, at shares of a rate of each joint, shape (n,)."""
    before = np.concatenate(([0.0], share[:-1]))
    gone = np.cumsum((before + share) / 2) * period
    shares = (gone, share, (share - before) / period)
    far, fast, hard = (np.outer(each, rate) for each in shares)
    return Samples(q=q + far, qd=fast, qdd=hard)


def _go(drive: ArmDrive, samples: Samples, periods: Sequence[ServoPeriod]) -> None:
    """Follow set-points; the drive tells `periods` what it does. Raises FrictionUnknown."""
    outcome = drive.follow(samples)
    if len(periods) >= len(samples):
        _check_moved(drive.arm, samples, periods)
    if outcome.error is not None:
        why = "the drives were cut" if outcome.cause is None else cause_sentence(outcome.cause)
        raise FrictionUnknown(f"while the friction of the joints was being measured, {why}")


def _check_moved(arm: ArmModel, samples: Samples, periods: Sequence[ServoPeriod]) -> None:
    """Raises FrictionUnknown if a joint stood where the others moved."""
    wanted = samples.q[-1] - samples.q[0]
    gone = periods[-1].sensed.q - periods[0].sensed.q
    stuck = np.flatnonzero(gone / wanted < LEAST)
    if stuck.size:
        joint = arm.joints[int(stuck[0])].name
        raise FrictionUnknown(
            f"the friction of the joints could not be measured: the {joint} does not move as it is driven"
        )


def _unexplained(arm: ArmModel, periods: Sequence[ServoPeriod], period: float) -> Array:
    """Mean torque that neither weight nor inertia explains, shape (n,), from the end of the first period on."""
    before, *after = periods
    q = np.array([each.sensed.q for each in after])
    efforts = np.array([each.effort for each in after])
    gained = after[-1].sensed.qd - before.sensed.qd
    inertia = mass_matrix(arm, q.mean(axis=0)) @ gained / (len(after) * period)
    return np.asarray((efforts - gravity(arm, q)).mean(axis=0) - inertia)
