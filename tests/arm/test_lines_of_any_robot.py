"""Straight motions, arcs and turns on the spot of robots that are built otherwise than the Stanford arm."""

import numpy as np
import pytest
from robots import CARTESIAN, GANTRY, PLANAR, ROBOTS

from handeye.arm.ik import IKResult, solve
from handeye.arm.kinematics import forward
from handeye.arm.line import arc, jog, pivot, straight
from handeye.arm.model import ArmModel
from handeye.arm.samples import Samples
from handeye.core.pose import hand, rotation, rotation_z
from handeye.core.units import INCH
from handeye.program.diagnosis.reach import FixedDirection, FixedOrientation, HeldJoint, InLine, TooFast

ANY = pytest.mark.parametrize("arm", [robot.arm for robot in ROBOTS.values()], ids=list(ROBOTS))


def at(arm: ArmModel, x: float, z: float, tilt: float = 0.0, roll: float = 0.0) -> np.ndarray:
    """A configuration with the hand over y = .95 m; inches and radians."""
    near = arm.middle
    if arm is GANTRY:
        near[4] = roll
    q = solve(arm, hand(x * INCH, 0.95, z * INCH, np.pi / 2, np.pi / 2 - tilt, 0.0), near).q
    assert q is not None
    return q


def made(samples: Samples | IKResult) -> Samples:
    assert isinstance(samples, Samples), samples
    return samples


def smooth(arm: ArmModel, samples: Samples) -> None:
    """Rates and accelerations are the derivatives of the positions."""
    for f, derivative in ((samples.q, samples.qd), (samples.qd, samples.qdd)):
        central = (f[2:] - f[:-2]) / (2 * arm.servo.period)
        np.testing.assert_allclose(derivative[1:-1], central, atol=0.02 * np.abs(derivative).max() + 1e-9)


@ANY
def test_a_line_is_straight_and_keeps_the_orientation(arm: ArmModel) -> None:
    q, way = at(arm, 25, 4), np.array([3.0, 0.0, 1.0]) * INCH
    samples = made(straight(arm, q, way, INCH, ramp=1.0))
    X0, X = forward(arm, q), forward(arm, samples.q)
    u = way / np.linalg.norm(way)
    gone = X[:, :3, 3] - X0[:3, 3]
    np.testing.assert_allclose(gone, (gone @ u)[:, None] * u, atol=1e-12)
    np.testing.assert_allclose(gone[-1], way, atol=1e-12)
    np.testing.assert_allclose(X[:, :3, :3], np.tile(X0[:3, :3], (len(X), 1, 1)), atol=1e-12)
    smooth(arm, samples)


@pytest.mark.parametrize("roll", [0.0, -0.7])
def test_a_gantry_turns_its_hand_about_the_vertical_with_both_rolls_in_line(roll: float) -> None:
    q, centre = at(GANTRY, 25, 4, roll=roll), np.array([24 * INCH, 0.95])
    samples = made(arc(GANTRY, q, centre, 1.0, 0.5, ramp=1.0))
    X0, X = forward(GANTRY, q), forward(GANTRY, samples.q)
    np.testing.assert_allclose(np.hypot(*(X[:, :2, 3] - centre).T), INCH, atol=1e-9)
    np.testing.assert_allclose(X[-1, :3, :3], rotation_z(1.0) @ X0[:3, :3], atol=1e-9)
    np.testing.assert_allclose(samples.q[:, 4], q[4])
    smooth(GANTRY, samples)


def test_a_tilted_gantry_turns_on_the_spot() -> None:
    q, turn = at(GANTRY, 25, 4, tilt=0.5), np.array([0.1, -0.2, 0.3])
    samples = made(pivot(GANTRY, q, turn, 0.5, ramp=1.0))
    X0, X = forward(GANTRY, q), forward(GANTRY, samples.q)
    np.testing.assert_allclose(X[:, :3, 3], np.tile(X0[:3, 3], (len(X), 1)), atol=1e-12)
    np.testing.assert_allclose(X[-1, :3, :3], rotation(turn) @ X0[:3, :3], atol=1e-12)
    smooth(GANTRY, samples)


@pytest.mark.parametrize("angle", [0.4, 1.0])
def test_a_turn_through_the_line_of_both_rolls_is_refused(angle: float) -> None:
    """From a tilt of .2 rad to one side through the vertical to the other: the first roll would have to turn over."""
    q = at(GANTRY, 25, 4, tilt=0.2)
    across = forward(GANTRY, q)[:3, :3] @ np.array([0.0, 1.0, 0.0])
    found = [pivot(GANTRY, q, sign * angle * across, 0.5) for sign in (1.0, -1.0)]
    refused = [each for each in found if isinstance(each, IKResult)]
    assert [each.reason for each in refused] in ([InLine((4, 6))], [InLine((4, 6))] * 2)
    assert refused[0].message(GANTRY) == (
        "the axes of joints 5 and 7 line up on the way, and there the hand cannot keep its angles"
    )


def test_a_gantry_that_hangs_straight_tilts_only_where_its_first_roll_lets_it() -> None:
    along = forward(GANTRY, at(GANTRY, 25, 4))[:3, 1]
    reasons = []
    for roll in np.linspace(-1.5, 1.5, 7):
        found = pivot(GANTRY, at(GANTRY, 25, 4, roll=roll), 0.3 * along, 0.5)
        reasons.append(found.reason if isinstance(found, IKResult) else None)
    assert InLine((4, 6)) in reasons


def test_a_rail_stays_where_it_stands_during_a_straight_motion() -> None:
    q = at(GANTRY, 25, 4)
    q[0] = 0.31
    samples = made(straight(GANTRY, q, np.array([0.05, 0.0, 0.0]), INCH))
    np.testing.assert_array_equal(samples.q[:, 0], 0.31)
    np.testing.assert_array_equal(samples.qd[:, 0], 0.0)


def test_a_rail_that_is_held_is_not_jogged() -> None:
    found = jog(GANTRY, at(GANTRY, 25, 4), 0, 0.5, speed=0.4)
    assert isinstance(found, IKResult)
    assert found.reason == HeldJoint(0, 0.25)
    assert found.message(GANTRY) == "joint 1 (rail) is held at 9.8 in and cannot be moved"


def test_slides_alone_refuse_to_turn_the_hand_or_to_leave_their_plane() -> None:
    turned = arc(CARTESIAN, at(CARTESIAN, 25, 4), np.array([0.6, 0.9]), 1.0, 0.5)
    assert isinstance(turned, IKResult)
    assert isinstance(turned.reason, FixedOrientation)
    aside = straight(PLANAR, at(PLANAR, 25, 4), np.array([0.0, 0.05, 0.0]), INCH)
    assert isinstance(aside, IKResult)
    assert isinstance(aside.reason, FixedDirection)
    assert aside.reason.joints == (0, 1)


def test_a_slide_that_would_have_to_be_too_fast_is_named() -> None:
    found = straight(CARTESIAN, at(CARTESIAN, 10, 4), np.array([0.8, 0.0, 0.0]), 2.0)
    assert isinstance(found, IKResult)
    assert isinstance(found.reason, TooFast)
    assert found.message(CARTESIAN).startswith("joint 1 (x) would have to move at")
    assert found.message(CARTESIAN).endswith("in/s; its limit is 39 in/s")


def test_rolls_in_line_share_what_one_of_them_cannot_do() -> None:
    X = forward(GANTRY, at(GANTRY, 25, 4))
    near = GANTRY.middle
    near[4] = 1.5  # as it was, the last would have to turn by 176 degrees
    q = solve(GANTRY, X, near).q
    assert q is not None
    assert abs(q[6]) == pytest.approx(GANTRY.upper[6])
    np.testing.assert_allclose(forward(GANTRY, q), X, atol=1e-9)
