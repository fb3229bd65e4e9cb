"""One joint moves, the others are held."""

import numpy as np
import pytest

from handeye.arm.ik import IKResult, solve
from handeye.arm.line import jog
from handeye.arm.robots.stanford import STANFORD
from handeye.arm.samples import Samples
from handeye.core.pose import hand
from handeye.core.units import INCH
from handeye.program.diagnosis.reach import BelowTable, OutOfReach
from handeye.tasks.stanford_cell.dimensions import PARK

PERIOD = 1 / 60


def moved(joint: int, by: float) -> Samples:
    found = jog(STANFORD, PARK, joint, PARK[joint] + by, speed=0.4)
    assert isinstance(found, Samples)
    return found


@pytest.mark.parametrize("joint", range(6))
def test_a_joint_ends_where_it_is_to_be_at_rest_and_no_other_moves(joint: int) -> None:
    samples = moved(joint, 0.1)
    assert samples.q[-1] - PARK == pytest.approx(np.eye(6)[joint] * 0.1)
    assert np.abs([samples.qd[-1], samples.qdd[-1]]).max() == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("by", [1e-4, 0.01, 0.5])
def test_a_joint_keeps_within_its_share_of_rate_and_acceleration(by: float) -> None:
    samples, joint = moved(0, by), STANFORD.joints[0]
    assert np.abs(samples.qd).max() <= 0.4 * joint.speed * 1.001
    assert np.abs(samples.qdd).max() <= 0.16 * joint.acceleration * 1.001


def test_rates_are_those_of_the_positions() -> None:
    samples = moved(2, 0.1)
    assert np.diff(samples.q[:, 2]) / PERIOD == pytest.approx(
        (samples.qd[1:, 2] + samples.qd[:-1, 2]) / 2, abs=2e-3
    )


def test_a_joint_beyond_its_limit_is_refused_with_the_limit() -> None:
    found = jog(STANFORD, PARK, 2, 3.0, speed=0.4)
    assert isinstance(found, IKResult)
    assert isinstance(found.reason, OutOfReach)
    assert found.reason.joint == 2


def test_a_joint_that_would_push_the_hand_through_the_table_is_refused() -> None:
    low = solve(STANFORD, hand(0.6, 0.9, 0.5 * INCH, np.pi / 2, np.pi / 2, 0.0), PARK).q
    assert low is not None
    found = jog(STANFORD, low, 1, low[1] + 0.1, speed=0.4)
    assert isinstance(found, IKResult)
    assert isinstance(found.reason, BelowTable)
