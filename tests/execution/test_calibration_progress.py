"""Calibration of the camera: it tells how far it is, and goes by what the arm knows of itself."""

from dataclasses import replace

import numpy as np
import pytest
from fakes import FakeArm, FakeCamera, FakeCell

from handeye.core.errors import CalibrationFailed
from handeye.core.pose import Array
from handeye.core.variation import WorldSpec
from handeye.execution.camera_calibration import calibrate_camera
from handeye.execution.state import DriveState
from handeye.ports.camera import COLUMNS, ROWS, Picture
from handeye.tasks import task
from handeye.tasks.interface import CameraSetup
from handeye.tasks.stanford_cell.dimensions import PARK

OUT_OF_REACH = (9.0, 9.0, 9.0)


@pytest.mark.slow
def test_every_view_is_told_of_with_its_number_whether_the_lamp_is_seen_or_not() -> None:
    pump, told = task(), list[tuple[int, int]]()
    assert isinstance(pump.eye, CameraSetup)
    cell = pump.cell(WorldSpec(seed=0), "ray").devices
    drive = DriveState.holding(cell.sense(), pump.arm)
    looks = [replace(pump.eye.looks[0], places=(OUT_OF_REACH,) * count) for count in (2, 1)]
    with pytest.raises(CalibrationFailed, match=r"^the lamp was seen 0 times with the 25 mm lens"):
        calibrate_camera(
            cell, pump.arm, drive, pump.eye.drawing, looks, viewed=lambda *view: told.append(view)
        )
    assert told == [(1, 3), (2, 3), (3, 3)]


def shown(cell: FakeCell, links: float = 1.0) -> None:
    """Show the lamp to the camera with an arm that has found its links so many times as heavy as drawn."""
    pump = task()
    assert isinstance(pump.eye, CameraSetup)
    drive = DriveState.holding(cell.devices.sense(), pump.arm)
    drive.links = np.full(len(PARK), links)
    calibrate_camera(cell.devices, pump.arm, drive, pump.eye.drawing, pump.eye.looks)


def test_a_camera_whose_picture_does_not_change_is_told_of() -> None:
    cell = FakeCell(np.array(PARK))
    cell.camera.pictures = [np.zeros((ROWS, COLUMNS), np.uint8)] * 2
    with pytest.raises(CalibrationFailed, match=r"^the camera gives the same picture with the lamp on"):
        shown(cell)


class FirstPicture(Exception):
    """A picture was taken."""


class Turret(FakeCamera):
    """A camera whose turret is slow, and that raises the first time it is to take a picture."""

    def lens(self, focal_length: float) -> float:
        return 50.0

    def digitise(self, *, hold_target: bool = False) -> Picture:
        raise FirstPicture


def test_the_arm_goes_while_the_camera_turns_and_no_picture_is_taken_before_both_are_there() -> None:
    cell = FakeCell(np.array(PARK))
    cell.devices = replace(cell.devices, camera=Turret())
    with pytest.raises(FirstPicture):
        shown(cell)
    assert cell.clock.now == pytest.approx(50 + 1 + 1, abs=0.02)
    assert np.abs(cell.arm.q - PARK).max() > 0.1


class FirstTorque(Exception):
    """The arm was driven."""


class Weighbridge(FakeArm):
    """An arm that goes nowhere, and raises the torque that it is first driven with."""

    def drive(self, torque: Array | None) -> None:
        if torque is not None:
            raise FirstTorque(*torque)


def test_the_lamp_is_carried_by_links_as_heavy_as_the_arm_has_weighed_them() -> None:
    torques = []
    for links in (1.0, 2.0):
        cell = FakeCell(np.array(PARK))
        cell.arm = Weighbridge(PARK)
        cell.devices = replace(cell.devices, arm=cell.arm)
        with pytest.raises(FirstTorque) as borne:
            shown(cell, links)
        torques.append(borne.value.args)
    assert abs(torques[1][1]) > 1.5 * abs(torques[0][1])
