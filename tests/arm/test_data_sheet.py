"""The Stanford arm is as fast, and opens its hand as wide and as fast, as the data sheet of 1974 says."""

import numpy as np
import pytest

from handeye.arm.robots.stanford import STANFORD
from handeye.core.units import DEGREE

FREE = (3.0, 1.5, 1.0, 6.0, 6.0, 6.0)
"""Speeds without a load: rad/s, the boom's m/s."""


def test_the_joints_go_at_their_speeds_without_a_load() -> None:
    assert tuple(joint.speed for joint in STANFORD.joints) == FREE


def test_the_wrist_bends_through_220_degrees() -> None:
    assert np.ptp([STANFORD.lower[4], STANFORD.upper[4]]) == pytest.approx(220 * DEGREE)


def test_the_hand_opens_105_millimetres_wide_at_8_centimetres_a_second() -> None:
    assert (STANFORD.hand.gap_max, STANFORD.hand.gap_speed) == (0.105, 0.08)
