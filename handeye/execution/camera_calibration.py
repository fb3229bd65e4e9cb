"""Camera-arm calibration by observation: the arm carries its lamp through the camera's view.

Done once when the camera is set up, before pumps are made: its time is not in the table of 1973. What the
arm believes of its own place enters here, and the same arm grasps later, so what is common to both cancels.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.arm.ik import IKResult
from handeye.arm.kinematics import forward
from handeye.arm.model import ArmModel
from handeye.arm.trajectory import Trajectory, move
from handeye.errors import HandeyeError
from handeye.execution.drive import ArmDrive
from handeye.execution.state import DriveState
from handeye.ports.camera import CLOSE_UP, WIDE
from handeye.ports.workcell import Workcell
from handeye.pose import hand
from handeye.units import DEGREE, INCH
from handeye.vision.calibration import Calibration, Sighting, calibrate
from handeye.vision.camera import CameraModel
from handeye.vision.spot import find_spot

LAMP: Final = np.array([-0.045, 0.062, -0.088])
"""Where the lamp is on the hand, in T, m; from the drawing of the hand."""
HAND_ANGLE: Final = 135 * DEGREE
"""O of the hand while it shows its lamp to the camera."""
FEWEST: Final = 8
"""Sightings with each lens below which the set-up is called a failure."""


class CalibrationFailed(HandeyeError):
    """The lamp was not seen often enough."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Look:
    """A camera setting and the places (x, y, z in W, inches) the lamp is shown at."""

    lens: float
    at: tuple[float, float, float]
    sharp: tuple[float, float, float]
    """Where the focus is set; one for neighbouring looks, since refocusing takes three times as long as aiming."""
    places: tuple[tuple[float, float, float], ...]


def _looks(lens: float, x: float, y: float, dx: float, dy: float, heights: tuple[float, ...]) -> list[_Look]:
    """A look at each of six places on a grid about (x, y), with the lamp shown left and right, high and low.

    The camera is aimed anew for each look, because the reading of its pan and tilt has an error of its own
    each time; the heights are mixed, because places of one height would not tell height from depth.
    """
    looks = []
    for k in range(6):
        cx, cy = x + dx * (k % 3 - 1), y + dy * (k // 3 - 0.5)
        low, high = heights[k % len(heights)], heights[(k + 2) % len(heights)]
        places = ((cx - dx / 2, cy - dy / 4, low), (cx + dx / 2, cy + dy / 4, high))
        at, sharp = (cx, cy, (low + high) / 2), (x, y, sum(heights) / len(heights))
        looks.append(_Look(lens=lens, at=at, sharp=sharp, places=places))
    return looks


LOOKS: Final = (
    *_looks(WIDE, 42.5, 29.0, 5.0, 6.0, (7.5, 10.0, 12.5)),
    *_looks(CLOSE_UP, 42.5, 29.0, 3.5, 4.0, (8.0, 12.0, 7.5, 10.0)),
    *_looks(CLOSE_UP, 28.0, 35.0, 3.0, 4.0, (6.0, 9.0, 7.5)),
)
"""Both lenses over the belt, and the close-up lens from there to the standard position too.

The fingers reach 3.5 in below the lamp, and have to stay clear of a base 2.75 in high on the belt.
"""
LAST_LENS: Final = LOOKS[-1].lens
"""The lens that calibration leaves in the turret."""


def calibrate_camera(
    cell: Workcell, arm: ArmModel, drawing: CameraModel, halt: Callable[[], bool] = lambda: False
) -> Calibration:
    """Show the lamp to the camera, and fit the camera to where the arm says the lamp was.

    `halt`: the panic button.

    Raises:
        CalibrationFailed: the lamp was seen too few times.
        Halted: the panic button was hit.
    """
    drive = ArmDrive(cell=cell, arm=arm, state=DriveState.holding(cell.sense()), halt=halt)
    home = drive.state.q.copy()
    sightings = [sighting for look in LOOKS for sighting in _sightings(drive, drawing, look)]
    for lens in {look.lens for look in LOOKS}:
        seen = sum(s.lens == lens for s in sightings)
        if seen < FEWEST:
            raise CalibrationFailed(f"the lamp was seen {seen} times with the {lens * 1000:.0f} mm lens; "
                                    f"{FEWEST} are needed to calibrate the camera")  # fmt: skip
    back = move(arm, drive.state.q, forward(arm, home), departure=3 * INCH, approach=3 * INCH, speed=1.0)
    if not isinstance(back, IKResult):
        _go(drive, back)
    return calibrate(sightings, drawing)


def _go(drive: ArmDrive, trajectory: Trajectory) -> None:
    outcome = drive.follow(trajectory.sample(drive.period))
    if outcome.error is not None:
        raise CalibrationFailed(
            f"while the camera was being calibrated, {outcome.detail or 'the drives were cut'}"
        )


def _sightings(drive: ArmDrive, drawing: CameraModel, look: _Look) -> Iterator[Sighting]:
    camera = drive.cell.camera
    assert camera is not None
    target = np.array(look.at) * INCH
    drive.brake(camera.lens(look.lens))
    drive.brake(camera.aim(*drawing.aim(target, look.lens)))
    drive.brake(camera.focus(math.dist(np.array(look.sharp) * INCH, drawing.mount)))
    R = hand(0, 0, 0, HAND_ANGLE, 90 * DEGREE, 0)[:3, :3]
    for place in look.places:
        p_T = np.array(place) * INCH - R @ LAMP
        X_WT = hand(float(p_T[0]), float(p_T[1]), float(p_T[2]), HAND_ANGLE, 90 * DEGREE, 0)
        trajectory = move(drive.arm, drive.state.q, X_WT, departure=0.0, approach=0.0, speed=1.0)
        if isinstance(trajectory, IKResult):
            continue
        _go(drive, trajectory)
        dark, seconds = camera.digitise()
        drive.state.lamp = True
        drive.brake(seconds)
        lit, seconds = camera.digitise(hold_target=True)
        drive.state.lamp = False
        drive.brake(seconds)
        spot = find_spot(dark, lit)
        if spot is None:
            continue
        X = drive.hand()
        lamp = X[:3, 3] + X[:3, :3] @ LAMP
        pan, tilt = camera.pots()
        yield Sighting(
            lens=look.lens, pan=pan, tilt=tilt, u=spot[0], v=spot[1],
            point_W=(float(lamp[0]), float(lamp[1]), float(lamp[2])),
        )  # fmt: skip
