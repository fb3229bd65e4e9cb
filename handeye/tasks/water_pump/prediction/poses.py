"""Poses of many worlds at once, shape (n, 4, 4)."""

import numpy as np

from handeye.core.pose import Array, Pose
from handeye.tasks.water_pump.prediction.worlds import Worlds

_AXES = {"roll": (1, 2), "pitch": (2, 0), "yaw": (0, 1)}
"""The plane in which each turn moves things, its second axis from its first."""


def placed(worlds: Worlds, name: str, middle: tuple[float, float, float], ways: tuple[str, ...]) -> Array:
    """How the error of a name moves what is fixed to a thing that turns about a point, m; as `Placing.about`."""
    turn = np.broadcast_to(np.eye(3), (len(worlds), 3, 3))
    for way in ("yaw", "pitch", "roll"):
        if way in ways:
            turn = turn @ _turn(worlds[f"{name}.{way}"], *_AXES[way])
    error = np.stack(
        [worlds[f"{name}.{axis}"] if axis in ways else np.zeros(len(worlds)) for axis in "xyz"], axis=-1
    )
    found = np.zeros((len(worlds), 4, 4))
    found[:, :3, :3], found[:, 3, 3] = turn, 1.0
    found[:, :3, 3] = np.array(middle) + error - turn @ np.array(middle)
    return found


def _turn(angle: Array, first: int, second: int) -> Array:
    R = np.zeros((len(angle), 3, 3))
    R[:, [0, 1, 2], [0, 1, 2]] = 1.0
    R[:, first, first] = R[:, second, second] = np.cos(angle)
    R[:, second, first] = np.sin(angle)
    R[:, first, second] = -np.sin(angle)
    return R


def moved(X: Array, p: Array) -> Array:
    """Poses moved by p in the outer frame, shape (n, 3) or (3,)."""
    Y = X.copy()
    Y[..., :3, 3] += p
    return Y


def inverses(X: Array) -> Array:
    """Inverses of poses."""
    Y = np.zeros_like(X)
    R = np.swapaxes(X[..., :3, :3], -1, -2)
    Y[..., :3, :3], Y[..., 3, 3] = R, 1.0
    Y[..., :3, 3] = -(R @ X[..., :3, 3, None])[..., 0]
    return Y


def points(X: Array | Pose, p: Array) -> Array:
    """A point of moved frames, shape (3,) or (n, 3), in the outer frame, shape (n, 3)."""
    return np.asarray((X[..., :3, :3] @ p[..., None])[..., 0] + X[..., :3, 3])
