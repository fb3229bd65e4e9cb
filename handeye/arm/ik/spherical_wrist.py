"""Closed-form inverse kinematics of the Stanford arm (Paul 1981): a shoulder with offset d2, a sliding boom, a
spherical wrist.

There are four branches: the boom on either side of the column, each with and without a flipped wrist. Where the axes
of joints 4 and 6 are in line, only the sum of the two joint angles matters. Joint 4 then keeps its angle if joint 6
can reach the angle that completes this sum.
"""

import math
from functools import lru_cache
from types import ModuleType
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from handeye.arm.ik.result import WRITTEN, IKResult, choose, nearest_turn, shared
from handeye.arm.model import ArmModel, constants
from handeye.core.pose import Array, Pose, inverse
from handeye.program.diagnosis.reach import InLine, InnerCylinder, OutOfReach, TooNear

_KINDS: Final = ("revolute", "revolute", "prismatic", "revolute", "revolute", "revolute")
_TWISTS: Final = (-math.pi / 2, math.pi / 2, 0.0, -math.pi / 2, math.pi / 2, 0.0)
_COLLINEAR: Final = 1e-11  # sine of joint 5 below which joints 4 and 6 are one axis
_SINGULAR: Final = 0.02  # sine of joint 5 below which joint 4 would have to be absurdly fast


@lru_cache(maxsize=16)
def _check(arm: ArmModel) -> None:
    """Raise ValueError unless the closed form fits the arm."""
    kinds, twists = tuple(j.kind for j in arm.joints), tuple(j.alpha for j in arm.joints)
    offsets = [j.d for j in arm.joints[2:]] + [j.theta for j in arm.joints]
    if (
        kinds != _KINDS
        or twists != _TWISTS
        or arm.held
        or offsets != [0.0, 0.0, 0.0, arm.hand.length, *[0.0] * 6]
    ):
        raise ValueError(f"the {arm.name} arm is not built like the Stanford arm, with a spherical wrist")


def branches(arm: ArmModel, X_WT: Pose, start: Array | None) -> tuple[Array, NDArray[np.bool_]]:
    """Return four branches: two with the shoulder on the positive side, then two with the shoulder on the negative
    side. In each pair, the wrist is first not flipped, then flipped. No branch exists where the wrist would be nearer
    to axis 1 than the offset d2 allows.
    """
    _check(arm)
    X_BT = inverse(arm.X_WB) @ np.asarray(X_WT, dtype=np.float64)
    rows = [[X_BT[..., i, j] for j in range(4)] for i in range(3)]
    w = _wrist_centre(arm, rows)
    left = 0.0 if start is None else float(start[3])
    found = []
    for side in (1.0, -1.0):
        q123 = _shoulder(np, arm, w, side)
        finger, approach = _from_boom(np, q123, rows)
        a, b, _ = approach
        for flip in (1.0, -1.0):
            q4 = np.where(np.hypot(a, b) < _COLLINEAR, left, np.atan2(flip * b, flip * a))
            found.append(np.stack([*q123, q4, *_bend_and_roll(np, q4, finger, approach)], axis=-1))
    q = np.stack(found, axis=-2)
    turned = np.where(constants(arm).prismatic, q, np.pi - np.mod(np.pi - q, 2 * np.pi))
    exists = np.hypot(w[0], w[1]) >= arm.joints[1].d - WRITTEN[0]
    return turned, np.broadcast_to(exists[..., None], q.shape[:-1])


def solve(arm: ArmModel, X_WT: Pose, near: Array) -> IKResult:
    """Find the best branch within the joint limits. If no branch is within the limits, the result gives the reason:
    the wrist is too near to axis 1, or a joint is beyond its limits. If several joints are beyond their limits, the
    reason names the joint that is farthest beyond.
    """
    _check(arm)
    rows = (constants(arm).X_BW @ X_WT)[:3].tolist()
    here = near.tolist()
    w = _wrist_centre(arm, rows)
    radius = math.hypot(w[0], w[1])
    if radius < arm.joints[1].d - WRITTEN[0]:
        return IKResult(reason=InnerCylinder(radius, arm.joints[1].d))
    found = choose(arm, _scalar_branches(arm, rows, w, here), here)
    match found.reason:
        case OutOfReach(joint, amount, limit) if amount < limit:
            return IKResult(reason=TooNear(joint, amount, limit))
    return found


def singular(arm: ArmModel, q_start: Array, q: Array, V: Array) -> tuple[int, InLine] | None:
    """Find the first configuration where the axes of joints 4 and 6 are in line. Returns the index of this
    configuration and the reason, or None if the two axes are never in line.
    """
    in_line = np.abs(np.sin(q[:, 4])) < _SINGULAR
    return (int(np.argmax(in_line)), InLine((3, 5))) if in_line.any() else None


def rates(arm: ArmModel, q: Array, J: Array, V: Array) -> Array:
    """Find the joint rates `qd` that solve J qd = V."""
    return np.asarray(np.linalg.solve(J, V[..., None])[..., 0], dtype=np.float64)


def _scalar_branches(arm: ArmModel, rows: Any, w: Any, near: list[float]) -> list[list[float]]:
    """Return the branches that `branches` finds for one pose, as Python floats. For each joint, whole turns are added
    so that its position is within its limits and nearest to `near`.
    """
    found = []
    for side in (1.0, -1.0):
        q123 = _shoulder(math, arm, w, side)
        finger, approach = _from_boom(math, q123, rows)
        a, b, _ = approach
        in_line = math.hypot(a, b) < _COLLINEAR
        for flip in (1.0,) if in_line else (1.0, -1.0):
            q4 = near[3] if in_line else math.atan2(flip * b, flip * a)
            q5, q6 = _bend_and_roll(math, q4, finger, approach)
            ways = shared(arm.joints[3], arm.joints[5], math.cos(q5), q4, q6) if in_line else ()
            for one, other in ways or ((q4, q6),):
                q = (*q123, one, q5, other)
                found.append([nearest_turn(j, x, x0) for j, x, x0 in zip(arm.joints, q, near, strict=True)])
    return found


# The closed form, once for floats (m = math) and once for arrays (m = numpy): both modules have these names.
# `rows` are the upper three rows [n o a p] of X_BT.


def _wrist_centre(arm: ArmModel, rows: Any) -> Any:
    """Return the position of the wrist centre relative to the shoulder, in the base frame, in m."""
    (_, _, ax, px), (_, _, ay, py), (_, _, az, pz) = rows
    d = arm.hand.length
    return px - d * ax, py - d * ay, pz - d * az - arm.joints[0].d


def _shoulder(m: ModuleType, arm: ArmModel, w: Any, side: float) -> Any:
    """Return q1, q2 and q3 for the boom on the given side of the column."""
    x, y, z = w
    d2 = arm.joints[1].d
    u2 = x * x + y * y - d2 * d2
    u = side * m.sqrt((u2 + m.fabs(u2)) / 2)  # horizontal reach of the boom; 0 within the inner cylinder
    return m.atan2(y, x) - m.atan2(d2, u), m.atan2(u, z), m.sqrt(u * u + z * z)


def _from_boom(m: ModuleType, q123: Any, rows: Any) -> Any:
    """Return the finger line and the approach direction in the frame of the boom, whose z axis is along the boom."""
    c1, s1, c2, s2 = m.cos(q123[0]), m.sin(q123[0]), m.cos(q123[1]), m.sin(q123[1])
    (_, ox, ax, _), (_, oy, ay, _), (_, oz, az, _) = rows
    return tuple(
        (c2 * (c1 * x + s1 * y) - s2 * z, -s1 * x + c1 * y, s2 * (c1 * x + s1 * y) + c2 * z)
        for x, y, z in ((ox, oy, oz), (ax, ay, az))
    )


def _bend_and_roll(m: ModuleType, q4: Any, finger: Any, approach: Any) -> Any:
    """Return q5 and q6 for a given q4, from the two directions that `_from_boom` returns."""
    (o1, o2, o3), (a1, a2, a3) = finger, approach
    c4, s4 = m.cos(q4), m.sin(q4)
    q5 = m.atan2(c4 * a1 + s4 * a2, a3)
    s6 = -m.cos(q5) * (c4 * o1 + s4 * o2) + m.sin(q5) * o3
    return q5, m.atan2(s6, c4 * o2 - s4 * o1)
