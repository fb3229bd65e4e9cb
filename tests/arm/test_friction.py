"""What the hand feels of the friction of the joints."""

import numpy as np
import pytest
from robots import ROBOTS, Robot

from handeye.arm.computed_torque import external_wrench
from handeye.arm.friction import MARGIN, faint, felt_friction
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


def reach(arm: ArmModel, vector: np.ndarray) -> float:
    """How far friction is felt along a vector at most, N."""
    felt = felt_friction(arm, posture(arm), np.array(arm.compliance.friction))
    most = faint(felt, HandLoad(tuple(vector * 1e-9), turning=False))
    assert most is not None
    return most


def test_no_torques_within_friction_are_felt_as_more_and_some_as_as_much(arm: ArmModel) -> None:
    friction, up = np.array(arm.compliance.friction), np.array([0.0, 0.0, 1.0])
    J, most = jacobian(arm, posture(arm)), reach(arm, up)
    corners = np.array(np.meshgrid(*[[-1, 0, 1]] * len(friction))).reshape(len(friction), -1)
    felt = [up @ external_wrench(J, friction * corner)[:3] for corner in corners.T]
    assert max(felt) == pytest.approx(most)


def test_a_force_of_three_times_as_much_is_clear_of_friction(arm: ArmModel) -> None:
    down = np.array([0.0, 0.0, -1.0])
    felt = felt_friction(arm, posture(arm), np.array(arm.compliance.friction))
    clear = MARGIN * reach(arm, down)
    assert faint(felt, HandLoad((0.0, 0.0, -clear * 1.001), turning=False)) is None
    assert faint(felt, HandLoad((0.0, 0.0, -clear * 0.999), turning=False)) is not None
