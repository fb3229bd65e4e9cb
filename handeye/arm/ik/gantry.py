"""Inverse kinematics of a gantry: three sliding axes carry a wrist with three revolute joints, each perpendicular
to the next.

The slides do not turn the hand. The orientation of the hand alone therefore determines the wrist joints. Once the
wrist joints are known, the position of the hand determines the slides. The wrist axes need not meet in a point. If a
gantry has more than three slides, the others are rails, which are held at a fixed position.

There are two branches: with and without a flipped wrist. Where the first and last wrist axes are in line, only the sum
of the two joint angles matters. The first wrist joint then keeps its angle if the last wrist joint can reach the angle
that completes this sum. In this configuration the hand can still move in any direction, and turn about the line of
these two axes.
"""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from handeye.arm.ik.result import IKResult, choose, nearest_turn, shared
from handeye.arm.kinematics import chain, forward, jacobian, link_rotations
from handeye.arm.model import ArmModel, constants
from handeye.core.pose import Array, Pose, rotation_x
from handeye.program.diagnosis.reach import InLine

_COLLINEAR: Final = 1e-11  # sine of the middle wrist joint below which the others are one axis
_EXACT: Final = 1e-6  # round-off of a twist, in m/s or rad/s


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Build:
    """The constants of an arm, as the solver needs them."""

    slides: list[int]
    held: list[int]
    held_at: Array
    wrist: int  # first joint of the wrist
    X_slides: Array  # slide positions per hand displacement, (3, 3)
    R_WS: Array  # orientation of the wrist's base, (3, 3)


@lru_cache(maxsize=16)
def _build(arm: ArmModel) -> _Build:
    """Compute the constants of an arm. Raises ValueError if the arm is not a gantry with a wrist."""
    wrist = len(arm.joints) - 3
    held = [i for i, joint in enumerate(arm.joints) if joint.name in arm.held]
    slides = [i for i in range(wrist) if i not in held]
    kinds = [joint.kind for joint in arm.joints]
    square = all(abs(math.cos(joint.alpha)) < _COLLINEAR for joint in arm.joints[-3:-1])
    if kinds != ["prismatic"] * wrist + ["revolute"] * 3 or len(slides) != 3 or not square:
        raise ValueError(
            f"the {arm.name} arm is not a gantry: it must have three free slides that carry a wrist of three joints"
        )
    R, _ = chain(arm, np.zeros(len(arm.joints)))
    return _Build(
        slides=slides, held=held, held_at=np.array([arm.held[arm.joints[i].name] for i in held]), wrist=wrist,
        X_slides=np.asarray(np.linalg.inv(R[slides, :, 2].T), dtype=np.float64), R_WS=R[wrist],
    )  # fmt: skip


def branches(arm: ArmModel, X_WT: Pose, start: Array | None) -> tuple[Array, NDArray[np.bool_]]:
    """Return two branches: wrist not flipped, then flipped. Both branches always exist."""
    b, X = _build(arm), np.asarray(X_WT, dtype=np.float64)
    q = np.zeros((*X.shape[:-2], 2, len(arm.joints)))
    q[..., b.held] = b.held_at if start is None else start[b.held]
    left = 0.0 if start is None else float(start[b.wrist])
    M = b.R_WS.T @ X[..., :3, :3] @ rotation_x(-arm.joints[-1].alpha)
    for branch, flip in enumerate((1.0, -1.0)):
        q[..., branch, b.wrist :] = _wrist(arm, b, M, flip, left)
    rest = X[..., None, :3, 3] - forward(arm, q)[..., :3, 3]
    q[..., b.slides] = rest @ b.X_slides.T
    turned = np.where(constants(arm).prismatic, q, np.pi - np.mod(np.pi - q, 2 * np.pi))
    return turned, np.ones(q.shape[:-1], dtype=np.bool_)


def _wrist(arm: ArmModel, b: _Build, M: Array, flip: float, left: float) -> Array:
    """Find the wrist joints, shape (..., 3), for orientations `M` relative to the base of the wrist, shape (..., 3,
    3).
    """
    k, i = constants(arm), b.wrist
    x, y, z = M[..., 0, 2], M[..., 1, 2], M[..., 2, 2]
    roll = np.where(np.hypot(x, y) < _COLLINEAR, left, np.atan2(flip * y, flip * x))
    s4, s5 = k.sin_alpha[i], k.sin_alpha[i + 1]
    pitch = np.atan2(s5 * (np.cos(roll) * x + np.sin(roll) * y), -s4 * s5 * z)
    K = link_rotations(roll, k.cos_alpha[i], s4) @ link_rotations(pitch, k.cos_alpha[i + 1], s5)
    N = np.swapaxes(K, -1, -2) @ M
    return np.stack([roll, pitch, np.atan2(N[..., 1, 0], N[..., 0, 0])], axis=-1)


def solve(arm: ArmModel, X_WT: Pose, near: Array) -> IKResult:
    """Find the best branch within the joint limits. If no branch is within the limits, the result names the joint that
    is farthest beyond its limits.
    """
    b, start = _build(arm), near.copy()
    start[b.held] = b.held_at
    here = near.tolist()
    found = [
        [nearest_turn(j, x, x0) for j, x, x0 in zip(arm.joints, q, here, strict=True)]
        for branch in branches(arm, X_WT, start)[0].tolist()
        for q in _ways(arm, branch)
    ]
    return choose(arm, found, here)


def _ways(arm: ArmModel, q: list[float]) -> list[list[float]]:
    """Return the given configuration. But if the first and last wrist axes are in line, these two joints can share the
    turn in several ways: return all of these configurations that are within the limits.
    """
    if abs(math.sin(q[-2])) >= _COLLINEAR:
        return [q]
    first, middle, last = arm.joints[-3:]
    same_way = -math.cos(q[-2]) * math.sin(first.alpha) * math.sin(middle.alpha)
    ways = shared(first, last, same_way, q[-3], q[-1])
    return [[*q[:-3], one, q[-2], other] for one, other in ways] or [q]


def singular(arm: ArmModel, q_start: Array, q: Array, V: Array) -> tuple[int, InLine] | None:
    """Find the first configuration where the wrist would have to swing round, or cannot turn the hand as wanted.
    Returns the index of this configuration and the reason, or None if the wrist can follow the whole motion.
    """
    i = _build(arm).wrist
    J = jacobian(arm, q)
    missed = np.abs((J @ rates(arm, q, J, V)[..., None])[..., 0] - V).max(axis=-1) > _EXACT
    swing = np.diff(np.concatenate([q_start[i : i + 1], q[:, i]]))
    swing -= 2 * np.pi * np.round(swing / (2 * np.pi))
    stuck = missed | (np.abs(swing) > arm.joints[i].speed * arm.servo.period)
    return (int(np.argmax(stuck)), InLine((i, i + 2))) if stuck.any() else None


def rates(arm: ArmModel, q: Array, J: Array, V: Array) -> Array:
    """Return the rates of wrist and slides. Held joints do not move."""
    b = _build(arm)
    in_line = np.abs(np.sin(q[:, b.wrist + 1])) < _COLLINEAR
    turning = J[:, 3:, b.wrist :].copy()
    turning[in_line, :, 0] = 0.0
    qd = np.zeros(q.shape)
    qd[:, b.wrist :] = (np.linalg.pinv(turning) @ V[:, 3:, None])[..., 0]
    swept = (J[:, :3, b.wrist :] @ qd[:, b.wrist :, None])[..., 0]
    qd[:, b.slides] = (V[:, :3] - swept) @ b.X_slides.T
    return qd
