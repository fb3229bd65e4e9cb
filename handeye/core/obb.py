"""Oriented bounding boxes, and the depth to which two of them overlap."""

from collections.abc import Sequence

import numpy as np

from handeye.core.pose import Array, Pose

Box = tuple[float, float, float, float, float, float]
"""Two opposite corners of a box, in m, in the frame of the box: least x, y, z, then greatest x, y, z."""

_PARALLEL = 1e-6  # sine below which two edges count as parallel and their cross product gives no axis


def middles(boxes: Sequence[Box]) -> Array:
    """Return the centres of boxes, in m, shape (n, 3)."""
    corners = np.asarray(boxes, dtype=np.float64).reshape(-1, 2, 3)
    return np.asarray((corners[:, 0] + corners[:, 1]) / 2)


def halves(boxes: Sequence[Box]) -> Array:
    """Return the half lengths of boxes, in m, shape (n, 3)."""
    corners = np.asarray(boxes, dtype=np.float64).reshape(-1, 2, 3)
    return np.asarray((corners[:, 1] - corners[:, 0]) / 2)


def lowest(X_WA: Pose, boxes: Sequence[Box]) -> Array:
    """Return the height (m) of the lowest corner of each box, shape (N, n). The n boxes are given in frame A. `X_WA`,
    shape (N, 4, 4), are N poses of this frame.
    """
    up = X_WA[:, 2:3, :3]
    centre = X_WA[:, 2, 3, None] + (up @ middles(boxes).T)[:, 0]
    return np.asarray(centre - (np.abs(up) @ halves(boxes).T)[:, 0])


def depths(X_BA: Pose, boxes: Sequence[Box], others: Sequence[Box]) -> Array:
    """Return the depths (m) to which n boxes overlap m other boxes, shape (N, n, m); 0 if two boxes do not touch. The
    n boxes are given in frame A. Each other box has its own frame B; `X_BA`, shape (N, m, 4, 4), is the pose of A in
    B.
    """
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
    """Return the overlap (m) of K pairs of boxes: the least overlap along the axes of the first box and along the
    cross products of the edges.

    Args:
        R: orientation of the first box in the frame of the second, shape (K, 3, 3).
        gap: vector from the centre of the second box to that of the first, in m, shape (K, 3). `a` and `b` are the
            half lengths of the first and the second box, also in m, shape (K, 3).
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
