"""Brakes are set whenever they are asked for, however long a servo period is."""

from dataclasses import replace

import numpy as np
import pytest
from fakes import FakeCell

from handeye.arm.dynamics import gravity
from handeye.arm.robots.stanford import STANFORD
from handeye.execution.drive import ArmDrive
from handeye.execution.state import DriveState
from handeye.tasks.stanford_cell.dimensions import PARK


@pytest.mark.parametrize(
    ("seconds", "period", "passes"), [(0.1, 1 / 60, 0.1), (0.1, 0.5, 0.5), (0.0, 1 / 60, 0.0)]
)
def test_braking_takes_a_whole_period_at_least_and_no_time_none(
    seconds: float, period: float, passes: float
) -> None:
    cell, arm = FakeCell(PARK), replace(STANFORD, servo=replace(STANFORD.servo, period=period))
    cell.devices.arm.drive(gravity(STANFORD, PARK))
    cell.clock.advance(1 / 60)
    drive = ArmDrive(cell=cell.devices, arm=arm, state=DriveState.holding(cell.devices.sense(), arm))
    drive.brake(seconds)
    assert drive.sensed.braked == (seconds > 0)
    assert cell.clock.now - 1 / 60 == pytest.approx(passes)
    np.testing.assert_array_equal(drive.state.q, drive.sensed.q)
