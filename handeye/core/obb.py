"""Oriented bounding boxes, and how deep they penetrate each other."""

from collections.abc import Sequence

import numpy as np

from handeye.core.pose import Array, Pose

Box = tuple[float, float, float, float, float, float]
"""Opposite corners in its own frame, m: x, y, z from, then x, y, z to."""

_PARALLEL = 1e-6  # sine below which two edges count as parallel and their cross product gives no axis


def middles(boxes: Sequence[Box]) -> Array:
    """Centres of boxes, shape (n, 3), m."""
    corners = np.asarray(boxes, dtype=np.float64).reshape(-1, 2, 3)
    return np.asarray((corners[:, 0] + corners[:, 1]) / 2)


def halves(boxes: Sequence[Box]) -> Array:
    """Half lengths of boxes, shape (n, 3), m."""
    corners = np.asarray(boxes, dtype=np.float64).reshape(-1, 2, 3)
    return np.asarray((corners[:, 1] - corners[:, 0]) / 2)


def lowest(X_WA: Pose, boxes: Sequence[Box]) -> Array:
    """Height (m) of the lowest corner of boxes in frame A, at poses (N, 4, 4); shape (N, n)."""
    up = X_WA[:, 2:3, :3]
    centre = X_WA[:, 2, 3, None] + (up @ middles(boxes).T)[:, 0]
    return np.asarray(centre - (np.abs(up) @ halves(boxes).T)[:, 0])


def depths(X_BA: Pose, boxes: Sequence[Box], others: Sequence[Box]) -> Array:
    """Depths (N, n, m) in m of n boxes in m others, each with its frame B; 0 if apart. `X_BA` is (N, m, 4, 4)."""
    a, b = halves(boxes), halves(others)
    R = X_BA[..., :3, :3]
    gap = np.moveaxis(R @ middles(boxes).T, -1, 1) + X_BA[:, None, :, :3, 3] - middles(others)
    margin = np.moveaxis(np.abs(R) @ a.T, -1, 1) + b - np.abs(gap)
    depth = np.maximum(margin.min(axis=-1), 0.0)
    near = np.nonzero(depth)
    sample, i, j = near
    depth[near] = np.minimum(depth[near], _oblique(R[sample, j], gap[near], a[i], b[j]))
    return np.asarray(depth)


def _oblique(R: Array, gap: Array, a: Array, b: Array) -> Array:
    """Overlap (m) of K pairs of boxes along the axes of the first and the cross products of their edges.

    Args:
        R: orientation of the first in the second's frame, (K, 3, 3).
        gap: from the second's centre to the first's, (K, 3); `a` and `b` are half lengths, (K, 3).
    """
    own = np.swapaxes(R, -1, -2)
    crossed = np.cross(np.eye(3)[None, :, None], own[:, None]).reshape(-1, 9, 3)
    axes = np.concatenate([own, crossed], axis=1)
    size = np.linalg.norm(axes, axis=-1)
    axes = axes / np.maximum(size, _PARALLEL)[..., None]
    reach = (np.abs(axes @ R) @ a[..., None] + np.abs(axes) @ b[..., None] - np.abs(axes @ gap[..., None]))[
        ..., 0
    ]
    return np.asarray(np.maximum(np.where(size < _PARALLEL, np.inf, reach).min(axis=1, initial=np.inf), 0.0))
