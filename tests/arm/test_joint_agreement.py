"""Two sensors of a joint agree as far as anybody can know how it went from one reading to the next."""

from math import radians

import numpy as np

from handeye.arm.joint_agreement import Disagreement, JointAgreement
from handeye.arm.robots.stanford import STANFORD

ROLL = 5
REST = np.zeros(len(STANFORD.joints))


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
