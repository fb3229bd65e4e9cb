"""A pose that forward kinematics gives from joints within their limits has a solution, exact or as it is written."""

import math
from dataclasses import replace

import numpy as np
import pytest
from robots import ROBOTS

from benchmarks.reached_poses import Tried, tried
from handeye.arm.ik import branches, solve
from handeye.arm.ik.result import WRITTEN, shared
from handeye.arm.kinematics import forward
from handeye.arm.model import ArmModel
from handeye.arm.robots.stanford import STANFORD
from handeye.core.pose import translated
from handeye.core.units import DEGREE, INCH

ARMS = {name: robot.arm for name, robot in ROBOTS.items()}


@pytest.mark.parametrize("arm", ARMS.values(), ids=ARMS)
def test_every_pose_is_found_within_limits_with_the_hand_there(arm: ArmModel) -> None:
    bad = [each for each in tried(arm, 40, 40) if each.missed or each.wrong]
    assert not bad


def test_a_miss_and_a_wrong_pose_are_counted() -> None:
    arm = replace(STANFORD, joints=(replace(STANFORD.joints[0], lower=0.0), *STANFORD.joints[1:]))
    (found, *_) = tried(arm, 20, 1)
    assert found == Tried(what="anywhere", written=False, poses=20, off=found.off, turned=found.turned)


@pytest.mark.parametrize("roll", [-169.0, -30.0, 0.0, 12.5, 170.0])
@pytest.mark.parametrize("together", [178.0, -171.0, 180.0, 340.0, 5.0])
def test_joints_in_line_share_their_turn_so_that_both_are_within_limits(roll: float, together: float) -> None:
    q = np.array([0.4, 1.2, 0.7, together / 2 * DEGREE, 0.0, together / 2 * DEGREE])
    near = np.array([0.0, 1.0, 0.5, roll * DEGREE, 0.0, 0.0])
    found = solve(STANFORD, forward(STANFORD, q), near).q
    assert found is not None
    assert (np.abs(found[[3, 5]]) <= 170 * DEGREE + 1e-9).all()
    np.testing.assert_allclose(forward(STANFORD, found), forward(STANFORD, q), atol=1e-9)
    if abs(math.remainder(together - roll, 360)) <= 170:
        assert found[3] == near[3]


def test_joints_in_line_that_turn_against_each_other_keep_their_difference() -> None:
    first, last = STANFORD.joints[3], STANFORD.joints[5]
    ways = shared(first, last, -1.0, 100 * DEGREE, -100 * DEGREE)
    assert ways
    for one, other in ways:
        assert math.remainder(one - other - 200 * DEGREE, 2 * math.pi) == pytest.approx(0)
        assert max(abs(one), abs(other)) <= 170 * DEGREE + 1e-9


@pytest.mark.parametrize("off", [0.0, 1e-13, 1e-7, 0.9 * WRITTEN[0]])
def test_the_boom_may_stand_upright_as_near_as_digits_tell(off: float) -> None:
    q = np.array([1.1, 0.0, 0.9, 0.5, 0.8, -0.3])
    X = forward(STANFORD, q)
    inwards = STANFORD.X_WB[:3, :3] @ [math.sin(q[0]), -math.cos(q[0]), 0.0]
    found = solve(STANFORD, translated(X, off * inwards), STANFORD.middle)
    assert found.q is not None, found.message(STANFORD)
    np.testing.assert_allclose(forward(STANFORD, found.q), X, atol=max(off, 1e-12))
    assert branches(STANFORD, translated(X, off * inwards))[1].all()


def test_nearer_than_that_the_wrist_is_refused_with_the_difference() -> None:
    q = np.array([1.1, 0.0, 0.9, 0.5, 0.8, -0.3])
    inwards = STANFORD.X_WB[:3, :3] @ [math.sin(q[0]), -math.cos(q[0]), 0.0]
    refused = solve(STANFORD, translated(forward(STANFORD, q), 0.01 * INCH * inwards), STANFORD.middle)
    assert refused.message(STANFORD) == (
        "the wrist would have to be 6.05 in from the axis of joint 1; the minimum is 6.06 in"
    )


def test_a_pose_beyond_a_limit_by_more_than_its_digits_is_refused() -> None:
    q = np.array([0.3, 1.7, 50.004 * INCH, 0.2, 1.0, 0.4])
    assert solve(STANFORD, forward(STANFORD, q), q).q is None
