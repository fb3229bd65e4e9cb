"""Every solver gives the same, whatever the structure of its arm."""

import numpy as np
import pytest
from arm_in_mujoco import postures
from robots import ROBOTS

from handeye.arm.ik import branches, solve
from handeye.arm.kinematics import forward
from handeye.arm.model import ArmModel, constants
from handeye.program.diagnosis.reach import OutOfReach

pytestmark = pytest.mark.parametrize("arm", [robot.arm for robot in ROBOTS.values()], ids=list(ROBOTS))

BRANCHES = {"spherical wrist": 4, "gantry": 2, "cartesian": 1}


def apart(arm: ArmModel, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Greatest distance of two configurations in any joint, whole turns left out."""
    turns = np.where(constants(arm).prismatic, 0.0, 2 * np.pi * np.round((a - b) / (2 * np.pi)))
    return np.abs(a - b - turns).max(axis=-1)


def test_all_branches_lead_back_to_the_pose_and_one_of_them_is_where_it_came_from(arm: ArmModel) -> None:
    q = postures(arm, 1000, seed=3)
    X = forward(arm, q)
    found, exists = branches(arm, X)
    assert found.shape == (1000, BRANCHES[arm.structure], len(arm.joints))
    assert exists.all()
    np.testing.assert_allclose(
        forward(arm, found), np.broadcast_to(X[:, None], (*found.shape[:2], 4, 4)), atol=1e-9
    )
    assert apart(arm, found, q[:, None]).min(axis=-1).max() < 1e-6


def test_the_branches_differ(arm: ArmModel) -> None:
    found, _ = branches(arm, forward(arm, postures(arm, 50, seed=4)))
    for one in range(found.shape[1]):
        for other in range(one):
            assert apart(arm, found[:, one], found[:, other]).min() > 1e-3


def test_solve_finds_the_posture_it_is_near(arm: ArmModel) -> None:
    for q in postures(arm, 200, seed=4):
        result = solve(arm, forward(arm, q), q)
        assert result.q is not None
        np.testing.assert_allclose(result.q, q, atol=1e-6)


def test_solve_takes_the_branch_nearest_inside_the_limits(arm: ArmModel) -> None:
    speed = constants(arm).speed
    far = postures(arm, 200, seed=6)
    for X, near in zip(forward(arm, postures(arm, 200, seed=5)), far, strict=True):
        q = solve(arm, X, near).q
        found, _ = branches(arm, X)
        inside = ((found >= arm.lower - 1e-9) & (found <= arm.upper + 1e-9)).all(axis=-1)
        cost = (np.abs(found - near) / speed).sum(axis=-1)[inside]
        assert (np.abs(q - near) / speed).sum() <= cost.min() + 1e-9


def test_a_joint_that_is_held_goes_to_where_it_is_held(arm: ArmModel) -> None:
    for i, joint in enumerate(arm.joints):
        if joint.name in arm.held:
            near = postures(arm, 1)[0]
            near[i] += 0.1
            q = solve(arm, forward(arm, postures(arm, 1)[0]), near).q
            assert q is not None
            assert q[i] == arm.held[joint.name]


def test_a_pose_beyond_a_slide_is_refused_with_the_joint_and_its_limit(arm: ArmModel) -> None:
    for i, joint in enumerate(arm.joints):
        if joint.kind == "revolute" or joint.name in arm.held:
            continue
        q = arm.middle
        q[i] = joint.upper + 0.1
        result = solve(arm, forward(arm, q), arm.middle)
        assert result.q is None
        assert isinstance(result.reason, OutOfReach)
        assert (result.reason.joint, result.reason.excess) == (i, pytest.approx(0.1))
        assert f"joint {i + 1} ({joint.name}) would have to be" in result.message(arm)
        assert "; its limit is" in result.message(arm)
