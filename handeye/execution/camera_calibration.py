"""Calibrates the camera to the arm: the arm carries its lamp through the view of the camera.

The camera is calibrated once, when it is set up, before any pump is made. The times that were published in 1973
therefore do not include the calibration. The position of the hand is measured by the sensors of the arm. The same arm
grasps the parts later, so errors common to calibration and grasping cancel.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import count
from typing import Final

import numpy as np

from handeye.arm.arithmetic import ArmArithmetic, Formulas
from handeye.arm.ik import IKResult
from handeye.arm.kinematics import forward
from handeye.arm.model import ArmModel
from handeye.arm.trajectory import Trajectory, move
from handeye.core.errors import CalibrationFailed
from handeye.core.plain_text import counted
from handeye.core.pose import hand
from handeye.core.record import Vector3
from handeye.core.units import DEGREE, INCH
from handeye.execution.drive import ArmDrive
from handeye.execution.state import DriveState
from handeye.ports.camera import DIGITISE, TvCamera
from handeye.ports.workcell import Workcell
from handeye.program.diagnosis.cause_text import error_sentence
from handeye.vision.alignment import find_spot
from handeye.vision.calibration import Calibration, CalibrationLook, Sighting, calibrate
from handeye.vision.camera_model import CameraModel
from handeye.vision.live import repeated

MIN_SIGHTINGS: Final = 8  # for each lens


def calibrate_camera(
    cell: Workcell,
    arm: ArmModel,
    state: DriveState,
    drawing: CameraModel,
    looks: Sequence[CalibrationLook],
    halt: Callable[[], bool] = lambda: False,
    viewed: Callable[[int, int], None] = lambda *_: None,
    arithmetic: Callable[[ArmModel], ArmArithmetic] = Formulas,
) -> Calibration:
    """Show the lamp to the camera, and fit the camera model to the positions of the hand.

    `state` holds the arm's measurements of itself, and `drawing` is the design of the camera. `viewed` is called with
    the number of the view and the total number of views. Raises CalibrationFailed if the lamp is seen too few times or
    the picture does not change. Raises Halted if the panic button is pressed.
    """
    drive = ArmDrive(cell=cell, arm=arm, state=state, halt=halt, arithmetic=arithmetic)
    home = drive.state.q.copy()
    numbers, views = count(1), sum(len(look.places) for look in looks)
    sightings: list[Sighting] = []
    ready = 0.0
    for look in looks:
        camera = _camera(drive)
        turning, slewing = camera.lens(look.lens), camera.aim(*drawing.aim(look.at, look.lens))
        focusing = camera.focus(math.dist(look.sharp, drawing.mount))
        ready = max(ready, cell.clock.now) + (turning + slewing + focusing)
        for place in look.places:
            viewed(next(numbers), views)
            sightings += _sightings(drive, look, place, ready)
    for lens in {look.lens for look in looks}:
        seen = sum(s.lens == lens for s in sightings)
        if seen < MIN_SIGHTINGS:
            raise CalibrationFailed(f"the lamp was seen {counted(seen, 'time')} with the {lens * 1000:.0f} mm lens; "
                                    f"{MIN_SIGHTINGS} sightings are needed to calibrate the camera")  # fmt: skip
    back = move(arm, drive.state.q, forward(arm, home), departure=3 * INCH, approach=3 * INCH, speed=1.0)
    if not isinstance(back, IKResult):
        _go(drive, back)
    return calibrate(sightings, drawing)


def _go(drive: ArmDrive, trajectory: Trajectory) -> None:
    outcome = drive.glide(trajectory.sample(drive.period))
    if outcome.error is not None:
        why = (
            "the drives were cut off"
            if outcome.cause is None
            else error_sentence(outcome.error, outcome.cause)
        )
        raise CalibrationFailed(f"while calibrating the camera, {why}")


def _camera(drive: ArmDrive) -> TvCamera:
    camera = drive.cell.camera
    assert camera is not None
    return camera


def _sightings(drive: ArmDrive, look: CalibrationLook, place: Vector3, ready: float) -> Iterator[Sighting]:
    """Hold the lamp at a place, take a picture when the camera is ready (at time `ready`, in s), and yield the
    sighting. Yields nothing if the arm cannot reach the place, or if the camera does not see the lamp.
    """
    camera = _camera(drive)
    assert drive.arm.hand.lamp is not None
    on_hand = np.array(drive.arm.hand.lamp)
    R = hand(0, 0, 0, look.hand_angle, 90 * DEGREE, 0)[:3, :3]
    p_T = np.array(place) - R @ on_hand
    X_WT = hand(float(p_T[0]), float(p_T[1]), float(p_T[2]), look.hand_angle, 90 * DEGREE, 0)
    trajectory = move(drive.arm, drive.state.q, X_WT, departure=0.0, approach=0.0, speed=1.0)
    if isinstance(trajectory, IKResult):
        return
    _go(drive, trajectory)
    drive.brake(max(0.0, ready - drive.cell.clock.now))
    dark = camera.digitise()
    drive.state.lamp = True
    drive.brake(DIGITISE)
    lit = camera.digitise(hold_target=True)
    drive.state.lamp = False
    drive.brake(DIGITISE)
    if repeated(lit, dark):
        raise CalibrationFailed("the camera gives the same picture with the lamp on and off")
    spot = find_spot(dark, lit)
    if spot is None:
        return
    X = drive.hand()
    lamp = X[:3, 3] + X[:3, :3] @ on_hand
    pan, tilt = camera.pots()
    yield Sighting(
        lens=look.lens, pan=pan, tilt=tilt, u=spot[0], v=spot[1],
        point_W=(float(lamp[0]), float(lamp[1]), float(lamp[2])),
    )  # fmt: skip
