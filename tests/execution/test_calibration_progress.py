"""Calibration of the camera tells how far it is."""

from dataclasses import replace

import pytest

from handeye.execution.camera_calibration import CalibrationFailed, calibrate_camera
from handeye.tasks import task
from handeye.tasks.interface import Eye
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
