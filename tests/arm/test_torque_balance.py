"""Each motion through free air tells the arm more of its weight, until a drive that gives another torque stands out."""

import numpy as np
import pytest

from handeye.arm.converters import rate_step
from handeye.arm.dynamics import gravity, link_weights
from handeye.arm.exertion import Exertion
from handeye.arm.robots.stanford import STANFORD
from handeye.arm.torque_balance import Unbalanced, balanced
from handeye.arm.weighing import mass_factors, weighed
from handeye.core.pose import Array
from handeye.tasks.stanford_cell.dimensions import PARK

FRICTION = np.array(STANFORD.compliance.friction)
HEAVIER = weighed(STANFORD, (1.0, 0.97, 1.05, 0.96, 1.02, 1.06))
KNOWN = weighed(
    STANFORD, tuple(mass_factors(STANFORD, PARK, gravity(HEAVIER, PARK) - gravity(STANFORD, PARK)).tolist())
)
"""The arm as it believes to be when it has weighed itself."""
UP = np.array([0.5, 0.3, 0.15, 0.4, 0.2, 0.0])  # to where the boom bears more
OUT = np.array([0.5, -0.3, 0.35, 0.4, 0.2, 0.0])  # over the table, the boom farther out


def motion(
    belief: Array | None, gain: Array, share: float, way: Array = OUT
) -> tuple[Array, Unbalanced | None]:
    """A slow motion outwards from where the arm is parked, by drives that give a multiple of their torque."""
    rate = 8 * rate_step(STANFORD)
    postures = [PARK + ahead * way for ahead in np.linspace(share - 0.5, share, 12)]
    taken = [
        Exertion(q, (gravity(HEAVIER, q) + FRICTION) / gain - gravity(KNOWN, q), np.zeros(6), rate)
        for q in postures
    ]
    return balanced(KNOWN, taken, FRICTION, belief, np.zeros(6))


def only(joint: int, gain: float) -> Array:
    found = np.ones(6)
    found[joint] = gain
    return found


@pytest.mark.parametrize(
    ("joint", "gain", "way"), [(1, 1.3, OUT), (1, 0.85, OUT), (2, 1.4, UP), (2, 0.7, UP)]
)
def test_a_drive_that_gives_another_torque_is_named_with_its_factor(
    joint: int, gain: float, way: Array
) -> None:
    belief, found = motion(None, np.ones(6), 0.5, way)
    assert found is None
    _, found = motion(belief, only(joint, gain), 1.0, way)
    assert found is not None
    assert found.joints == (joint,)
    assert found.factors[0] == pytest.approx(gain, rel=0.06)


def test_an_arm_that_is_not_as_modelled_is_on_balance_and_known_better_each_time() -> None:
    belief, widths = None, []
    for share in (0.3, 0.6, 0.9, 1.2):
        belief, found = motion(belief, np.ones(6), share)
        assert found is None
        widths.append(np.trace(belief[:, 1:]))
    assert widths == sorted(widths, reverse=True)


def test_a_motion_that_is_off_balance_is_not_learnt_from() -> None:
    belief, _ = motion(None, np.ones(6), 0.5)
    after, found = motion(belief, only(1, 1.3), 1.0)
    assert found is not None
    assert after is belief


def test_the_weights_of_links_add_up_to_gravity() -> None:
    weights, _ = link_weights(STANFORD, PARK)
    assert weights.sum(axis=0) == pytest.approx(gravity(STANFORD, PARK))
