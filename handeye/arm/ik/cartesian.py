"""Inverse kinematics of an arm with one to three sliding axes. The hand moves on a line, in a plane or in space,
and never turns.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from handeye.arm.ik.result import WRITTEN, IKResult, choose
from handeye.arm.kinematics import chain, forward
from handeye.arm.model import ArmModel
from handeye.core.pose import Array, Pose
from handeye.program.diagnosis.reach import FixedDirection, FixedOrientation, InLine


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Build:
    """The constants of an arm, as the solver needs them."""

    slides: list[int]
    held: list[int]
    held_at: Array
    axes: Array  # hand displacement per joint position, (3, n)
    inverse: Array  # joint positions per displacement, (n, 3)
    R_WT: Array  # orientation of the hand, (3, 3)


@lru_cache(maxsize=16)
def _build(arm: ArmModel) -> _Build:
    """Compute the constants of an arm. Raises ValueError if the arm is not cartesian."""
    held = [i for i, joint in enumerate(arm.joints) if joint.name in arm.held]
    slides = [i for i in range(len(arm.joints)) if i not in held]
    R, _ = chain(arm, np.zeros(len(arm.joints)))
    axes = R[slides, :, 2].T
    if any(joint.kind != "prismatic" for joint in arm.joints) or np.linalg.matrix_rank(axes) < len(slides):
        raise ValueError(
            f"the {arm.name} arm is not a Cartesian arm: it must have one to three slides in different directions, "
            "and no other joints"
        )
    return _Build(
        slides=slides, held=held, held_at=np.array([arm.held[arm.joints[i].name] for i in held]),
        axes=axes, inverse=np.asarray(np.linalg.pinv(axes), dtype=np.float64), R_WT=R[-1],
    )  # fmt: skip


def branches(arm: ArmModel, X_WT: Pose, start: Array | None) -> tuple[Array, NDArray[np.bool_]]:
    """Return the joint positions of the only possible branch, and whether this branch exists. It exists if the slides
    alone can bring the hand to the pose, without turning the hand.
    """
    b, X = _build(arm), np.asarray(X_WT, dtype=np.float64)
    q, off = _nearest_position(arm, b, X, b.held_at if start is None else start[b.held])
    exists = (np.linalg.norm(off, axis=-1) <= WRITTEN[0]) & (_turn_angle(b, X) <= WRITTEN[1])
    return q[..., None, :], exists[..., None]


def _nearest_position(arm: ArmModel, b: _Build, X_WT: Pose, held_at: Array) -> tuple[Array, Array]:
    """Find the joint positions that bring the hand nearest to each of the given poses. Returns the positions, shape
    (..., n), and the remaining displacement, shape (..., 3), in m.
    """
    q = np.zeros((*X_WT.shape[:-2], len(arm.joints)))
    q[..., b.held] = held_at
    displacement = X_WT[..., :3, 3] - forward(arm, q)[..., :3, 3]
    q[..., b.slides] = displacement @ b.inverse.T
    return q, displacement - q[..., b.slides] @ b.axes.T


def _turn_angle(b: _Build, X_WT: Pose) -> Array:
    """Return the angle (rad) between the fixed orientation of the hand and the orientation of each pose."""
    chord = np.linalg.norm(X_WT[..., :3, :3] - b.R_WT, axis=(-2, -1)) / (2 * math.sqrt(2))
    return np.asarray(2 * np.arcsin(np.minimum(chord, 1.0)))


def solve(arm: ArmModel, X_WT: Pose, near: Array) -> IKResult:
    """Find the solution. If there is none, find the turn, the direction or the joint limit that prevents a solution."""
    b = _build(arm)
    angle = float(_turn_angle(b, X_WT))
    if angle > WRITTEN[1]:
        return IKResult(reason=FixedOrientation(angle))
    q, off = _nearest_position(arm, b, X_WT, b.held_at)
    distance = float(np.linalg.norm(off))
    if distance > WRITTEN[0]:
        return IKResult(reason=FixedDirection(tuple(b.slides), distance))
    return choose(arm, [q.tolist()], near.tolist())


def singular(arm: ArmModel, q_start: Array, q: Array, V: Array) -> tuple[int, InLine] | None:
    """Return None: a cartesian arm has no singular configurations."""
    return None


def rates(arm: ArmModel, q: Array, J: Array, V: Array) -> Array:
    """Return the rates of the slides. Held joints do not move."""
    b, qd = _build(arm), np.zeros(q.shape)
    qd[:, b.slides] = V[:, :3] @ b.inverse.T
    return qd
