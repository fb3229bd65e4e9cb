"""Poses as 4x4 homogeneous matrices `X_AB`: the pose of frame B in frame A. In a product, the inner letters cancel:
`X_AC = X_AB X_BC`.

Letters: W world (the table frame: origin at a table corner, z up, table top z = 0), B arm base, T tool centre point
(midway between the finger tips), C camera, P part.

The hand frame T has z along the approach direction and y along the finger line, the line through both finger tips. The
orientation of the hand is written with the three angles O, A, T of the arm programs of 1973. If all three angles are
zero, the hand points along -Y, with the finger line along X. O turns the hand about the vertical, A tilts the approach
direction downwards, and T rolls the hand about the approach direction. A hand that points straight down has A = 90
degrees and T = 0; O is then the angle from the x axis of the table to the finger line.
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Pose = NDArray[np.float64]  # a homogeneous matrix, shape (4, 4), lengths in metres

UPRIGHT = math.radians(2)
"""If the hand points straight down to within this angle (rad), its whole rotation about the vertical is written as
O, and T is zero.
"""

_R_ZERO = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [-1.0, 0.0, 0.0]])


def rotation_x(angle: float) -> Array:
    """Return the matrix, shape (3, 3), of a rotation about x by `angle` (rad)."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


def rotation_z(angle: float) -> Array:
    """Return the matrix, shape (3, 3), of a rotation about z by `angle` (rad)."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def rotation(vector: Array) -> Array:
    """Return the matrix, shape (3, 3), of a rotation about the axis `vector`. The length of `vector` is the angle
    (rad).
    """
    angle = float(np.linalg.norm(vector))
    if angle == 0.0:
        return np.eye(3)
    x, y, z = vector / angle
    K = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + math.sin(angle) * K + (1 - math.cos(angle)) * K @ K)


def pose(R: Array, p: Array | Sequence[float]) -> Pose:
    """Make the pose with rotation `R`, shape (3, 3), and position `p`, shape (3,), in m."""
    X = np.eye(4)
    X[:3, :3] = R
    X[:3, 3] = p
    return X


def inverse(X_AB: Pose) -> Pose:
    """Return the inverse `X_BA` of the pose `X_AB`."""
    R = X_AB[:3, :3].T
    return pose(R, -R @ X_AB[:3, 3])


def planar(x: float, y: float, z: float, yaw: float) -> Pose:
    """Return the pose of an upright part at position (x, y, z), in m, turned about the vertical by `yaw` (rad)."""
    return pose(rotation_z(yaw), (x, y, z))


def yaw(X: Pose) -> float:
    """Return the yaw of an upright part (rad), in (-pi, pi]."""
    return math.atan2(X[1, 0], X[0, 0])


def hand(x: float, y: float, z: float, o: float, a: float, t: float) -> Pose:
    """Return the pose of the hand with its tool centre point at (x, y, z), in m, and the angles O, A, T (rad)."""
    return pose(rotation_z(o) @ rotation_x(a) @ _R_ZERO @ rotation_z(t), (x, y, z))


def hand_angles(X_WT: Pose) -> tuple[float, float, float]:
    """Return the angles O, A, T (rad) of a pose of the hand. The inverse of `hand`."""
    finger, approach = X_WT[:3, 1], X_WT[:3, 2]
    a = math.asin(min(1.0, max(-1.0, -float(approach[2]))))
    if abs(abs(a) - math.pi / 2) < UPRIGHT:
        return math.atan2(finger[1], finger[0]), a, 0.0
    o = math.atan2(approach[0], -approach[1])
    along = np.array([math.cos(o), math.sin(o), 0.0])  # direction of the finger line if T were 0
    return o, a, math.atan2(float(along @ X_WT[:3, 0]), float(along @ finger))


def translated(X: Pose, p: Array | Sequence[float]) -> Pose:
    """Move the pose `X_AB` by `p` (m), a displacement in frame A."""
    Y = X.copy()
    Y[:3, 3] += p
    return Y


def displaced(X: Pose, p: Array, turn: Array) -> Pose:
    """Move the pose `X` by `p` (m) and turn it about its new origin by the rotation vector `turn` (rad), both given
    in the outer frame.
    """
    Y = translated(X, p)
    Y[:3, :3] = rotation(turn) @ X[:3, :3]
    return Y
