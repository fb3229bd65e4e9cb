import numpy as np
import pytest

from handeye.arm.ik import IKResult, solve
from handeye.arm.kinematics import forward, jacobian
from handeye.arm.model import constants
from handeye.arm.robots.stanford import STANFORD
from handeye.arm.samples import check_samples
from handeye.arm.trajectory import Trajectory, four_three_four, move
from handeye.core.pose import hand
from handeye.core.units import DEGREE, INCH, JIFFY
from handeye.program.diagnosis.reach import BelowTable, InnerCylinder, OutOfReach

PARK = np.array([-19.7 * DEGREE, 104 * DEGREE, 17.5 * INCH, 0, 76 * DEGREE, 70.3 * DEGREE])
STATIONS = [
    (20, 28, 8, 90), (23.375, 38, 1.25, 180), (15, 35, 3, 90), (15, 46, 1.5, 180),
    (32.5, 46, 2.2, 90), (6, 33, 7, 90), (6, 41, 8.5, 90), (24, 36.8, 4.25, 90),
]  # fmt: skip


def at(x: float, y: float, z: float, yaw: float = 90.0) -> np.ndarray:
    return hand(x * INCH, y * INCH, z * INCH, yaw * DEGREE, np.pi / 2, 0)


def joints(*station: float) -> np.ndarray:
    q = solve(STANFORD, at(*station), PARK).q
    assert q is not None
    return q


def moves() -> list[Trajectory]:
    found = [move(STANFORD, joints(*a), at(*b)) for a in STATIONS for b in STATIONS if a != b]
    assert not any(isinstance(x, IKResult) for x in found)
    return found


def example() -> Trajectory:
    one = np.ones(6)
    return four_three_four(np.array([0 * one, 5 * one, 40 * one, 45 * one]), np.array([0.5, 1.0, 0.5]))


@pytest.mark.row(36)
def test_the_worked_example_has_the_listed_coefficients() -> None:
    listed = [[0, 0, 0, 60, -40], [5, 25, 30, -20, 0], [40, 25, -30, -20, 40]]
    np.testing.assert_allclose(example().coefficients[:, :, 0], listed, atol=1e-6)


def test_the_worked_example_neither_overshoots_nor_turns_back() -> None:
    samples = example().at(np.linspace(0, 2, 2001))
    assert samples.qd.min() > -1e-9
    assert samples.qd.max() == pytest.approx(40, abs=1e-6)
    assert np.abs(samples.qdd).max() == pytest.approx(67.5, abs=1e-3)


def test_the_lift_off_takes_the_time_of_the_first_segment() -> None:
    assert example().lift_off(JIFFY) == 30


def test_a_trajectory_is_smooth_to_the_second_derivative_at_its_knots() -> None:
    trajectory = moves()[0]
    ends = np.cumsum(trajectory.times)[:2]
    before, after = trajectory.at(ends - 1e-9), trajectory.at(ends + 1e-9)
    for a, b in zip((before.q, before.qd, before.qdd), (after.q, after.qd, after.qdd), strict=True):
        np.testing.assert_allclose(a, b, atol=1e-6)


def led(count: int) -> Trajectory:
    """A motion by way of so many places high over other stations."""
    over = [joints(x, y, z + 6, yaw) for x, y, z, yaw in STATIONS[2 : 2 + count]]
    found = move(STANFORD, joints(*STATIONS[0]), at(*STATIONS[1]), via=over, speed=0.4)
    assert isinstance(found, Trajectory)
    return found


@pytest.mark.parametrize("count", [1, 2, 4])
def test_a_motion_by_way_of_places_is_smooth_to_the_second_derivative_throughout(count: int) -> None:
    trajectory = led(count)
    assert len(trajectory.times) == 3 + count
    ends = np.cumsum(trajectory.times)[:-1]
    before, after = trajectory.at(ends - 1e-9), trajectory.at(ends + 1e-9)
    for a, b in zip((before.q, before.qd, before.qdd), (after.q, after.qd, after.qdd), strict=True):
        np.testing.assert_allclose(a, b, atol=1e-6)


@pytest.mark.parametrize("count", [1, 2, 4])
def test_a_motion_passes_the_places_on_its_way_and_does_not_stop_there(count: int) -> None:
    trajectory = led(count)
    passed = trajectory.at(np.cumsum(trajectory.times)[1:-2])
    for n, (x, y, z, yaw) in enumerate(STATIONS[2 : 2 + count]):
        np.testing.assert_allclose(forward(STANFORD, passed.q[n]), at(x, y, z + 6, yaw), atol=1e-9)
    speed = [
        np.linalg.norm((jacobian(STANFORD, q) @ qd)[:3]) for q, qd in zip(passed.q, passed.qd, strict=True)
    ]
    assert min(speed) > 0.5 * INCH


def test_a_motion_by_way_of_places_keeps_the_limits_and_takes_whole_periods() -> None:
    trajectory, k = led(3), constants(STANFORD)
    samples = trajectory.at(np.linspace(0, trajectory.duration, 1000))
    peak = max((np.abs(samples.qd) / k.speed).max(), (np.abs(samples.qdd) / k.acceleration).max() ** 0.5)
    assert 0.9 * 0.4 < peak < 1.002 * 0.4
    assert trajectory.duration / JIFFY == pytest.approx(len(trajectory.sample(JIFFY)), abs=1e-6)


def test_a_motion_by_way_of_places_makes_no_long_detour() -> None:
    p, knots = (forward(STANFORD, q)[:, :3, 3] for q in (led(4).sample(JIFFY).q, led(4).knots))
    way, straight = (np.linalg.norm(np.diff(points, axis=0), axis=1).sum() for points in (p, knots))
    assert way < 1.2 * straight


def test_a_trajectory_passes_its_knots_and_ends_at_rest_at_the_last() -> None:
    trajectory = moves()[0]
    at_knots = trajectory.at(np.array([0.0, *np.cumsum(trajectory.times)]))
    np.testing.assert_allclose(at_knots.q, trajectory.knots, atol=1e-9)
    samples = trajectory.sample(JIFFY)
    assert (samples.q[-1] == trajectory.knots[-1]).all()
    assert not samples.qd[-1].any()
    assert not samples.qdd[-1].any()


def test_moves_keep_speed_and_acceleration_limits_and_come_near_one() -> None:
    k = constants(STANFORD)
    for trajectory in moves():
        samples = trajectory.at(np.linspace(0, trajectory.duration, 1000))
        speed, acceleration = np.abs(samples.qd) / k.speed, np.abs(samples.qdd) / k.acceleration
        assert 0.9 < max(speed.max(), acceleration.max()) < 1.002


def test_moves_take_whole_servo_periods() -> None:
    for trajectory in moves():
        ticks = trajectory.duration / JIFFY
        assert ticks == pytest.approx(round(ticks), abs=1e-6)
        assert len(trajectory.sample(JIFFY)) == round(ticks)


def test_half_the_speed_takes_twice_as_long() -> None:
    fast, slow = (move(STANFORD, PARK, at(15, 35, 3), speed=f) for f in (1.0, 0.5))
    assert slow.duration == pytest.approx(2 * fast.duration, abs=2 * JIFFY)


def test_a_hand_that_points_down_never_tilts() -> None:
    for trajectory in moves():
        X = forward(STANFORD, trajectory.sample(JIFFY).q)
        np.testing.assert_allclose(X[:, 2, 2], -1, atol=1e-12)


@pytest.mark.row(45)
def test_a_move_rises_first_and_comes_down_from_above() -> None:
    for trajectory in moves():
        p = forward(STANFORD, trajectory.at(np.linspace(0, trajectory.duration, 200)).q)[:, :3, 3]
        low = p[:, 2] < max(p[0, 2], p[-1, 2]) + INCH
        away = np.minimum(np.hypot(*(p - p[0])[:, :2].T), np.hypot(*(p - p[-1])[:, :2].T))
        assert p[:, 2].min() > min(p[0, 2], p[-1, 2]) - 1e-4
        assert away[low & (p[:, 2] < min(p[0, 2], p[-1, 2]) + INCH)].max(initial=0) < 0.6 * INCH


def test_a_direct_move_does_not_rise() -> None:
    trajectory = move(STANFORD, joints(22, 38, 2), at(24, 38, 2), departure=0, approach=0)
    heights = forward(STANFORD, trajectory.sample(JIFFY).q)[:, 2, 3]
    assert np.ptp(heights) < 0.05 * INCH


def test_a_direct_move_has_its_knots_a_ninth_of_the_way_from_its_ends() -> None:
    knots = move(STANFORD, PARK, at(24, 38, 2), departure=0, approach=0).knots
    np.testing.assert_allclose(knots[1] - knots[0], (knots[3] - knots[0]) / 9)
    np.testing.assert_allclose(knots[3] - knots[2], (knots[3] - knots[0]) / 9)


def test_a_departure_out_of_reach_is_lowered() -> None:
    lifted = move(STANFORD, joints(20, 24, 15), at(20, 35, 5)).knots[1]
    assert 1 < forward(STANFORD, lifted)[2, 3] / INCH - 15 < 2


def test_a_move_to_where_the_hand_is_goes_nowhere_if_direct() -> None:
    trajectory = move(STANFORD, PARK, forward(STANFORD, PARK), departure=0, approach=0)
    np.testing.assert_allclose(
        trajectory.sample(JIFFY).q, np.tile(PARK, (len(trajectory.sample(JIFFY)), 1)), atol=1e-9
    )


def test_a_goal_below_the_table_is_rejected() -> None:
    result = move(STANFORD, PARK, at(24, 38, -0.5))
    assert result.message(STANFORD) == "the hand would be 0.50 in below the table"


def test_a_goal_out_of_reach_is_rejected_with_the_reason() -> None:
    assert isinstance(move(STANFORD, PARK, at(20, 66, 3)).reason, OutOfReach)
    assert isinstance(move(STANFORD, PARK, at(20, 15, 8)).reason, InnerCylinder)


def test_set_points_beyond_a_limit_are_found() -> None:
    samples = move(STANFORD, PARK, at(24, 38, 2)).sample(JIFFY)
    assert check_samples(STANFORD, samples, floor=0.0) is None
    assert isinstance(check_samples(STANFORD, samples, floor=3 * INCH).reason, BelowTable)
    samples.q[5, 2] = 51 * INCH
    assert check_samples(STANFORD, samples).message(STANFORD) == (
        "joint 3 (boom) would have to be at 51.0 in; its limit is 50.0 in"
    )


def test_a_free_motion_leaves_and_comes_from_three_inches_up() -> None:
    knots = move(STANFORD, PARK, at(24, 38, 2)).knots
    first, lifted, over, last = forward(STANFORD, knots)[:, :3, 3]
    np.testing.assert_allclose([lifted - first, over - last], [(0, 0, 3 * INCH)] * 2, atol=1e-9)
