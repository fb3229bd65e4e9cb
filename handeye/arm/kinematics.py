"""Kinematics of a chain of frames: forward kinematics, Jacobians, and accelerations of points on the chain.

The chain has revolute and prismatic joints and no common-normal offsets (a = 0 in every row). Functions are
vectorised over leading dimensions, so that computing a whole motion takes little more time than computing one
set-point.
"""

import numpy as np
from numpy.typing import NDArray

from handeye.arm.model import ArmModel, constants
from handeye.core.pose import Array, Pose


def chain(arm: ArmModel, q: Array) -> tuple[Array, Array]:
    """Compute the DH frames 0 (base) to n (tool) in W at joint positions `q`, shape (..., n). Returns rotations,
    shape (..., n + 1, 3, 3), and origins, shape (..., n + 1, 3), in m.
    """
    k = constants(arm)
    q = np.asarray(q, dtype=np.float64)
    step = np.zeros((*q.shape, 4, 4))
    step[..., :3, :3] = link_rotations(np.where(k.prismatic, k.theta, q), k.cos_alpha, k.sin_alpha)
    step[..., 2, 3], step[..., 3, 3] = np.where(k.prismatic, q, k.d), 1.0
    frames = [np.broadcast_to(arm.X_WB, (*q.shape[:-1], 4, 4))]
    for i in range(len(arm.joints)):
        frames.append(frames[-1] @ step[..., i, :, :])
    X = np.stack(frames, axis=-3)
    return X[..., :3, :3], X[..., :3, 3]


def link_rotations(angle: Array, cos_alpha: Array, sin_alpha: Array) -> Array:
    """Return rotations: first by the joint angle about z, then by alpha about x. Angles of shape (...) give shape (...,
    3, 3).
    """
    c, s = np.cos(angle), np.sin(angle)
    step = np.zeros((*angle.shape, 3, 3))
    step[..., 0, 0], step[..., 0, 1], step[..., 0, 2] = c, -s * cos_alpha, s * sin_alpha
    step[..., 1, 0], step[..., 1, 1], step[..., 1, 2] = s, c * cos_alpha, -c * sin_alpha
    step[..., 2, 1], step[..., 2, 2] = sin_alpha, cos_alpha
    return step


def point_jacobian(arm: ArmModel, R: Array, p: Array, points: Array) -> tuple[Array, Array]:
    """Compute the Jacobians of points that move with the hand. `points`, shape (..., m, 3), gives their places in W.
    The points are beyond all joints of the chain `R`, `p`.

    Returns the velocity of each point per joint rate, shape (..., m, n, 3), and the angular velocity per joint
    rate, shape (..., n, 3).
    """
    prismatic = constants(arm).prismatic[:, None]
    axes = R[..., :-1, :, 2]
    lever = points[..., :, None, :] - p[..., None, :-1, :]
    linear = np.where(prismatic, axes[..., None, :, :], cross(axes[..., None, :, :], lever))
    return linear, np.where(prismatic, 0.0, axes)


def tool_jacobian(arm: ArmModel, R: Array, p: Array) -> Array:
    """Return the Jacobian of the tool frame, the last frame of the chain: linear rows, then angular rows, shape
    (..., 6, n).
    """
    linear, angular = point_jacobian(arm, R, p, p[..., -1:, :])
    return np.concatenate(
        [np.swapaxes(linear[..., 0, :, :], -1, -2), np.swapaxes(angular, -1, -2)], axis=-2
    )  # fmt: skip


def centripetal(
    arm: ArmModel, R: Array, p: Array, points: Array, linear: Array, links: NDArray[np.int_], qd: Array
) -> tuple[Array, Array]:
    """Compute the accelerations of points, shape (..., m, 3), and of the links to which these points belong. The joint
    rates are `qd`; the joint accelerations are zero.

    Point k is fixed in link `links[k]`, counted from 0. `linear`, shape (..., m, n, 3), has the velocity of each point
    per unit rate of each joint. This velocity is zero for the joints that do not move the point's link. Returns linear
    accelerations and angular accelerations, each of shape (..., m, 3).
    """
    k = constants(arm)
    prismatic = k.prismatic[:, None]
    axes = R[..., :-1, :, 2]
    turning = np.where(prismatic, 0.0, axes) * qd[..., None]
    after = np.cumsum(turning, axis=-2)  # angular velocity of each link
    before = after - turning
    swing = cross(before, axes)  # rate of change of each joint axis
    carried = k.carried[links][:, :, None]  # joints that move link k

    origins, _ = point_jacobian(arm, R, p, p[..., :-1, :])
    v_point = (linear * qd[..., None, :, None]).sum(axis=-2)
    v_origin = ((origins * np.tri(len(k.d), k=-1)[:, :, None]) * qd[..., None, :, None]).sum(axis=-2)
    lever = points[..., :, None, :] - p[..., None, :-1, :]
    rate = v_point[..., :, None, :] - v_origin[..., None, :, :]
    # a revolute joint's column is axis x lever, and both change; a prismatic one's is the axis alone
    column = np.where(
        prismatic,
        swing[..., None, :, :],
        cross(swing[..., None, :, :], lever) + cross(axes[..., None, :, :], rate),
    )
    column = (column * carried) * qd[..., None, :, None]
    spin = np.where(prismatic, 0.0, swing * qd[..., None])
    return column.sum(axis=-2), np.cumsum(spin, axis=-2)[..., links, :]


def cross(a: Array, b: Array) -> Array:
    """Return the cross product over the last axis. On small arrays this is several times faster than `numpy.cross`."""
    ax, ay, az = a[..., 0], a[..., 1], a[..., 2]
    bx, by, bz = b[..., 0], b[..., 1], b[..., 2]
    x = ay * bz - az * by
    product = np.empty((*x.shape, 3))
    product[..., 0], product[..., 1], product[..., 2] = x, az * bx - ax * bz, ax * by - ay * bx
    return product


def forward(arm: ArmModel, q: Array) -> Pose:
    """Return the hand pose `X_WT` at joint positions `q`. Shape (..., n) gives shape (..., 4, 4)."""
    R, p = chain(arm, q)
    X = np.zeros((*R.shape[:-3], 4, 4))
    X[..., :3, :3], X[..., :3, 3], X[..., 3, 3] = R[..., -1, :, :], p[..., -1, :], 1.0
    return X


def jacobian(arm: ArmModel, q: Array) -> Array:
    """Return the geometric Jacobian at T in world axes: linear rows, then angular rows. `q` of shape (..., n) gives
    shape (..., 6, n).
    """
    return tool_jacobian(arm, *chain(arm, q))


def drift(arm: ArmModel, R: Array, p: Array, qd: Array) -> Array:
    """Return the acceleration dJ/dt qd of T, shape (..., 6), in the configuration with the frames `R`, `p`. The joint
    rates are `qd`; the joint accelerations are zero.
    """
    tool, last = p[..., -1:, :], np.full(1, len(arm.joints) - 1)
    linear, _ = point_jacobian(arm, R, p, tool)
    bend, spin = centripetal(arm, R, p, tool, linear, last, qd)
    return np.concatenate([bend[..., 0, :], spin[..., 0, :]], axis=-1)
