"""Calibration of the camera tells how far it is."""

from dataclasses import replace

import numpy as np
import pytest
from fakes import FakeCell

from handeye.execution.camera_calibration import CalibrationFailed, calibrate_camera
from handeye.ports.camera import COLUMNS, ROWS
from handeye.tasks import task
from handeye.tasks.interface import Eye
from handeye.tasks.water_pump.park import PARK
from handeye.variation import WorldSpec

OUT_OF_REACH = (9.0, 9.0, 9.0)


@pytest.mark.slow
def test_every_view_is_told_of_with_its_number_whether_the_lamp_is_seen_or_not() -> None:
    pump, told = task(), list[tuple[int, int]]()
    assert isinstance(pump.eye, Eye)
    cell = pump.cell(WorldSpec(seed=0), "ray").devices
    looks = [replace(pump.eye.looks[0], places=(OUT_OF_REACH,) * count) for count in (2, 1)]
    with pytest.raises(CalibrationFailed, match=r"^the lamp was seen 0 times with the 25 mm lens"):
        calibrate_camera(cell, pump.arm, pump.eye.drawing, looks, viewed=lambda *view: told.append(view))
    assert told == [(1, 3), (2, 3), (3, 3)]


def test_a_camera_whose_picture_does_not_change_is_told_of() -> None:
    pump, cell = task(), FakeCell(np.array(PARK))
    assert isinstance(pump.eye, Eye)
    cell.camera.pictures = [np.zeros((ROWS, COLUMNS), np.uint8)] * 2
    with pytest.raises(
        CalibrationFailed, match=r"^the camera gives the same picture again, with the lamp lit as"
    ):
        calibrate_camera(cell.devices, pump.arm, pump.eye.drawing, pump.eye.looks)
