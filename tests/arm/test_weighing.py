"""The arm corrects the masses of its links by the torques that hold it up."""

import numpy as np
import pytest

from handeye.arm.dynamics import gravity
from handeye.arm.robots.stanford import STANFORD
from handeye.arm.weighing import mass_factors, weighed
from handeye.tasks.stanford_cell.dimensions import PARK

HEAVIER = weighed(STANFORD, (1.0, 0.97, 1.05, 0.96, 1.02, 1.06))


def test_a_weighed_arm_bears_itself_where_it_was_weighed() -> None:
    off = gravity(HEAVIER, PARK) - gravity(STANFORD, PARK)
    found = weighed(STANFORD, tuple(mass_factors(STANFORD, PARK, off).tolist()))
    left = gravity(HEAVIER, PARK) - gravity(found, PARK)
    assert np.abs(left).max() < 0.5 < np.abs(off).max()
    assert np.linalg.norm(left) < 0.4 * np.linalg.norm(off)


def test_a_weighed_arm_is_nearer_where_it_was_not_weighed() -> None:
    found = mass_factors(STANFORD, PARK, gravity(HEAVIER, PARK) - gravity(STANFORD, PARK))
    out = PARK + np.array([0.5, 0.3, 0.15, 0.0, 0.2, 0.0])
    off, left = (
        np.abs(gravity(HEAVIER, out) - gravity(arm, out))[1]
        for arm in (STANFORD, weighed(STANFORD, tuple(found.tolist())))
    )
    assert left < off


def test_an_arm_as_heavy_as_its_model_stays_so() -> None:
    assert mass_factors(STANFORD, PARK, np.zeros(6)) == pytest.approx(np.ones(6))


def test_a_torque_that_is_within_its_doubt_changes_little() -> None:
    step = np.array([0.0, 0.1, 0.0, 0.0, 0.0, 0.0])
    assert mass_factors(STANFORD, PARK, step) == pytest.approx(np.ones(6), abs=0.03)
