"""Set-points of the path back: a step's path from end to beginning, with gentle ends."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.arm.kinematics import forward
from handeye.arm.model import ArmModel
from handeye.arm.samples import Samples
from handeye.core.pose import Array
from handeye.execution.undo.way import RecordedPath
from handeye.planning.motions import GUARDED_SPEED

RAMP: Final = 8
"""Servo periods of acceleration and braking. Chosen: what stopped on a force ended at full speed."""
JOIN: Final = 5e-4
"""rad or m per servo period of a joint to where the path ends: brakes and guards have left the arm beside it."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Retracing:
    """A path back."""

    samples: Samples
    gap: Array  # finger set-points, (N,), m
    left: Array  # path set-points left after each, (N,)


def retracing(arm: ArmModel, q: Array, gap: float, way: RecordedPath, *, slowly: bool) -> Retracing:
    """The path back from where the arm and its fingers are; `slowly`: at the speed of guarded motions at most."""
    rows = np.column_stack([way.q, way.gap])[::-1]
    path = np.vstack([_joined(np.append(q, gap), rows[0]), rows])
    last, period = len(path) - 1, arm.servo.period
    periods = _periods(arm, path[:, :-1]) if slowly else np.ones(last)
    places = np.interp(_clock(float(periods.sum())), np.append(0.0, np.cumsum(periods)), np.arange(last + 1))
    points = np.column_stack([np.interp(places, np.arange(last + 1), column) for column in path.T])
    at = points[1:, :-1]
    qd = np.gradient(points[:, :-1], period, axis=0)[1:]
    qd[-1] = 0.0
    left = np.minimum(np.floor(last - places[1:]).astype(int), len(way) - 1)
    return Retracing(samples=Samples(q=at, qd=qd, qdd=np.zeros_like(at)), gap=points[1:, -1], left=left)


def _joined(here: Array, there: Array) -> Array:
    """Set-points from the arm's position to the path's end, exclusive; shape (N, n + 1)."""
    periods = max(1, int(np.ceil(np.abs(there - here)[:-1].max() / JOIN)))
    return np.asarray(here + np.linspace(0.0, 1.0, periods, endpoint=False)[:, None] * (there - here))


def _periods(arm: ArmModel, q: Array) -> Array:
    """Servo periods, one at least, between set-points, for a hand no faster than guarded motions."""
    went = np.linalg.norm(np.diff(forward(arm, q)[:, :3, 3], axis=0), axis=1)
    return np.asarray(np.maximum(1.0, went / (GUARDED_SPEED * arm.servo.period)))


def _clock(periods: float) -> Array:
    """Elapsed time, in periods, on a path with smooth start and end."""
    rise = (np.arange(RAMP) + 1) / (RAMP + 1)
    rate = np.concatenate([rise, np.ones(int(np.ceil(periods))), rise[::-1]])
    gone = np.cumsum(rate)
    return np.append(0.0, gone * (periods / gone[-1]))
