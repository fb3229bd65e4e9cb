"""Planned free motions: one polynomial trajectory of degrees 4-3-4 per joint (Paul 1972).

The hand lifts off upwards, moves to a set-down point above the goal, and descends. Via points in between are knots
of a cubic spline. All joints share the segment times. A linear relation between joints that holds at all knots
therefore holds throughout the motion: a hand that points straight down at all knots never tilts.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.arm.ik import IKResult, solve
from handeye.arm.ik.result import SLACK
from handeye.arm.kinematics import forward
from handeye.arm.model import ArmModel, constants
from handeye.arm.samples import Samples, check_samples
from handeye.core.pose import Array, Pose, translated
from handeye.core.units import INCH
from handeye.program.diagnosis.reach import BelowTable

DIRECT_KNOT: Final = 1 / 9
"""Place of the inner knots, as a fraction of the path, in a motion without departure or approach. The first inner knot
lies at this distance after the start, and the last inner knot lies at this distance before the end.

The worked example of Paul (1972) has the same fraction: its inner knots lie 5 degrees from the ends of a path of 45
degrees.
"""
_HEIGHT_SHARES: Final = (1.0, 0.75, 0.5, 0.25)  # of departure and approach, tried in turn
_END_SHARES: Final = (0.25, 0.35, 0.5, 0.7, 1.0, 1.4)  # durations of the end segments; the middle one: 1
_PLACES: Final = np.linspace(0.0, 1.0, 33)  # of a segment; peaks between are at most .1 % higher


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Trajectory:
    """Joint positions as functions of time: one polynomial per joint and segment."""

    knots: Array  # start, between segments, end: (N + 1, n), N at least 3
    times: Array  # of each segment, (N,), in s
    coefficients: Array  # (N, 5, n): segment, ascending power of time since its start, joint

    @property
    def duration(self) -> float:
        """Total duration, in s."""
        return float(self.times.sum())

    def lift_off(self, period: float) -> int:
        """Return the number of servo periods of length `period` (s) until the hand has passed its lift-off point."""
        return math.ceil(float(self.times[0]) / period - 1e-6)

    def at(self, time: Array) -> Samples:
        """Return the joint positions, rates and accelerations at times (s) from the start, shape (N,)."""
        ends = np.cumsum(self.times)
        segment = np.minimum(np.searchsorted(ends, time, side="left"), len(ends) - 1)
        t = np.clip(time - (ends - self.times)[segment], 0.0, self.times[segment])
        q, qd, qdd = (_powers(t, order)[:, None, :] @ self.coefficients[segment] for order in range(3))
        return Samples(q=q[:, 0], qd=qd[:, 0], qdd=qdd[:, 0])

    def sample(self, period: float) -> Samples:
        """Return the set-points at ticks 1 to N. The last set-point is exactly at the goal, at rest."""
        count = max(1, math.ceil(self.duration / period - 1e-6))
        samples = self.at(np.arange(1.0, count + 1.0) * period)
        samples.q[-1], samples.qd[-1], samples.qdd[-1] = self.knots[-1], 0.0, 0.0
        return samples


def four_three_four(knots: Array, times: Array) -> Trajectory:
    """Compute the trajectory from rest to rest through all knots with continuous second derivatives. Arrays are as
    in `Trajectory`.
    """
    knots, times = np.array(knots, dtype=np.float64), np.array(times, dtype=np.float64)
    return Trajectory(knots=knots, times=times, coefficients=_coefficients(knots, times))


def move(
    arm: ArmModel, q_start: Array, X_WT_goal: Pose, *,
    via: Sequence[Array] = (), departure: float = 3 * INCH, approach: float = 3 * INCH, speed: float = 1.0,
) -> Trajectory | IKResult:  # fmt: skip
    """Plan the free motion to a hand pose. The motion ends on the nearest branch of the solutions for this pose. The
    motion lasts a whole number of servo periods. Returns the trajectory, or the reason why the motion is impossible.

    The motion passes through the configurations in `via` without stopping. `departure` and `approach` are the heights
    (m) of the lift-off point above the start and of the set-down point above the goal; a height of 0 leaves the point
    out. If a point is out of reach, it is lowered in steps of a quarter of its height. `speed` is a fraction of the
    joints' rate limits; accelerations are scaled by its square.
    """
    height = float(X_WT_goal[2, 3])
    if height < -SLACK:
        return IKResult(reason=BelowTable(-height))
    goal = solve(arm, X_WT_goal, via[-1] if via else q_start)
    if goal.q is None:
        return goal
    fault = goal
    for share in _HEIGHT_SHARES:
        q1 = _raised(arm, forward(arm, q_start), q_start, share * departure)
        q2 = _raised(arm, X_WT_goal, goal.q, share * approach)
        trajectory = _quickest(arm, _knots(q_start, q1, via, q2, goal.q), speed)
        beyond = check_samples(arm, trajectory.sample(arm.servo.period), floor=0.0 if via else None)
        if beyond is None:
            return trajectory
        fault = beyond  # the polynomials swing a little beyond their knots
    return fault


def _raised(arm: ArmModel, X_WT: Pose, q: Array, height: float) -> Array | None:
    """Find joint positions with the hand raised by `height` (m), or as far as the arm reaches. Returns None if
    `height` is 0.
    """
    if height == 0.0:
        return None
    tried = (solve(arm, translated(X_WT, [0.0, 0.0, share * height]), q).q for share in _HEIGHT_SHARES)
    return next((q for q in tried if q is not None), None)


def _knots(q0: Array, q1: Array | None, via: Sequence[Array], q2: Array | None, q3: Array) -> Array:
    """Return all knots. Missing lift-off and set-down points are replaced by knots in joint space."""
    ahead = via[0] if via else q3 if q2 is None else q2
    behind = via[-1] if via else q0 if q1 is None else q1
    leave, reach = q0 + DIRECT_KNOT * (ahead - q0), q3 + DIRECT_KNOT * (behind - q3)
    return np.array([q0, leave if q1 is None else q1, *via, reach if q2 is None else q2, q3])


def _quickest(arm: ArmModel, knots: Array, speed: float) -> Trajectory:
    """Try several segment times, and return the fastest trajectory within the limits. The trajectory lasts a whole
    number of servo periods.
    """
    k, period = constants(arm), arm.servo.period
    distances = np.abs(np.diff(knots, axis=0))
    least = np.max(np.maximum(distances / k.speed, np.sqrt(distances / k.acceleration)), axis=1)
    between = np.maximum(least[1:-1], period)
    between = between / between.max()
    shares = np.array([(a, *between, b) for a in _END_SHARES for b in _END_SHARES])
    times = shares * max(float(least.max()), period)
    times *= _stretch(arm, knots, times)[:, None]
    best = times[np.argmin(times.sum(axis=1))] / speed
    duration = float(best.sum())
    best *= math.ceil(duration / period - 1e-9) * period / duration
    return four_three_four(knots, best)


def _stretch(arm: ArmModel, knots: Array, times: Array) -> Array:
    """Return the factors, shape (...), by which the segment times (..., 3) must be multiplied so that all speeds and
    accelerations are just within the limits.
    """
    k = constants(arm)
    coefficients = _coefficients(knots, times)
    at = times[..., None] * _PLACES
    rate = np.abs(_powers(at, 1) @ coefficients) / k.speed
    acceleration = np.abs(_powers(at, 2) @ coefficients) / k.acceleration
    peak = np.maximum(rate.max(axis=(-3, -2, -1)), np.sqrt(acceleration.max(axis=(-3, -2, -1))))
    return np.asarray(np.maximum(peak, 1e-9))


def _powers(t: Array, order: int) -> Array:
    """Return the derivatives of the given order of 1, t, ..., t^4. Times of shape (...) give shape (..., 5)."""
    t = t[..., None]
    n = np.arange(5.0)
    factor = np.ones(5)
    for i in range(order):
        factor = factor * (n - i)
    return np.asarray(factor * t ** np.maximum(n - order, 0.0))


def _coefficients(knots: Array, times: Array) -> Array:
    """Return the polynomial coefficients, shape (..., N, 5, n), for segment times of shape (..., N)."""
    count = times.shape[-1]
    A = np.zeros((*times.shape[:-1], 5 * count, 5 * count))
    b = np.zeros((5 * count, knots.shape[-1]))
    start = [_powers(np.zeros(times.shape[:-1]), order) for order in range(3)]
    end = [[_powers(times[..., i], order) for order in range(3)] for i in range(count)]
    of = [slice(5 * i, 5 * i + 5) for i in range(count)]
    row = 0
    for order in range(3):  # at rest at both ends, smooth at the knots between
        A[..., row, of[0]], A[..., row + 1, of[-1]] = start[order], end[-1][order]
        row += 2
        for i in range(count - 1):
            A[..., row, of[i]], A[..., row, of[i + 1]] = end[i][order], -start[order]
            row += 1
    b[0], b[1] = knots[0], knots[-1]
    for i in range(1, count):
        A[..., row, of[i]], b[row] = start[0], knots[i]
        row += 1
    for i in range(1, count - 1):  # all but the first and last segments are cubics
        A[..., row, 5 * i + 4] = 1.0
        row += 1
    flat = np.asarray(np.linalg.solve(A, b), dtype=np.float64)
    return flat.reshape(*times.shape[:-1], count, 5, knots.shape[-1])
