"""What the hand feels of the friction of the joints."""

import numpy as np
import pytest
from robots import ROBOTS, Robot

from handeye.arm.computed_torque import external_wrench
from handeye.arm.converters import rate_step, torque_step
from handeye.arm.dynamics import mass_matrix
from handeye.arm.friction import PEAK, UNKNOWN, faint, felt_friction, felt_in_air
from handeye.arm.ik import solve
from handeye.arm.kinematics import jacobian
from handeye.arm.model import ArmModel
from handeye.core.pose import hand
from handeye.program.guards import HandLoad


@pytest.fixture(scope="module", params=ROBOTS)
def arm(request: pytest.FixtureRequest) -> ArmModel:
    robot: Robot = ROBOTS[request.param]
    return robot.arm


def posture(arm: ArmModel) -> np.ndarray:
    q = solve(arm, hand(0.635, 0.95, 0.2, np.pi / 2, np.pi / 2, 0.0), arm.middle).q
    assert q is not None
    return q


def box(arm: ArmModel, vector: np.ndarray) -> float:
    """How far friction is felt along a unit vector at most, N."""
    felt = felt_friction(arm, posture(arm), np.array(arm.compliance.friction))
    return float(np.abs(vector @ felt[:3]).sum())


def test_no_torques_within_friction_are_felt_as_more_and_some_as_as_much(arm: ArmModel) -> None:
    friction, up = np.array(arm.compliance.friction), np.array([0.0, 0.0, 1.0])
    J, most = jacobian(arm, posture(arm)), box(arm, up)
    corners = np.array(np.meshgrid(*[[-1, 0, 1]] * len(friction))).reshape(len(friction), -1)
    felt = [up @ external_wrench(J, friction * corner)[:3] for corner in corners.T]
    assert max(felt) == pytest.approx(most)


def test_a_force_of_as_much_as_is_felt_in_free_air_is_clear_of_it(arm: ArmModel) -> None:
    q, friction = posture(arm), np.array(arm.compliance.friction)
    most = felt_in_air(arm, q, friction, HandLoad((0.0, 0.0, -1.0), turning=False))
    assert faint(arm, q, friction, HandLoad((0.0, 0.0, -most * 1.001), turning=False)) is None
    assert faint(arm, q, friction, HandLoad((0.0, 0.0, -most * 0.999), turning=False)) == pytest.approx(most)


def test_of_measured_friction_only_what_is_not_known_is_felt(arm: ArmModel) -> None:
    q, down = posture(arm), HandLoad((0.0, 0.0, -1.0), turning=False)
    known, none = np.array(arm.compliance.friction), np.zeros(len(arm.joints))
    more = felt_in_air(arm, q, known, down) - felt_in_air(arm, q, none, down)
    assert more == pytest.approx(UNKNOWN * box(arm, np.array([0.0, 0.0, 1.0])))


def test_steps_of_the_converters_are_felt_as_they_are_computed_from_periods_that_take_them_down() -> None:
    arm = ROBOTS["stanford"].arm
    q, draws = posture(arm), np.random.default_rng(1).uniform(-0.5, 0.5, (3, 20_000, len(arm.joints)))
    rates = (draws[0] - draws[1]) * rate_step(arm) / arm.servo.period
    unexplained = rates @ mass_matrix(arm, q).T + draws[2] * torque_step(arm)
    felt = external_wrench(jacobian(arm, q), unexplained.T)[2]
    down = HandLoad((0.0, 0.0, -1.0), turning=False)
    steady = np.abs(external_wrench(jacobian(arm, q), np.diag(torque_step(arm) / 4))[2]).sum()
    most = felt_in_air(arm, q, np.zeros(len(arm.joints)), down)
    assert most - steady == pytest.approx(PEAK * felt.std(), rel=0.03)
