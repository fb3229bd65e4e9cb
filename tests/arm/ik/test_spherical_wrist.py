import msgspec
import numpy as np
import pytest
from arm_in_mujoco import postures

from handeye.arm.ik import IKResult, branches, solve
from handeye.arm.kinematics import forward
from handeye.arm.robots.stanford import STANFORD
from handeye.core.pose import hand, pose, rotation_z
from handeye.core.units import DEGREE, INCH
from handeye.program.diagnosis.cause_text import cause_sentence
from handeye.program.diagnosis.causes import BeyondArm
from handeye.program.diagnosis.reach import InnerCylinder, JointLimit, OutOfReach, TooNear


def at(x: float, y: float, z: float, yaw: float = 90.0) -> np.ndarray:
    """The hand pointing straight down; inches, and degrees of the finger line from table x."""
    return hand(x * INCH, y * INCH, z * INCH, yaw * DEGREE, np.pi / 2, 0)


PARK = np.array([-19.7 * DEGREE, 104 * DEGREE, 17.5 * INCH, 0, 76 * DEGREE, 70.3 * DEGREE])


@pytest.mark.row(37)
def test_all_four_branches_lead_back_to_the_pose() -> None:
    q = postures(STANFORD, 10_000, seed=3)
    X = forward(STANFORD, q)
    found, exists = branches(STANFORD, X)
    assert exists.all()
    np.testing.assert_allclose(
        forward(STANFORD, found), np.broadcast_to(X[:, None], (10_000, 4, 4, 4)), atol=1e-9
    )
    assert np.abs(found - q[:, None]).max(axis=-1).min(axis=-1).max() < 1e-6


def test_solve_finds_the_posture_it_is_near() -> None:
    for q in postures(STANFORD, 500, seed=4):
        result = solve(STANFORD, forward(STANFORD, q), q)
        assert result.q is not None
        np.testing.assert_allclose(result.q, q, atol=1e-6)


def test_solve_takes_the_branch_nearest_inside_the_limits() -> None:
    far = postures(STANFORD, 200, seed=6)
    for X, near in zip(forward(STANFORD, postures(STANFORD, 200, seed=5)), far, strict=True):
        q = solve(STANFORD, X, near).q
        found, _ = branches(STANFORD, X)
        speed = np.array([joint.speed for joint in STANFORD.joints])
        inside = ((found >= STANFORD.lower - 1e-9) & (found <= STANFORD.upper + 1e-9)).all(axis=-1)
        cost = (np.abs(found - near) / speed).sum(axis=-1)[inside]
        assert (np.abs(q - near) / speed).sum() == pytest.approx(cost.min())


@pytest.mark.row(38)
def test_a_straight_wrist_keeps_joint_4_and_the_sum_of_4_and_6() -> None:
    q = np.array([0.1, 1.5, 0.6, 0.4, 0.0, 0.5])
    result = solve(STANFORD, forward(STANFORD, q), np.array([0.1, 1.5, 0.6, 0.7, 0.0, 0.0])).q
    np.testing.assert_allclose(result, [0.1, 1.5, 0.6, 0.7, 0.0, 0.2], atol=1e-9)
    first = branches(STANFORD, forward(STANFORD, q))[0][0]
    np.testing.assert_allclose(first, [0.1, 1.5, 0.6, 0.0, 0.0, 0.9], atol=1e-9)


def test_a_wrist_inside_the_inner_cylinder_has_no_solution() -> None:
    result = solve(STANFORD, at(20, 15, 8), PARK)
    assert result.q is None
    assert isinstance(result.reason, InnerCylinder)
    assert result.reason.radius == pytest.approx(5 * INCH)
    assert result.message(STANFORD) == (
        "the wrist would have to be 5.0 in from the axis of joint 1; the minimum is 6.1 in"
    )


@pytest.mark.parametrize("goal", [(20, 15, 8), (20, 66, 3), (20, 20, 14)])
def test_a_failure_is_a_cause_that_goes_to_disk_and_is_told_in_the_same_words(
    goal: tuple[float, float, float],
) -> None:
    result = solve(STANFORD, at(*goal), PARK)
    cause = result.cause(STANFORD, "OVER")
    assert msgspec.json.decode(msgspec.json.encode(cause), type=BeyondArm) == cause
    assert cause_sentence(cause) == f"OVER: {result.message(STANFORD)}"


def test_a_cause_holds_plain_numbers_whatever_a_solver_computed_with() -> None:
    result = IKResult(reason=OutOfReach(np.int64(2), np.float64(1.4), 1.27))
    assert b'"joint":2,"amount":1.4,' in msgspec.json.encode(result.cause(STANFORD))


def test_beyond_the_boom_is_out_of_reach() -> None:
    result = solve(STANFORD, at(20, 66, 3), PARK)
    assert isinstance(result.reason, OutOfReach)
    assert result.message(STANFORD) == "joint 3 (boom) would have to be at 56.4 in; its limit is 50.0 in"


def test_a_boom_too_short_begins_rather_than_ends() -> None:
    result = solve(STANFORD, at(20, 20, 14), PARK)
    assert isinstance(result.reason, TooNear)
    assert result.message(STANFORD) == "joint 3 (boom) would have to be at 8.1 in; its limit is 12.0 in"


def test_a_hand_that_would_point_at_its_own_arm_meets_a_joint_limit() -> None:
    X = pose(rotation_z(np.pi / 2) @ np.array([[0, 0, -1.0], [0, 1, 0], [1, 0, 0]]), (0.5, 1.0, 0.3))
    result = solve(STANFORD, X, PARK)
    assert result.q is None
    assert isinstance(result.reason, JointLimit)
    assert result.reason.joint == 4
    assert "joint 5 (wrist bend) would have to be" in result.message(STANFORD)
    assert "degrees; its limit is 110.0 degrees" in result.message(STANFORD)


@pytest.mark.parametrize(
    ("x", "y", "z", "yaw", "q1", "q2", "q3", "q5", "q6"),
    [
        (20, 28, 8, 90, -19.7, 104.0, 17.5, 76.0, 70.3),
        (23.375, 38, 1.25, 180, -19.3, 111.7, 29.6, 68.3, -19.3),
        (6, 41, 9.0, 90, 14.0, 95.5, 33.6, 84.5, 104.0),
    ],
)
def test_stations_of_the_layout_have_the_listed_postures(
    x: float, y: float, z: float, yaw: float, q1: float, q2: float, q3: float, q5: float, q6: float
) -> None:
    q = solve(STANFORD, at(x, y, z, yaw), PARK).q
    listed = np.array([q1, q2, q3, 0, q5, q6])
    unit = np.array([DEGREE, DEGREE, INCH, DEGREE, DEGREE, DEGREE])
    np.testing.assert_allclose(q / unit, listed, atol=0.06)


def test_a_hand_straight_down_needs_no_joint_4_and_a_fixed_sum_of_2_and_5() -> None:
    rng = np.random.default_rng(7)
    for x, y, z, yaw in zip(rng.uniform(10, 40, 50), rng.uniform(28, 50, 50), rng.uniform(0, 8, 50),
                            rng.uniform(60, 120, 50), strict=True):  # fmt: skip
        q = solve(STANFORD, at(x, y, z, yaw), PARK).q
        np.testing.assert_allclose([q[3], q[1] + q[4]], [0, np.pi], atol=1e-9)
        np.testing.assert_allclose(q[5] - q[0], np.pi - yaw * DEGREE, atol=1e-9)


def test_a_solution_has_no_message() -> None:
    assert IKResult(q=np.zeros(6)).message(STANFORD) == ""
