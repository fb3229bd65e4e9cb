"""Motions of each kind. The planner computes motions from planned poses, and the executor computes them from measured
poses.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.arm.ik import IKResult, solve
from handeye.arm.kinematics import forward
from handeye.arm.line import arc, straight
from handeye.arm.model import ArmModel
from handeye.arm.samples import Samples
from handeye.arm.trajectory import Trajectory, move
from handeye.core.pose import Array, Pose
from handeye.core.units import DEGREE, INCH
from handeye.program.motion_operations import Change, Move, Turn

CLEARANCE: Final = 3.0 * INCH
"""Height (m) of departure and approach points. The account of 1972 says "a few inches"; the figure of three inches is
from memory (decision D10).
"""
LEAST_CLEARANCE: Final = 0.5 * INCH  # least height, even of a motion between near places
GUARDED_SPEED: Final = 1.0 * INCH
"""Speed (m/s) of a straight motion that makes contact. At 1 in/s, a stop at 50 oz overshoots by a few newtons."""
FREE_SPEED: Final = 2.0 * INCH  # m/s of a straight motion in free air
TURN_SPEED: Final = 30 * DEGREE  # rad/s on a circle


@dataclass(frozen=True, slots=True, kw_only=True)
class Unreachable:
    """A position that a Move cannot reach, and the reason why."""

    name: str
    why: IKResult


def move_trajectory(
    arm: ArmModel, q: Array, via: Sequence[Pose], X_WT: Pose, operation: Move, speed: float
) -> Trajectory | Unreachable:
    """Compute the trajectory of a Move from `q` through hand poses `via` to `X_WT`. If this trajectory is impossible,
    return the reason why.
    """
    passed: list[Array] = []
    for name, X_via in zip(operation.via, via, strict=True):
        result = solve(arm, X_via, passed[-1] if passed else q)
        if result.q is None:
            return Unreachable(name=name, why=result)
        passed.append(result.q)
    places = [forward(arm, q), *via, X_WT]
    away = [float(np.hypot(*(X_to[:2, 3] - X_from[:2, 3]))) for X_from, X_to in (places[:2], places[-2:])]
    departure, approach = (
        0.0 if operation.direct else float(np.clip(far, LEAST_CLEARANCE, CLEARANCE)) for far in away
    )
    made = move(arm, q, X_WT, via=passed, departure=departure, approach=approach, speed=speed)
    return Unreachable(name=operation.goal, why=made) if isinstance(made, IKResult) else made


def change_samples(arm: ArmModel, q: Array, operation: Change) -> Samples | IKResult:
    """Compute the set-points of a Change from `q`. If the motion is impossible, return the reason why."""
    return straight(arm, q, np.array(operation.displacement), change_speed(operation))


def change_speed(operation: Change) -> float:
    """Return the speed of a Change (m/s)."""
    return operation.speed or (GUARDED_SPEED if operation.meets else FREE_SPEED)


def turn_samples(arm: ArmModel, q: Array, centre: Pose, operation: Turn) -> Samples | IKResult:
    """Compute the set-points of a Turn about the vertical through `centre`. If the motion is impossible, return the
    reason why.
    """
    return arc(arm, q, centre[:2, 3], operation.angle, TURN_SPEED)


def directions(samples: Samples, arm: ArmModel, q: Array) -> Array:
    """Return unit vectors in the direction of a motion at each of its set-points, shape (N, 3)."""
    p = np.concatenate([forward(arm, q)[None, :3, 3], forward(arm, samples.q)[:, :3, 3]])
    step = np.diff(p, axis=0)
    size = np.linalg.norm(step, axis=1, keepdims=True)
    moving = size[:, 0] > 1e-9
    # at rest, a set-point has the direction of the nearest one that moves
    index = np.maximum.accumulate(np.where(moving, np.arange(len(step)), 0))
    index[: int(np.argmax(moving))] = int(np.argmax(moving))
    return np.asarray(step[index] / np.maximum(size[index], 1e-12))
