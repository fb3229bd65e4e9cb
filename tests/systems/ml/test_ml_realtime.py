"""The real-time level on perfect motors: limits and latches, freezing, posts, goals, set-points."""

import itertools

import pytest
from level_bench import pressed, rig

from handeye.systems.ml.errors import MlError
from handeye.systems.ml.machine.surroundings import Stimulus
from handeye.systems.ml.realtime.cycle import Cycles
from handeye.systems.ml.realtime.happenings import Froze, GoalRounded, LimitCrossed, Posted
from handeye.systems.ml.realtime.sampling import outside


@pytest.mark.ml_row(9)
def test_a_motor_that_is_absent_is_refused_and_nothing_moves() -> None:
    arm = rig()
    with pytest.raises(MlError, match=r"^M09: the right arm has no motor 6$"):
        arm.right.start({2: 100, 6: 100})
    arm.pass_cycles(10)
    assert (arm.right.goal(2), arm.right.position(2)) == (0, 0)


@pytest.mark.ml_row(10)
def test_a_slide_ends_where_it_was_sent_at_no_more_than_20_cm_s() -> None:
    arm = rig()
    arm.right.start({3: 2000})
    positions = []
    while not arm.right.posted:
        arm.machine.cycle()
        positions.append(arm.right.position(3))
    steps = [there - here for here, there in itertools.pairwise(positions)]
    assert positions[-1] == 2000
    assert max(steps) <= 79
    assert sum(steps[:25]) <= 25 * 78.74 + 0.5
    assert 25 <= len(positions) <= 28  # of 10 ms
    assert arm.arms["right"].memory.q[2] == pytest.approx(0.0508)


def test_a_motion_within_the_tolerance_is_executed_to_its_end() -> None:
    arm = rig()
    assert arm.move({3: 5}) == 2
    assert arm.arms["right"].memory.q[2] == pytest.approx(5 * 25.4e-6)


def test_a_motion_ends_when_the_motors_that_lag_are_within_the_tolerance(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    arm = rig()
    motors = arm.arms["right"].memory

    def lag() -> None:
        motors.q = [q + (goal - q) / 2 for q, goal in zip(motors.q, motors.goal, strict=True)]

    monkeypatch.setattr(arm.arms["right"], "arrive", lag)
    arm.right.start({3: 1000})
    distances = []
    while not arm.right.posted:
        arm.machine.cycle()
        distances.append(1000 - arm.right.position(3))
    assert distances[-1] <= 6 < distances[-2]


@pytest.mark.ml_row(11)
def test_yaw_turns_by_hundredths_of_a_degree() -> None:
    arm = rig()
    arm.move({9: 4000})
    assert arm.arms["right"].memory.q[5] == pytest.approx(0.698131701)


@pytest.mark.ml_row(13)
@pytest.mark.parametrize(("asked", "goal"), [(330, 250), (380, 500), (-125, -250), (375, 500), (-330, -250)])
def test_the_base_stops_at_detents_and_says_that_it_rounds(asked: int, goal: int) -> None:
    arm = rig()
    arm.move({1: asked})
    assert arm.right.position(1) == goal
    assert [(event.asked, event.goal) for event in arm.seen(GoalRounded)] == [(asked, goal)]


@pytest.mark.ml_row(13)
def test_a_base_that_is_frozen_between_detents_settles_at_the_nearest() -> None:
    arm = rig(pressed(500, motor=1, beyond=800))
    arm.right.expect(5, -178, 450)
    arm.move({1: 2500})
    arm.pass_cycles(5)
    assert arm.right.position(1) == arm.right.goal(1) == 750


@pytest.mark.ml_row(14)
@pytest.mark.parametrize(("reading", "on"), [(-177, False), (449, False), (-178, True), (450, True)])
def test_a_reading_is_in_range_strictly_between_its_limits(reading: int, on: bool) -> None:
    arm = rig(pressed(reading))
    arm.right.expect(5, -178, 450)
    arm.pass_cycles(2)
    assert (arm.right.reading(5), 5 in arm.right.flags) == (reading, on)


def test_an_open_limit_is_compared_with_nothing() -> None:
    assert not outside(-32768, 0, 0, 3)
    assert not outside(32767, 5, 0, 2)
    assert outside(5, 5, 0, 2)
    assert not outside(-32768, 0, 5, 1)
    assert outside(5, 0, 5, 1)


@pytest.mark.ml_row(15)
def test_a_flag_stays_on_although_the_reading_returns() -> None:
    arm = rig(pressed(500, since=3, until=4))
    arm.right.expect(5, -178, 450)
    arm.pass_cycles(3)
    assert list(arm.right.flags) == []
    arm.pass_cycles(20)
    assert (arm.right.reading(5), list(arm.right.flags)) == (0, [5])
    assert [event.cycle for event in arm.seen(LimitCrossed)] == [3]


@pytest.mark.ml_row(16)
def test_sensor_clears_one_flag_or_all_and_opens_limits() -> None:
    arm = rig(pressed(500), Stimulus(channel="wand", value=1))
    arm.right.expect(5, -178, 450)
    arm.right.expect(1, -1, 1)
    arm.pass_cycles(1)
    assert list(arm.right.flags) == [1, 5]
    arm.right.open(5)
    arm.pass_cycles(3)
    assert list(arm.right.flags) == [1]
    arm.right.open()
    arm.pass_cycles(3)
    assert list(arm.right.flags) == []


def test_sensor_with_limits_clears_the_flag_of_that_sensor_only() -> None:
    arm = rig(pressed(500, until=1), Stimulus(channel="wand", value=1))
    arm.right.expect(5, -178, 450)
    arm.right.expect(1, -1, 1)
    arm.pass_cycles(1)
    arm.right.expect(5, -178, 450)
    assert list(arm.right.flags) == [1]


@pytest.mark.ml_row(17)
def test_rearming_while_out_of_range_sets_the_flag_within_a_cycle_and_nothing_moves() -> None:
    arm = rig(pressed(500))
    arm.right.expect(5, -178, 450)
    arm.pass_cycles(1)
    arm.right.expect(5, -178, 450)
    assert list(arm.right.flags) == []
    assert arm.move({3: 2000}) == 1
    assert [event.cycles for event in arm.seen(Posted)] == [1]
    arm.pass_cycles(50)
    assert (arm.right.position(3), arm.right.goal(3), list(arm.right.flags)) == (0, 0, [5])


@pytest.mark.ml_row(20)
def test_with_a_flag_on_a_motion_changes_no_goal_and_takes_no_time() -> None:
    arm = rig(pressed(500, until=1))
    arm.right.expect(5, -178, 450)
    arm.pass_cycles(1)
    before = arm.machine.now
    assert not arm.right.start({3: 2000})
    assert (arm.right.goal(3), arm.machine.now, arm.right.posted) == (0, before, "goal")


@pytest.mark.ml_row(21)
def test_an_event_half_way_stops_all_motors() -> None:
    arm = rig(pressed(500, motor=3, beyond=1000))
    arm.right.expect(5, -178, 450)
    arm.move({3: 2000, 9: 4000, 2: -2000})
    held = {motor: arm.right.position(motor) for motor in (2, 3, 9)}
    assert arm.arms["right"].memory.q[2] == pytest.approx(held[3] * 25.4e-6)  # already in this cycle
    arm.pass_cycles(50)
    assert {motor: arm.right.position(motor) for motor in (2, 3, 9)} == held
    assert 1000 <= held[3] <= 1079
    assert held[2] == -held[3]
    assert 1100 < held[9] < 1300
    (froze,) = arm.seen(Froze)
    assert (froze.positions[3], froze.moving) == (held[3], (2, 3, 9))


def test_a_second_sensor_that_is_crossed_later_is_recorded_too() -> None:
    arm = rig(pressed(500, since=2), Stimulus(channel="wand", value=1, since=6))
    arm.right.expect(5, -178, 450)
    arm.right.expect(1, -1, 1)
    arm.pass_cycles(10)
    assert [(event.sensor, event.cycle) for event in arm.seen(LimitCrossed)] == [(5, 2), (1, 6)]
    assert [arm.right.read("FE", line, 3) for line in (1, 2, 3)] == [1, 5, 0]


def test_force_beats_goal_in_the_same_cycle() -> None:
    arm = rig(pressed(500, motor=3, beyond=200))
    arm.right.expect(5, -178, 450)
    arm.move({3: 200})
    assert (arm.right.posted, [event.what for event in arm.seen(Posted)]) == ("force", ["force"])


@pytest.mark.ml_row(22)
def test_a_thousand_cycles_are_ten_seconds_and_each_samples_checks_and_outputs_in_this_order() -> None:
    order: list[str] = []

    class Recorded(Cycles):
        pass

    for phase in ("sample", "check_sensors", "check_goals", "output"):

        def recorded(self, phase=phase):  # type: ignore[no-untyped-def]
            order.append(phase)
            return getattr(Cycles, phase)(self)

        setattr(Recorded, phase, recorded)
    arm = rig()
    spec, axes = arm.right.spec, arm.arms["right"]
    level = Recorded(spec, axes, axes, arm.machine.memory.shared)
    level.cycle()
    assert order == ["sample", "check_sensors", "check_goals", "output"]
    arm.pass_cycles(1000)
    assert arm.machine.now == 1000
    assert axes.read().time == 10.0


@pytest.mark.ml_row(23)
def test_a_masked_count_counts_the_bits_that_are_on() -> None:
    arm = rig(
        Stimulus(channel="inside_left", value=1, since=2), Stimulus(channel="inside_right", value=1, since=4)
    )
    arm.right.expect(11, -1, 2)
    arm.pass_cycles(3)
    assert (arm.right.reading(11), list(arm.right.flags)) == (1, [])
    arm.pass_cycles(2)
    assert (arm.right.reading(11), list(arm.right.flags)) == (2, [11])


@pytest.mark.ml_row(23)
def test_bits_outside_the_mask_are_not_counted() -> None:
    arm = rig(*(Stimulus(channel=name, value=1) for name in ("inside_left", "inside_right")))
    arm.right.write("ST", 11, 3, 1)
    arm.pass_cycles(1)
    assert arm.right.reading(11) == 1


@pytest.mark.ml_row(33)
def test_position_and_goal_differ_in_motion_and_agree_at_rest() -> None:
    arm = rig()
    arm.right.start({3: 2000})
    arm.pass_cycles(5)
    assert (arm.right.goal(3), arm.right.position(3)) == (2000, round(4 * 78.74))
    arm.pass_cycles(40)
    assert arm.right.position(3) == arm.right.goal(3) == 2000


def test_a_goal_outside_the_travel_or_the_work_space_moves_nothing() -> None:
    arm = rig()
    with pytest.raises(MlError, match=r"^M10: motor 3 can go from -10039 to 10039, not to 10040$"):
        arm.right.start({2: 100, 3: 10_040})
    arm.right.write("WS", 3, 2, 500)
    with pytest.raises(MlError, match=r"^M10: motor 3 can go from -10039 to 500, not to 501$"):
        arm.right.start({2: 100, 3: 501})
    assert arm.right.goal(2) == 0


def test_motors_arrive_together_only_if_that_is_asked_for() -> None:
    def middle(coordinate: int) -> tuple[int, int]:
        arm = rig()
        arm.right.write("AR", 1, 4, coordinate)
        arm.right.start({3: 4000, 4: 1000})
        arm.pass_cycles(27)
        return arm.right.position(3), arm.right.position(4)

    assert middle(0) == (2047, 1000)
    assert middle(1) == (2039, 510)


def test_a_motion_whose_motors_do_not_come_to_their_goals_is_an_emergency() -> None:
    arm = rig()
    arm.right.write("MT", 3, 8, 0)
    arm.right.start({3: 100})
    arm.pass_cycles(1100)
    assert (arm.right.posted, arm.right.stopped) == ("emergency", "motor 3 (y) does not reach its goal")


def test_a_calibrated_sensor_has_the_mean_of_its_last_8_readings_as_zero() -> None:
    arm = rig(pressed(1000, until=4), pressed(36, since=4, until=8), pressed(40, since=8))
    arm.pass_cycles(12)
    assert arm.right.reading(5) == 40
    arm.right.calibrate([])
    arm.pass_cycles(1)
    assert (arm.right.reading(5), arm.right.read("ST", 5, 6)) == (2, 38)


def test_the_wand_can_be_any_sensor() -> None:
    arm = rig(Stimulus(channel="wand", value=1, since=2))
    arm.right.wand(12)
    arm.pass_cycles(3)
    assert list(arm.right.flags) == [12]
