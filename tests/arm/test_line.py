import numpy as np
import pytest

from handeye.arm.ik import IKResult, solve
from handeye.arm.kinematics import forward
from handeye.arm.line import arc, pivot, straight
from handeye.arm.robots.stanford import STANFORD
from handeye.core.pose import hand, rotation, rotation_z
from handeye.core.units import DEGREE, INCH, JIFFY
from handeye.program.diagnosis.reach import InLine, JointLimit, OutOfReach

PARK = np.array([-19.7 * DEGREE, 104 * DEGREE, 17.5 * INCH, 0, 76 * DEGREE, 70.3 * DEGREE])


def at(x: float, y: float, z: float, tilt: float = 0.0) -> np.ndarray:
    q = solve(STANFORD, hand(x * INCH, y * INCH, z * INCH, np.pi / 2, np.pi / 2 - tilt, 0), PARK).q
    assert q is not None
    return q


DISPLACEMENT = np.array([3.0, -2.0, 1.0]) * INCH


def test_a_straight_line_stays_straight_and_keeps_the_orientation() -> None:
    q = at(24, 38, 3, tilt=0.3)
    X0, X = forward(STANFORD, q), forward(STANFORD, straight(STANFORD, q, DISPLACEMENT, INCH).q)
    u = DISPLACEMENT / np.linalg.norm(DISPLACEMENT)
    way = X[:, :3, 3] - X0[:3, 3]
    np.testing.assert_allclose(way, (way @ u)[:, None] * u, atol=1e-12)
    np.testing.assert_allclose(X[:, :3, :3], np.tile(X0[:3, :3], (len(X), 1, 1)), atol=1e-12)
    np.testing.assert_allclose(way[-1], DISPLACEMENT, atol=1e-12)


@pytest.mark.parametrize("motion", ["line", "arc"])
def test_rates_and_accelerations_are_the_derivatives_of_positions(motion: str) -> None:
    q = at(24, 38, 3, tilt=0.3)
    line = straight(STANFORD, q, DISPLACEMENT, INCH, ramp=1.0)
    samples = line if motion == "line" else arc(STANFORD, q, np.array([0.63, 0.95]), 1.0, 0.5, ramp=1.0)
    for f, derivative in ((samples.q, samples.qd), (samples.qd, samples.qdd)):
        central = (f[2:] - f[:-2]) / (2 * JIFFY)
        np.testing.assert_allclose(derivative[1:-1], central, atol=0.02 * np.abs(derivative).max())


def test_a_pivot_turns_the_hand_on_the_spot() -> None:
    q, turn = at(24, 38, 3, tilt=0.3), np.array([0.1, -0.2, 0.3])
    X0, X = forward(STANFORD, q), forward(STANFORD, pivot(STANFORD, q, turn, 0.5).q)
    np.testing.assert_allclose(X[:, :3, 3], np.tile(X0[:3, 3], (len(X), 1)), atol=1e-12)
    np.testing.assert_allclose(X[-1, :3, :3], rotation(turn) @ X0[:3, :3], atol=1e-12)


def test_a_line_cruises_at_its_speed_after_six_periods_and_ends_at_rest() -> None:
    q = at(24, 38, 3)
    samples = straight(STANFORD, q, np.array([0, 0, -2 * INCH]), INCH)
    heights = np.concatenate([[3 * INCH], forward(STANFORD, samples.q)[:, 2, 3]])
    speed = -np.diff(heights) / JIFFY
    np.testing.assert_allclose(speed[6:-6], INCH, rtol=0.01)
    np.testing.assert_allclose([samples.qd[-1], samples.qdd[-1]], 0, atol=1e-12)


def test_a_short_line_is_slower_rather_than_jerky() -> None:
    samples = straight(STANFORD, at(24, 38, 3), np.array([0, 0, 0.001]), INCH)
    assert len(samples) == 12
    assert np.abs(np.diff(forward(STANFORD, samples.q)[:, 2, 3])).max() < INCH * JIFFY


def test_no_displacement_is_no_motion() -> None:
    assert len(straight(STANFORD, PARK, np.zeros(3), INCH)) == 0
    assert len(arc(STANFORD, PARK, np.zeros(2), 0.0, 1.0)) == 0


def test_a_line_that_leaves_the_reach_says_which_joint() -> None:
    result = straight(STANFORD, at(20, 52, 3), np.array([0, 12 * INCH, 0]), INCH)
    assert isinstance(result.reason, OutOfReach)
    assert result.reason.joint == 2
    assert isinstance(straight(STANFORD, at(20, 24, 11), np.array([0, -9 * INCH, 0]), INCH), IKResult)


def test_an_arc_keeps_its_distance_and_height_while_the_hand_yaws_along() -> None:
    q, centre = at(26, 38, 4.5), np.array([25, 38]) * INCH
    X = forward(STANFORD, arc(STANFORD, q, centre, 1.2, 0.5).q)
    np.testing.assert_allclose(np.hypot(*(X[:, :2, 3] - centre).T), INCH, atol=1e-12)
    np.testing.assert_allclose(X[:, 2, 3], 4.5 * INCH, atol=1e-12)
    turned = np.arctan2(X[-1, 1, 3] - centre[1], X[-1, 0, 3] - centre[0])
    assert turned == pytest.approx(1.2)
    np.testing.assert_allclose(X[-1, :3, :3], rotation_z(1.2) @ forward(STANFORD, q)[:3, :3], atol=1e-12)


def test_a_negative_angle_turns_clockwise() -> None:
    q = at(26, 38, 4.5)
    X = forward(STANFORD, arc(STANFORD, q, np.array([25, 38]) * INCH, -0.5, 0.5).q)
    np.testing.assert_allclose(X[-1, :3, :3], rotation_z(-0.5) @ forward(STANFORD, q)[:3, :3], atol=1e-12)


def test_a_turn_beyond_the_hand_roll_is_refused() -> None:
    result = arc(STANFORD, at(26, 38, 4.5), np.array([25, 38]) * INCH, 6.0, 0.5)
    assert isinstance(result.reason, JointLimit)
    assert result.reason.joint == 5


def test_a_line_through_a_straight_wrist_is_refused() -> None:
    q = np.array([0.0, np.pi / 2, 0.6, 0.0, 0.001, 0.0])
    assert straight(STANFORD, q, np.array([0.05, 0, 0]), INCH).reason == InLine((3, 5))
