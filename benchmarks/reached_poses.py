"""Tests inverse kinematics on poses that forward kinematics computes from joint positions within the limits.

Some poses are random. The others are those at which closed-form solutions are least accurate: joints at limits, joint
axes in line, or the boom upright. Each pose is tried exactly, and rounded as in a taught file: to .001 in and .01
degrees.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.arm.ik import solve
from handeye.arm.ik.result import SLACK, WRITTEN
from handeye.arm.kinematics import forward
from handeye.arm.model import ArmModel
from handeye.core.pose import Array, Pose, hand
from handeye.core.units import DEGREE, INCH

SEED: Final = 0
EXACT: Final = 2e-9
"""Greatest permitted deviation (m or rad) of the hand from an exact pose."""
_CLOSENESS: Final = (
    -17.0,
    -2.0,
)  # powers of ten between which a joint deviates from its singular position, rad
_AT_LIMIT: Final = 0.3  # fraction of the joints

Set = Callable[[ArmModel, Array, np.random.Generator], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class Tried:
    """The results for one set of poses."""

    what: str
    written: bool  # rounded as in a taught file
    poses: int
    missed: int = 0  # no solution found, although the arm can reach the pose
    wrong: int = 0  # solution beyond the limits, or with the hand at a different pose
    off: float = 0.0  # greatest distance of the hand from its pose, m
    turned: float = 0.0  # greatest rotation of the hand from its pose, rad


def tried(arm: ArmModel, anywhere: int, singular: int) -> Iterator[Tried]:
    """Try `anywhere` random poses, and `singular` poses of each singular set, both exact and rounded."""
    rng = np.random.default_rng(SEED)
    for what, change in _sets(arm).items():
        q = rng.uniform(arm.lower, arm.upper, (singular if change else anywhere, len(arm.joints)))
        q[:] = np.where([joint.name in arm.held for joint in arm.joints], arm.middle, q)
        for each in change:
            each(arm, q, rng)
        X = forward(arm, q)
        near = np.where(rng.random((len(q), 1)) < 0.5, arm.middle, rng.permutation(q))
        yield _try(arm, what, X, near)
        yield _try(arm, what, np.array([_as_written(each) for each in X]), near, written=True)


def _sets(arm: ArmModel) -> Mapping[str, tuple[Set, ...]]:
    sets: dict[str, tuple[Set, ...]] = {"anywhere": (), "joints at limits": (_at_limits,)}
    if arm.structure != "cartesian":
        sets |= {"wrist in line": (_in_line,), "wrist in line, joints at limits": (_at_limits, _in_line)}
    if arm.structure == "spherical wrist":
        sets |= {
            "boom upright": (_upright,),
            "boom upright, joints at limits": (_at_limits, _upright),
            "boom upright, wrist in line": (_upright, _in_line),
            "all three": (_at_limits, _upright, _in_line),
        }
    return sets


def _at_limits(arm: ArmModel, q: Array, rng: np.random.Generator) -> None:
    free = np.array([joint.name not in arm.held for joint in arm.joints])
    at = (rng.random(q.shape) < _AT_LIMIT) & free
    q[:] = np.where(at, np.where(rng.random(q.shape) < 0.5, arm.lower, arm.upper), q)


def _in_line(arm: ArmModel, q: Array, rng: np.random.Generator) -> None:
    q[:, -2] = _nearly_zero(len(q), rng)


def _upright(arm: ArmModel, q: Array, rng: np.random.Generator) -> None:
    q[:, 1] = _nearly_zero(len(q), rng)


def _nearly_zero(count: int, rng: np.random.Generator) -> Array:
    """Return numbers near zero; a third of them are exactly 0."""
    sign = rng.integers(-1, 2, count)
    return np.asarray(sign * 10 ** rng.uniform(*_CLOSENESS, count))


def _as_written(X: Pose) -> Pose:
    """Return a pose, rounded as in a taught file."""
    across = math.hypot(X[0, 2], X[1, 2])
    o = math.atan2(X[0, 2], -X[1, 2]) if across > 1e-12 else 0.0
    along = np.array([math.cos(o), math.sin(o), 0.0])
    t = math.atan2(float(along @ X[:3, 0]), float(along @ X[:3, 1]))
    lengths = [round(x / INCH, 3) * INCH for x in X[:3, 3].tolist()]
    angles = [round(x / DEGREE, 2) * DEGREE for x in (o, math.atan2(-X[2, 2], across), t)]
    return hand(*lengths, *angles)


def _try(arm: ArmModel, what: str, X: Pose, near: Array, *, written: bool = False) -> Tried:
    found = [solve(arm, each, start).q for each, start in zip(X, near, strict=True)]
    there = np.array([q is not None for q in found])
    q = np.array([q for q in found if q is not None]).reshape(-1, len(arm.joints))
    Y = forward(arm, q)
    off = np.linalg.norm(Y[:, :3, 3] - X[there, :3, 3], axis=-1)
    turned = np.linalg.norm(Y[:, :3, :3] - X[there, :3, :3], axis=(-2, -1)) / math.sqrt(2)
    lengths, angles = WRITTEN if written else (EXACT, EXACT)
    inside = ((q >= arm.lower - SLACK) & (q <= arm.upper + SLACK)).all(axis=-1)
    right = inside & (np.hypot(off / lengths, turned / angles) <= 1)
    return Tried(
        what=what, written=written, poses=len(X), missed=int((~there).sum()), wrong=int((~right).sum()),
        off=float(off.max(initial=0.0)), turned=float(turned.max(initial=0.0)),
    )  # fmt: skip
