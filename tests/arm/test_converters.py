"""Joints are known between the steps of their potentiometers, and which way they slide."""

import numpy as np
import pytest

from handeye.arm.converters import followed, position_step, rate_step, sliding
from handeye.arm.robots.stanford import STANFORD

STEP = position_step(STANFORD)
HALF = STEP / 2


def test_a_joint_that_moves_within_a_step_is_followed_by_its_tachometer() -> None:
    reading = 10 * STEP
    assert followed(STANFORD, reading, 0.4 * STEP, reading) == pytest.approx(10.4 * STEP)


def test_a_joint_is_never_believed_to_be_where_its_potentiometer_would_read_otherwise() -> None:
    reading = 10 * STEP
    assert followed(STANFORD, reading, 3 * STEP, reading) == pytest.approx(reading + HALF)
    assert followed(STANFORD, 20 * STEP, 0 * STEP, reading) == pytest.approx(reading + HALF)


def test_a_slow_sweep_is_known_to_a_tenth_of_a_step_although_it_is_read_in_whole_ones() -> None:
    true = np.outer(np.linspace(0.0, 5.0, 200), STEP)
    moved = np.diff(true, axis=0)
    here, off = true[0], []
    for now, way in zip(true[1:], moved, strict=True):
        here = followed(STANFORD, here, way, np.round(now / STEP) * STEP)
        off.append(np.abs(here - now) / STEP)
    assert np.max(off) < 0.1


def test_joints_slide_as_they_move_and_less_surely_below_a_step_of_their_tachometers() -> None:
    rate = rate_step(STANFORD) * [5, -5, 0.5, -0.5, 1, 0]
    assert sliding(STANFORD, rate) == pytest.approx([1, -1, 0.5, -0.5, 1, 0])
