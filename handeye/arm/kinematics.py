"""Where the hand is, and how the joints must stand for it to be somewhere.

The forward half serves any chain of frames. The inverse is the closed form of the Stanford arm (Paul 1981):
a shoulder with offset d2, a sliding boom, and three wrist axes that meet in a point.
"""

import math
from dataclasses import dataclass
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from handeye.arm.chain import centripetal, chain, point_jacobian
from handeye.arm.model import ArmModel, Joint, constants
from handeye.pose import Array, Pose, inverse
from handeye.units import DEGREE, INCH

COLLINEAR = 1e-9
"""Sine of joint 5 below which joints 4 and 6 count as one axis: then only their sum matters."""
SLACK = 1e-9
"""Round-off allowed beyond a joint limit, rad or m."""


def forward(arm: ArmModel, q: Array) -> Pose:
    """`X_WT` at joint positions `q`, shape (..., n) to (..., 4, 4)."""
    R, p = chain(arm, q)
    X = np.zeros((*R.shape[:-3], 4, 4))
    X[..., :3, :3], X[..., :3, 3], X[..., 3, 3] = R[..., -1, :, :], p[..., -1, :], 1.0
    return X


def jacobian(arm: ArmModel, q: Array) -> Array:
    """Geometric Jacobian at T in world axes, shape (..., n) to (..., 6, n): linear rows, then angular."""
    R, p = chain(arm, q)
    linear, angular = point_jacobian(arm, R, p, p[..., -1:, :])
    return np.concatenate(
        [np.swapaxes(linear[..., 0, :, :], -1, -2), np.swapaxes(angular, -1, -2)], axis=-2
    )  # fmt: skip


def drift(arm: ArmModel, q: Array, qd: Array) -> Array:
    """Acceleration of T at joint rates `qd` and no joint accelerations (dJ/dt qd), shape (..., 6)."""
    R, p = chain(arm, q)
    linear, angular = centripetal(arm, R, p, p[..., -1:, :], np.full(1, len(arm.joints) - 1), qd)
    return np.concatenate([linear[..., 0, :], angular[..., 0, :]], axis=-1)


@dataclass(frozen=True, slots=True, kw_only=True)
class IKResult:
    """Joint positions for a hand pose, or why there are none."""

    q: Array | None = None
    """Shape (6,), rad and (joint 3) m; None if there is no solution."""
    reason: str = ""
    """Empty, or "out of reach", "joint limit" or "inner cylinder"; of motions also "below the table",
    "singular" and "too fast"."""
    joint: int | None = None
    """The joint at fault, from 0."""
    amount: float = 0.0
    """Where that joint would have to be; for "inner cylinder" how near the wrist would come to the column
    axis; for "below the table" the height of the hand; for "too fast" the rate."""
    limit: float = 0.0
    """What `amount` may not pass."""
    along: float | None = None
    """Of motions: how far along the way of the hand it is, m."""

    @property
    def excess(self) -> float:
        """By how much `amount` passes `limit`, rad or m."""
        return abs(self.amount - self.limit)

    def message(self, arm: ArmModel) -> str:
        """Why there is no solution, for people; empty if there is one."""
        match self.reason:
            case "inner cylinder":
                return (
                    f"the wrist would have to be {self.amount / INCH:.1f} in from the axis of joint 1; "
                    f"it cannot come nearer than {self.limit / INCH:.1f} in"
                )
            case "below the table":
                return f"the hand would be {-self.amount / INCH:.2f} in below the table"
            case "singular":
                return "joints 4 and 6 come into line on the way, where the hand cannot keep its orientation"
        if self.joint is None:
            return ""
        joint = arm.joints[self.joint]
        scale, unit = (INCH, "in") if joint.kind == "prismatic" else (DEGREE, "degrees")
        if self.reason == "too fast":
            return (
                f"joint {self.joint + 1} ({joint.name}) would have to move at {self.amount / scale:.0f} "
                f"{unit}/s; it can do {self.limit / scale:.0f} {unit}/s"
            )
        begins = "ends" if self.amount > self.limit else "begins"
        digits = 1 if self.excess > 0.05 * scale else 3
        return (
            f"joint {self.joint + 1} ({joint.name}) would have to be {self.amount / scale:.{digits}f} "
            f"{unit}; it {begins} at {self.limit / scale:.1f} {unit}"
        )


def branches(arm: ArmModel, X_WT: Pose) -> tuple[Array, NDArray[np.bool_]]:
    """The four closed-form solutions for poses of shape (..., 4, 4), limits not considered.

    Order: (shoulder +, wrist), (+, flipped), (-, wrist), (-, flipped).

    Returns:
        joint positions (..., 4, 6), revolute ones in (-pi, pi], and whether they exist, (..., 4): none does
        when the wrist is nearer to the axis of joint 1 than d2. With joints 4 and 6 in line, joint 4 is 0.
    """
    X_BT = inverse(arm.X_WB) @ np.asarray(X_WT, dtype=np.float64)
    rows = [[X_BT[..., i, j] for j in range(4)] for i in range(3)]
    w = _wrist_centre(arm, rows)
    found = []
    for side in (1.0, -1.0):
        q123 = _shoulder(np, arm, w, side)
        a, b = _roll_direction(np, q123, rows)
        for flip in (1.0, -1.0):
            q4 = np.where(np.hypot(a, b) < COLLINEAR, 0.0, np.atan2(flip * b, flip * a))
            found.append(np.stack([*q123, q4, *_bend_and_roll(np, q123, q4, rows)], axis=-1))
    q = np.stack(found, axis=-2)
    turned = np.where(constants(arm).prismatic, q, np.pi - np.mod(np.pi - q, 2 * np.pi))
    exists = w[0] * w[0] + w[1] * w[1] >= arm.joints[1].d ** 2
    return turned, np.broadcast_to(exists[..., None], q.shape[:-1])


def solve(arm: ArmModel, X_WT: Pose, near: Array) -> IKResult:
    """Joint positions that put the hand at `X_WT`: the branch inside the limits that is nearest to `near`.

    Nearest in the sum of travel times of the joints. With joints 4 and 6 in line joint 4 stays as in `near`.

    Args:
        X_WT: shape (4, 4).
        near: shape (6,), rad and m.
    """
    rows = (constants(arm).X_BW @ X_WT)[:3].tolist()
    here = near.tolist()
    w = _wrist_centre(arm, rows)
    radius = math.hypot(w[0], w[1])
    if radius < arm.joints[1].d:
        return IKResult(reason="inner cylinder", joint=0, amount=radius, limit=arm.joints[1].d)
    found = _scalar_branches(arm, rows, w, here)
    good = [q for q in found if all(map(_inside, arm.joints, q))]
    if good:
        return IKResult(q=np.array(min(good, key=lambda q: _travel_time(arm, q, here))))
    return min((_fault(arm, q) for q in found), key=lambda fault: fault[0])[1]


def _inside(joint: Joint, x: float) -> bool:
    return joint.lower - SLACK <= x <= joint.upper + SLACK


def _travel_time(arm: ArmModel, a: list[float], b: list[float]) -> float:
    return sum(abs(x - y) / joint.speed for joint, x, y in zip(arm.joints, a, b, strict=True))


def _fault(arm: ArmModel, q: list[float]) -> tuple[float, IKResult]:
    """The joint farthest beyond its limits, and how far in travel time. A sliding joint comes first: no
    branch can mend it."""
    outside = [(i, j, x) for i, (j, x) in enumerate(zip(arm.joints, q, strict=True)) if not _inside(j, x)]
    excess = [(j.kind == "prismatic", max(x - j.upper, j.lower - x) / j.speed) for _, j, x in outside]
    worst = max(range(len(outside)), key=excess.__getitem__)
    i, joint, x = outside[worst]
    reason = "out of reach" if joint.kind == "prismatic" else "joint limit"
    limit = joint.upper if x > joint.upper else joint.lower
    return excess[worst][1], IKResult(reason=reason, joint=i, amount=x, limit=limit)


def _scalar_branches(arm: ArmModel, rows: Any, w: Any, near: list[float]) -> list[list[float]]:
    """As `branches`, for one pose in floats; each joint in the turn nearest to `near` inside its limits."""
    found = []
    for side in (1.0, -1.0):
        q123 = _shoulder(math, arm, w, side)
        a, b = _roll_direction(math, q123, rows)
        in_line = math.hypot(a, b) < COLLINEAR
        for flip in (1.0,) if in_line else (1.0, -1.0):
            q4 = near[3] if in_line else math.atan2(flip * b, flip * a)
            q = [*q123, q4, *_bend_and_roll(math, q123, q4, rows)]
            found.append([_nearest_turn(j, x, x0) for j, x, x0 in zip(arm.joints, q, near, strict=True)])
    return found


def _nearest_turn(joint: Joint, x: float, near: float) -> float:
    """`x` plus whole turns: nearest to `near` among those inside the limits, else nearest to the limits."""
    if joint.kind == "prismatic":
        return x
    turn = 2 * math.pi
    x += turn * round((near - x) / turn)
    if x > joint.upper and x - turn >= joint.lower - SLACK:
        return x - turn
    if x < joint.lower and x + turn <= joint.upper + SLACK:
        return x + turn
    if x > joint.upper or x < joint.lower:
        middle = (joint.lower + joint.upper) / 2
        x += turn * round((middle - x) / turn)
    return x


# The closed form, once for floats (m = math) and once for arrays (m = numpy): both modules have these names.
# `rows` are the upper three rows [n o a p] of X_BT.


def _wrist_centre(arm: ArmModel, rows: Any) -> Any:
    """Wrist centre seen from the shoulder, in the base frame."""
    (_, _, ax, px), (_, _, ay, py), (_, _, az, pz) = rows
    d = arm.hand.length
    return px - d * ax, py - d * ay, pz - d * az - arm.joints[0].d


def _shoulder(m: ModuleType, arm: ArmModel, w: Any, side: float) -> Any:
    """q1, q2, q3 with the boom on one side of the column or the other."""
    x, y, z = w
    d2 = arm.joints[1].d
    u = side * m.sqrt(m.fabs(x * x + y * y - d2 * d2))  # horizontal reach of the boom
    return m.atan2(y, x) - m.atan2(d2, u), m.atan2(u, z), m.sqrt(u * u + z * z)


def _roll_direction(m: ModuleType, q123: Any, rows: Any) -> Any:
    """Components of the approach direction square to the boom: joint 4 turns the wrist towards it."""
    (_, _, ax, _), (_, _, ay, _), (_, _, az, _) = rows
    c1, s1, c2, s2 = m.cos(q123[0]), m.sin(q123[0]), m.cos(q123[1]), m.sin(q123[1])
    return c2 * (c1 * ax + s1 * ay) - s2 * az, -s1 * ax + c1 * ay


def _bend_and_roll(m: ModuleType, q123: Any, q4: Any, rows: Any) -> Any:
    """q5 and q6, once q4 is chosen."""
    (_, ox, ax, _), (_, oy, ay, _), (_, oz, az, _) = rows
    c1, s1, c2, s2 = m.cos(q123[0]), m.sin(q123[0]), m.cos(q123[1]), m.sin(q123[1])
    c4, s4 = m.cos(q4), m.sin(q4)
    a1, a2, a3 = c2 * (c1 * ax + s1 * ay) - s2 * az, -s1 * ax + c1 * ay, s2 * (c1 * ax + s1 * ay) + c2 * az
    o1, o2, o3 = c2 * (c1 * ox + s1 * oy) - s2 * oz, -s1 * ox + c1 * oy, s2 * (c1 * ox + s1 * oy) + c2 * oz
    q5 = m.atan2(c4 * a1 + s4 * a2, a3)
    s6 = -m.cos(q5) * (c4 * o1 + s4 * o2) + m.sin(q5) * o3
    return q5, m.atan2(s6, c4 * o2 - s4 * o1)
