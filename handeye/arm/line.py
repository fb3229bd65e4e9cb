"""Motions of the hand on lines and arcs, and motions of single joints. At every set-point, joint positions and rates
are computed exactly.
"""

import math
from dataclasses import replace

import numpy as np

from handeye.arm.ik import IKResult, branches, rates, singular, solve
from handeye.arm.kinematics import chain, drift, forward, tool_jacobian
from handeye.arm.model import ArmModel, constants
from handeye.arm.profiles import PEAK_ACCELERATION, PEAK_SPEED
from handeye.arm.samples import Samples, check_samples, length
from handeye.core.pose import Array, Pose, displaced, rotation_z, translated
from handeye.program.diagnosis.reach import HeldJoint, TooFast

RAMP = 0.1  # s to reach and to leave cruising speed; chosen: six servo periods of 1973


def straight(
    arm: ArmModel, q_start: Array, displacement: Array, speed: float, ramp: float = RAMP
) -> Samples | IKResult:
    """Plan a straight motion of the tool point with constant orientation. Returns the set-points of the motion, or the
    reason why the motion is impossible.

    The motion covers `displacement` (m, in W, shape (3,)) and cruises at `speed` (m/s). A motion that is too short to
    reach this speed is slower.
    """
    displacement = np.asarray(displacement, dtype=np.float64)
    distance = float(np.linalg.norm(displacement))
    s, sd, sdd = _profile(distance, speed, ramp, arm.servo.period)
    u = displacement / distance if distance else displacement
    X = np.tile(forward(arm, q_start), (len(s), 1, 1))
    X[:, :3, 3] += s[:, None] * u
    along = np.concatenate([u, np.zeros(3)])
    return _follow(arm, q_start, X, sd[:, None] * along, sdd[:, None] * along)


def arc(
    arm: ArmModel, q_start: Array, centre_xy: Array, angle: float, speed: float, ramp: float = RAMP
) -> Samples | IKResult:
    """Plan a turn of the hand about a vertical axis through `centre_xy` (m, shape (2,)). Returns the set-points of the
    motion, or the reason why the motion is impossible.

    The motion covers `angle` (rad, counter-clockwise seen from above) and cruises at up to `speed` (rad/s).
    """
    s, sd, sdd = _profile(abs(angle), speed, ramp, arm.servo.period)
    s, sd, sdd = (math.copysign(1.0, angle) * x for x in (s, sd, sdd))
    X_start = forward(arm, q_start)
    centre = np.array([centre_xy[0], centre_xy[1], 0.0])
    X = np.tile(translated(X_start, -centre), (len(s), 1, 1))
    for turned, a in zip(X, s, strict=True):
        turned[:3] = rotation_z(a) @ turned[:3]
    X[:, :3, 3] += centre
    lever = X[:, :3, 3] - [centre_xy[0], centre_xy[1], X_start[2, 3]]
    across = np.stack([-lever[:, 1], lever[:, 0], np.zeros(len(s))], axis=1)
    up = np.array([0.0, 0.0, 1.0])
    V = np.concatenate([sd[:, None] * across, sd[:, None] * up], axis=1)
    A = np.concatenate([sdd[:, None] * across - (sd**2)[:, None] * lever, sdd[:, None] * up], axis=1)
    return _follow(arm, q_start, X, V, A)


def pivot(arm: ArmModel, q_start: Array, turn: Array, speed: float, ramp: float = RAMP) -> Samples | IKResult:
    """Plan a turn of the hand about its tool point. Returns the set-points of the motion, or the reason why the motion
    is impossible.

    `turn`, shape (3,), is the rotation vector of the whole motion (rad, in W). `speed` is the greatest speed of the
    turn (rad/s).
    """
    angle = float(np.linalg.norm(turn))
    s, sd, sdd = _profile(angle, speed, ramp, arm.servo.period)
    u = turn / angle if angle else turn
    X_start, still = forward(arm, q_start), np.zeros(3)
    X = np.stack([displaced(X_start, still, a * u) for a in s]) if len(s) else np.zeros((0, 4, 4))
    about = np.concatenate([still, u])
    return _follow(arm, q_start, X, sd[:, None] * about, sdd[:, None] * about)


def _profile(distance: float, speed: float, ramp: float, period: float) -> tuple[Array, Array, Array]:
    """Return the distance, speed and acceleration at ticks 1 to N of a cruise between two ramps with smooth ends.

    On a ramp the speed is `speed` (3 r2 - 2 r3), where r is the elapsed fraction of the ramp, and r2 and r3 are the
    square and the cube of r. A ramp therefore covers half the distance that cruising covers in the same time.
    """
    if distance == 0.0:
        return np.zeros(0), np.zeros(0), np.zeros(0)
    cruise = max(distance / speed - ramp, 0.0)
    count = math.ceil((cruise + 2 * ramp) / period - 1e-9)
    duration = count * period
    v = distance / (duration - ramp)
    t = np.arange(1, count + 1) * period
    r = np.clip(np.minimum(t, duration - t) / ramp, 0.0, 1.0)
    rising = t < duration / 2
    ramped = v * ramp * (r**3 - r**4 / 2)
    s = np.where(t <= ramp, ramped, np.where(duration - t <= ramp, distance - ramped, v * (t - ramp / 2)))
    return s, v * (3 * r**2 - 2 * r**3), np.where(rising, 1.0, -1.0) * v / ramp * 6 * (r - r**2)


def _follow(arm: ArmModel, q_start: Array, X: Pose, V: Array, A: Array) -> Samples | IKResult:
    """Find the joint positions, rates and accelerations for hand poses `X`, their twists `V` and the twists' rates of
    change `A`. `X` has shape (N, 4, 4), `V` and `A` have shape (N, 6). Returns the reason if the arm cannot follow the
    poses.
    """
    if len(X) == 0:
        none = np.zeros((0, len(q_start)))
        return Samples(q=none, qd=none, qdd=none)
    candidates, exists = branches(arm, X, q_start)
    if not exists.all():
        tick = int(np.argmin(exists.all(axis=1)))
        return replace(solve(arm, X[tick], q_start), along=length(X[: tick + 1]))
    turn = np.where(constants(arm).prismatic, np.inf, 2 * np.pi)
    branch = int(np.argmin(np.abs(_shortest(candidates[0] - q_start, turn)).sum(axis=-1)))
    q = candidates[:, branch]
    stuck = singular(arm, q_start, q, V)
    if stuck is not None:
        return IKResult(reason=stuck[1], along=length(X[: stuck[0] + 1]))
    steps = np.diff(np.vstack([q_start, q]), axis=0)
    q = q_start + np.cumsum(_shortest(steps, turn), axis=0)
    fault = check_samples(arm, Samples(q=q, qd=q, qdd=q))
    if fault is not None:
        return fault
    R, p = chain(arm, q)
    J = tool_jacobian(arm, R, p)
    qd = rates(arm, q, J, V)
    if (np.abs(qd) > constants(arm).speed).any():
        tick, joint = divmod(int(np.argmax(np.abs(qd) / constants(arm).speed)), qd.shape[1])
        rate = abs(float(qd[tick, joint]))
        return IKResult(reason=TooFast(joint, rate, arm.joints[joint].speed), along=length(X[: tick + 1]))
    return Samples(q=q, qd=qd, qdd=rates(arm, q, J, A - drift(arm, R, p, qd)))


def _shortest(step: Array, turn: Array) -> Array:
    """Remove whole turns from `step`, so that the joint turns in the shorter direction."""
    whole = np.round(step / turn)
    return np.asarray(step - np.where(whole == 0, 0.0, whole * np.where(np.isinf(turn), 0.0, turn)))


def jog(arm: ArmModel, q: Array, joint: int, goal: float, *, speed: float) -> Samples | IKResult:
    """Plan a smooth motion of one joint, given by its index from 0, to a goal (rad or m). Returns the set-points of
    the motion, or the reason why the motion is impossible.

    `speed` is a fraction of the joint's rate limit. The acceleration limit is multiplied by the square of `speed`.
    """
    if arm.joints[joint].name in arm.held:
        return IKResult(reason=HeldJoint(joint, arm.held[arm.joints[joint].name]))
    distance, limits, period = goal - q[joint], arm.joints[joint], arm.servo.period
    least = max(
        PEAK_SPEED * abs(distance) / (speed * limits.speed),
        float(np.sqrt(PEAK_ACCELERATION * abs(distance) / (speed**2 * limits.acceleration))),
    )
    count = max(1, int(np.ceil(least / period)))
    duration, s = count * period, np.arange(1, count + 1) / count
    one = np.eye(len(q))[joint] * distance
    samples = Samples(
        q=q + np.outer(10 * s**3 - 15 * s**4 + 6 * s**5, one),
        qd=np.outer(30 * s**2 - 60 * s**3 + 30 * s**4, one) / duration,
        qdd=np.outer(60 * s - 180 * s**2 + 120 * s**3, one) / duration**2,
    )
    return check_samples(arm, samples, floor=0.0) or samples
