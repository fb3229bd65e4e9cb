"""The worlds drawn from seeds, and whether their errors are as large as they say."""

from functools import cache

import numpy as np
import pytest

from handeye.arm.kinematics import forward, solve
from handeye.arm.stanford import STANFORD
from handeye.pose import Array, hand
from handeye.tasks.water_pump.variation import BELT_X, BELT_Y, World
from handeye.units import DEGREE, INCH

NEAR = np.array([-25.0, 105.0, 0.0, 0.0, 75.0, 20.0]) * DEGREE + np.array([0, 0, 31 * INCH, 0, 0, 0])


@cache
def work_area() -> Array:
    """Joint positions with the hand pointing down at places all over the work area, shape (n, 6)."""
    places = [(x, y, z) for x in (8, 16, 24, 32, 40, 46) for y in (28, 34, 40, 46) for z in (1, 4, 8)]
    found = (
        solve(STANFORD, hand(x * INCH, y * INCH, z * INCH, np.pi / 2, np.pi / 2, 0.0), NEAR)
        for x, y, z in places
    )
    return np.array([result.q for result in found if result.q is not None])


@cache
def hand_errors(worlds: int = 150) -> Array:
    """Distance between where the controller thinks the hand is and where it is, in, shape (worlds, n)."""
    q = work_area()
    true = forward(STANFORD, q)[:, :3, 3]
    readings = [World.sample(seed).arm.readings(q) for seed in range(worlds)]
    return np.array([np.linalg.norm(forward(STANFORD, r)[:, :3, 3] - true, axis=1) for r in readings]) / INCH


def test_the_hand_is_wrong_by_a_sixteenth_of_an_inch_in_the_median() -> None:
    assert np.median(hand_errors()) == pytest.approx(0.060, abs=0.010)


def test_ninety_five_percent_of_hand_errors_stay_under_an_eighth() -> None:
    assert 0.09 < np.percentile(hand_errors(), 95) < 0.125


def test_equal_seeds_give_equal_worlds() -> None:
    assert repr(World.sample(7)) == repr(World.sample(7))


def test_different_seeds_give_different_worlds() -> None:
    assert World.sample(7).base != World.sample(8).base


def test_readings_and_positions_are_inverse() -> None:
    arm, q = World.sample(3).arm, work_area()
    assert np.abs(arm.positions(arm.readings(q)) - q).max() < 1e-12


def test_the_nominal_world_reads_true() -> None:
    q = work_area()
    assert np.array_equal(World.nominal().arm.readings(q), q)


def test_every_base_lies_within_the_pick_up_area() -> None:
    bases = [World.sample(seed).base for seed in range(100)]
    assert all(
        BELT_X[0] <= base.x / INCH <= BELT_X[1] and BELT_Y[0] <= base.y / INCH <= BELT_Y[1] for base in bases
    )
    assert all(abs(base.yaw - np.pi / 2) <= 30 * DEGREE for base in bases)


def test_noise_streams_of_a_world_are_independent() -> None:
    world = World.sample(1)
    assert world.generator(1).random() != world.generator(2).random()
