"""What a joint takes beyond its friction is reported of it, and what a force at the hand takes is not."""

import numpy as np
import pytest

from handeye.arm.dynamics import gravity
from handeye.arm.exertion import Exertion
from handeye.arm.joint_drag import Stiffness, alone, stiff
from handeye.arm.kinematics import jacobian
from handeye.arm.robots.stanford import STANFORD
from handeye.arm.torque_balance import balanced
from handeye.arm.weighing import weighed
from handeye.core.pose import Array
from handeye.core.units import DEGREE, INCH

AT = np.array([-20.0, 104.0, 25.0 * INCH / DEGREE, 0.0, 76.0, 70.0]) * DEGREE
FRICTION = np.array(STANFORD.compliance.friction)
SLIDES = np.full(6, 0.2)


def dragged(out: Array, back: Array) -> Stiffness | None:
    """What is concluded from torques on the way out and back, shape (n,)."""
    none = np.zeros(6)
    taken = [Exertion(none, spare, none, rate) for spare, rate in ((out, SLIDES), (back, -SLIDES))]
    return stiff(STANFORD, taken * 30, FRICTION)


def test_a_joint_that_takes_its_friction_is_not_told_whatever_weight_is_wrong() -> None:
    weight = np.array([0.0, 3.0, 5.0, 0.0, 0.2, 0.0])
    assert dragged(weight + FRICTION, weight - FRICTION) is None


@pytest.mark.parametrize("joint", range(6))
def test_a_joint_that_takes_five_times_its_friction_is_told(joint: int) -> None:
    takes = FRICTION.copy()
    takes[joint] *= 5
    told = dragged(takes, -takes)
    assert told is not None
    assert (told.joint, told.torque) == (joint, pytest.approx(5 * FRICTION[joint]))
    assert not told.one_way


def test_what_a_joint_takes_on_the_way_out_alone_may_be_a_weight() -> None:
    told = stiff(STANFORD, [Exertion(np.zeros(6), 5 * FRICTION, np.zeros(6), SLIDES)] * 30, FRICTION)
    assert told is not None
    assert told.one_way


LIGHTER = weighed(STANFORD, (0.85,) * 6)
IN = np.array([-20.0, 60.0, 8.0 * INCH / DEGREE, 0.0, 76.0, 70.0]) * DEGREE


def reached(friction: Array) -> list[Exertion]:
    """A motion of an arm that is lighter than modelled. The shoulder turns one way where the boom is drawn in, and the
    other way where it reaches out over the table.
    """
    unmodelled = [gravity(LIGHTER, q) - gravity(STANFORD, q) for q in (IN, AT)]
    return [
        Exertion(q, error + side * friction, gravity(STANFORD, q), side * SLIDES)
        for q, error, side in zip((IN, AT) * 30, unmodelled * 30, (-1, 1) * 30, strict=True)
    ]


def test_a_shoulder_that_carries_more_in_one_direction_is_not_stiff() -> None:
    assert stiff(STANFORD, reached(FRICTION), FRICTION) is None


def test_a_stiff_shoulder_is_noticed_by_an_arm_that_has_learnt_its_weight() -> None:
    belief = None
    for _ in range(20):
        belief, _ = balanced(STANFORD, reached(FRICTION), FRICTION, belief, np.zeros(6))
    takes = FRICTION * (1, 6, 1, 1, 1, 1)
    found = stiff(STANFORD, reached(takes), FRICTION, belief)
    assert found is not None
    assert found.joint == 1


@pytest.mark.parametrize("joint", [0, 2, 3, 4, 5])  # the second lifts the hand as a force upwards would
def test_a_torque_of_one_joint_is_no_force_at_the_hand(joint: int) -> None:
    spare = np.zeros(6)
    spare[joint] = 10.0
    assert alone(STANFORD, jacobian(STANFORD, AT), spare) == joint


@pytest.mark.parametrize("force", [(20.0, 0.0, 0.0), (0.0, 20.0, 0.0), (0.0, 0.0, 20.0)])
@pytest.mark.parametrize("up", [0.0, 0.1])
def test_a_force_that_meets_hand_or_fingers_is_of_no_joint_alone(
    force: tuple[float, float, float], up: float
) -> None:
    wrench = np.concatenate((force, np.cross((0.0, 0.0, up), force)))
    J = jacobian(STANFORD, AT)
    assert alone(STANFORD, J, J.T @ wrench) is None
