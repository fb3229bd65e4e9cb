"""Compares the arm's inverse kinematics with those of the Robotics Toolbox, on the same poses of the hand."""

from collections.abc import Callable
from functools import partial
from typing import Any, Final

import numpy as np

from benchmarks.peers import Comparison, Outcome, Trial, Way, timed
from handeye.arm.ik import branches, solve
from handeye.arm.kinematics import forward
from handeye.arm.model import ArmModel
from handeye.core.pose import Array, Pose, inverse
from handeye.core.versions import installed

SEED: Final = 0
TOOLBOX: Final = "roboticstoolbox-python"
REACHED: Final = 1e-4
"""A solution counts if the hand is at most this far from its pose (m)."""
TOLERANCE: Final = 1e-10
"""Half the square of the error (m and rad) at which the toolbox stops. Its default, 1e-6, leaves an error of a
millimetre.
"""
_way = partial(Way.measured, unit="m")


def measure(arm: ArmModel, poses: int, times: int) -> Comparison:
    """Solve for reachable poses, one at a time and all at once, each `times` times."""
    rng = np.random.default_rng(SEED)
    X = [forward(arm, q) for q in rng.uniform(arm.lower, arm.upper, (poses, len(arm.joints)))]
    version = installed(TOOLBOX)
    toolbox = [] if version is None else [_toolbox(arm, X, times, version)]
    return Comparison(
        ours=_one_way("closed form, one pose at a time", partial(_solved, arm), arm, X, times),
        others=(_at_once(arm, np.array(X), times), *toolbox),
        missing=(TOOLBOX,) if version is None else (),
    )


def _one_way(
    name: str, find: Callable[[Pose], Array | None], arm: ArmModel, X: list[Pose], times: int
) -> Way:
    trials: list[Trial[Array | None]] = [(partial(find, each), partial(_outcome, arm, each)) for each in X]
    return _way("hand poses", name, trials=trials, times=times)


def _solved(arm: ArmModel, X_WT: Pose) -> Array | None:
    return solve(arm, X_WT, arm.middle).q


def _outcome(arm: ArmModel, X_WT: Pose, q: Array | None) -> Outcome:
    if q is None or np.any(q < arm.lower - 1e-9) or np.any(q > arm.upper + 1e-9):
        return Outcome(error=None)
    off = float(np.linalg.norm(forward(arm, q)[:3, 3] - X_WT[:3, 3]))
    return Outcome(error=off if off <= REACHED else None)


def _at_once(arm: ArmModel, X: Pose, times: int) -> Way:
    """Compute all branches of all poses in one call, without joint limits. The time of a pose is its share of the
    call.
    """
    (q, exists), seconds = timed(partial(branches, arm, X), times)
    off = np.where(exists, np.linalg.norm(forward(arm, q)[..., :3, 3] - X[:, None, :3, 3], axis=-1), np.inf)
    nearest = off.min(axis=1)
    outcomes = tuple(Outcome(error=float(each) if each <= REACHED else None) for each in nearest)
    return Way(
        task="hand poses", name="closed form, all at once", unit="m",
        outcomes=outcomes, seconds=(seconds / len(X),) * len(X),
    )  # fmt: skip


def _toolbox(arm: ArmModel, X: list[Pose], times: int, version: str) -> Way:
    """Solve with the toolbox's search, for the same kinematic chain and limits. The search starts in the middle of the
    joint ranges.
    """
    chain, X_BW = toolbox_chain(arm), inverse(arm.X_WB)

    def found(X_WT: Pose) -> Array | None:
        solution = chain.ik_LM(X_BW @ X_WT, q0=arm.middle, joint_limits=True, tol=TOLERANCE)
        return np.asarray(solution.q) if solution.success else None

    return _one_way(f"ETS.ik_LM, roboticstoolbox {version}", found, arm, X, times)


def toolbox_chain(arm: ArmModel) -> Any:
    """Return the arm in the form that the toolbox uses: a chain of elementary transforms."""
    from roboticstoolbox import ET, ETS  # large, and seldom installed

    parts = []
    for joint in arm.joints:
        limits = joint.lower, joint.upper
        turning = joint.kind == "revolute"
        parts += [ET.Rz(qlim=limits), ET.tz(joint.d)] if turning else [ET.Rz(joint.theta), ET.tz(qlim=limits)]
        parts.append(ET.Rx(joint.alpha))
    return ETS(parts)
