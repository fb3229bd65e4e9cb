"""Two sensors of a joint agree as far as anybody can know how it went from one reading to the next."""

from math import radians

import numpy as np

from handeye.arm.converters import position_step
from handeye.arm.dynamics import at_rest
from handeye.arm.joint_agreement import Disagreement, JointAgreement, blown, jumped, scattered, thrown
from handeye.arm.robots.stanford import STANFORD

ROLL = 5
REST = np.zeros(len(STANFORD.joints))
HELD = np.array([-0.3535, 1.9529, 0.7444, 0.0014, 1.1887, -0.3535])  # the hand points down, over the table


def told(angles: list[float], rates: list[float]) -> Disagreement | None:
    """What is said of the hand roll that reads angles (rad) and rates (rad/s), a servo period apart, from rest at 0."""
    sensors = JointAgreement(arm=STANFORD, start=REST, rate=REST)
    for angle, rate in zip(angles, rates, strict=True):
        q, qd = REST.copy(), REST.copy()
        q[ROLL], qd[ROLL] = angle, rate
        said = sensors.step(q, qd)
        if said is not None:
            return said
    return None


def test_a_joint_that_is_struck_between_two_readings_is_not_doubted() -> None:
    """It swung by half a degree and back, and was read as it swung fastest: 3 degrees, to go by the rates."""
    assert told([radians(0.5), 0.0], [3.3, 0.0]) is None


def test_the_same_way_without_a_rate_between_is_doubted() -> None:
    said = told([radians(1.0), radians(2.0), radians(3.0)], [0.0, 0.0, 0.0])
    assert said is not None
    assert (said.joint, said.tachometer) == (ROLL, 0.0)


def test_a_potentiometer_that_stands_still_is_doubted_on_a_steady_way() -> None:
    """A rate that does not change leaves nothing unknown between two readings but where it began."""
    said = told([0.0] * 30, [0.5] * 30)
    assert said is not None
    assert (said.joint, said.potentiometer) == (ROLL, 0.0)


def test_sensors_that_are_compared_anew_are_not_held_to_what_was_before() -> None:
    """As where a tool chatters: 30 readings of .5 rad/s, of a joint that stands still, are forgotten."""
    sensors, rate = JointAgreement(arm=STANFORD, start=REST, rate=REST), np.eye(6)[ROLL] * 0.5
    for _ in range(30):
        sensors.begin_anew(REST, rate)
    assert sensors.step(REST, REST) is None


def test_a_potentiometer_that_reads_four_per_cent_too_far_is_doubted_on_a_motion_of_thirty_degrees() -> None:
    rates = [*np.linspace(0.0, 0.5, 31), *[0.5] * 32, *np.linspace(0.5, 0.0, 31)]
    way = np.cumsum((np.array([0.0, *rates[:-1]]) + rates) / 2) / 60
    assert told(list(way), rates) is None
    assert told(list(1.01 * way), rates) is None
    said = told(list(1.04 * way), rates)
    assert said is not None
    assert said.joint == ROLL


def test_a_reading_that_jumps_by_half_a_degree_is_doubted_in_that_servo_period() -> None:
    q, rate = REST.copy(), np.full(len(REST), 0.1)
    q[ROLL] = radians(0.5)
    said = jumped(STANFORD, q + rate / 60, rate, rate)
    assert said is not None
    assert said.joint == ROLL
    assert jumped(STANFORD, rate / 60 + 2 * position_step(STANFORD), rate, rate) is None


def test_a_joint_that_is_struck_in_a_servo_period_has_not_jumped() -> None:
    q, struck = REST.copy(), REST.copy()
    q[ROLL], struck[ROLL] = radians(0.5), 3.3
    assert jumped(STANFORD, q, REST, struck) is None


def test_a_joint_that_is_struck_once_while_the_arm_holds_still_does_not_scatter() -> None:
    M, friction = at_rest(STANFORD, HELD).M, np.array(STANFORD.compliance.friction)
    rates = np.zeros((8, len(REST)))
    rates[3:5, ROLL] = 0.5, -0.4
    assert scattered(STANFORD, M, friction, rates) is None
    rates[:, ROLL] = np.resize((0.02, -0.02), 8)
    said = scattered(STANFORD, M, friction, rates)
    assert said is not None
    assert said.joint == ROLL


def test_a_joint_may_swing_by_a_step_of_its_torque_if_its_friction_is_less_than_half_a_step() -> None:
    """Seed 947101 at the high level: the hand roll, with a friction of .0244 N m, swung by .0264 rad/s."""
    M, friction = at_rest(STANFORD, HELD).M, np.array(STANFORD.compliance.friction)
    friction[ROLL] = 0.0244
    rates = np.zeros((8, len(REST)))
    rates[:, ROLL] = np.resize((0.0264, -0.0264), 8)
    assert scattered(STANFORD, M, friction, rates) is None
    said = scattered(STANFORD, M, friction, 2 * rates)
    assert said is not None
    assert said.joint == ROLL


def test_a_blow_that_the_other_joints_show_may_have_moved_a_joint_that_reads_the_same_rate() -> None:
    """A base that breaks loose under the fingers: the hand roll moves by 6 converter steps, and stops again."""
    here, step = at_rest(STANFORD, HELD), np.zeros(len(REST))
    before = np.array([0.0015, 0.0205, 0.0, -0.0146, -0.0264, -0.041])
    after = np.array([0.0, 0.0103, 0.019, 0.0967, 0.0645, -0.0439])
    step[ROLL] = 0.0087
    torque = np.array([0.3, -23.87, -21.17, 0.06, 0.3, 0.13])
    friction = np.array([1.0, 1.26, 4.4, 0.235, 0.16, 0.084])
    rest = here.M @ (after - before) - (torque - here.bias) / 60
    blow = blown(here, rest - rest.clip(-friction / 60, friction / 60))
    assert jumped(STANFORD, step, before, after) is not None
    assert jumped(STANFORD, step, before, after, blow) is None
    said = jumped(STANFORD, radians(3.0) / 0.0087 * step, before, after, blow)
    assert said is not None
    assert said.joint == ROLL


def test_a_part_that_shifts_in_the_fingers_may_have_thrown_the_hand_and_stopped_it_again() -> None:
    """In the world of seed 970020, the fingers closed by .59 mm on a base that slid in them, and the hand roll moved by
    .7 degrees. Its rates show less than a tenth of this motion.
    """
    here, step = at_rest(STANFORD, HELD), REST.copy()
    before = np.array([-0.009, -0.013, -0.004, 0.006, 0.0, 0.05])
    after = np.array([-0.006, -0.034, -0.006, -0.062, 0.015, -0.088])
    throw = thrown(here.M, 80.0 * 0.59e-3, 1 / 60)
    step[ROLL] = radians(0.7)
    assert jumped(STANFORD, step, before, after) is not None
    assert jumped(STANFORD, step, before, after, throw=throw) is None
    said = jumped(STANFORD, radians(3.0) / radians(0.7) * step, before, after, throw=throw)
    assert said is not None
    assert said.joint == ROLL


def test_all_the_work_of_the_fingers_can_turn_one_joint_for_a_whole_servo_period_at_most() -> None:
    M = np.diag([2.0, 0.02])
    way = thrown(M, 0.04, 1 / 60)
    assert np.allclose(M.diagonal() * (60 * way) ** 2 / 2, 0.04)
    assert not thrown(M, 0.0, 1 / 60).any()


def test_a_throw_is_not_held_against_a_joint_for_the_rest_of_its_motion() -> None:
    """And it covers no second jump of the same size, which nothing explains."""
    sensors, q = JointAgreement(arm=STANFORD, start=REST, rate=REST), REST.copy()
    q[ROLL] = radians(1.2)
    assert sensors.step(q, REST, unseen=q) is None
    assert sensors.step(q, REST) is None
    assert sensors.step(2 * q, REST) is not None
