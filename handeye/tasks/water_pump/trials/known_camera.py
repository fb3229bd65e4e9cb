"""The program's knowledge of its camera in a trial: by its lamp, by simulated sightings, as drawn, or exact."""

from typing import Final

import numpy as np

from handeye.arm.robots.stanford import STANFORD
from handeye.cell.camera import CameraState
from handeye.core.units import INCH
from handeye.execution.camera_calibration import calibrate_camera
from handeye.execution.friction_measurement import measure_joints
from handeye.execution.state import DriveState
from handeye.ports.camera import LENSES
from handeye.tasks.trial import Known
from handeye.tasks.water_pump.cell import build_cell
from handeye.tasks.water_pump.trials.still_pump import StillPump
from handeye.tasks.water_pump.world.nominal import DRAWING, LOOKS
from handeye.vision.calibration import Calibration, Sighting, calibrate
from handeye.vision.camera_model import CameraModel

SPOTS: Final = 20  # simulated sightings with each lens
ARM_ERROR_M: Final = 0.1 * INCH  # the largest, on each axis
SPOT_NOISE_PX: Final = 0.5


def known_camera(
    still: StillPump, known: Known, renderer: str, about: tuple[float, float, float]
) -> CameraModel:
    """The camera as the program knows it; simulated sightings are about a point, W, m. Raises CalibrationFailed."""
    match known:
        case "lamp":
            return by_lamp(still, renderer).model
        case "sightings":
            return by_sightings(still, about).model
        case "drawn":
            return DRAWING
        case "true":
            return still.true_camera


def by_lamp(still: StillPump, renderer: str) -> Calibration:
    """Calibrate as runs do: in the cell of the world the arm measures itself, then carries its lamp through the view.

    The camera of the still scene goes on as that leaves it: with its lens, its aim, and the noise to come. Raises
    CalibrationFailed if the lamp was seen too few times.
    """
    cell = build_cell(still.world, camera=renderer)
    drive = DriveState.holding(cell.devices.sense(), STANFORD)
    found = measure_joints(cell.devices, STANFORD, drive)
    drive.friction, drive.links = found.friction, found.links
    calibration = calibrate_camera(cell.devices, STANFORD, drive, DRAWING, LOOKS)
    state = cell.truth.states["camera"]
    assert isinstance(state, CameraState)
    still.camera.restore(state)
    return calibration


def by_sightings(still: StillPump, about: tuple[float, float, float]) -> Calibration:
    """Calibrate as by a lamp shown at random places about a point, without rendering any: cheap, and too good.

    It knows nothing of the joints' own errors, of the lamp's place and of the raster.
    """
    rng = still.world.generator("trial.calibration")
    sightings = []
    for lens in LENSES:
        for _ in range(SPOTS):
            lamp = np.array(about) + rng.uniform((-0.12, -0.12, 0.01), (0.12, 0.12, 0.24))
            pan, tilt = DRAWING.aim(lamp, lens)
            wobble = rng.normal(0, still.world.camera.pot_noise, 2)
            uv = still.true_camera.view(lens, pan + wobble[0], tilt + wobble[1]).project(lamp)[0]
            u, v = uv + rng.normal(0, SPOT_NOISE_PX, 2)
            told = lamp + rng.uniform(-ARM_ERROR_M, ARM_ERROR_M, 3)
            point = (float(told[0]), float(told[1]), float(told[2]))
            sightings.append(Sighting(lens=lens, pan=pan, tilt=tilt, u=float(u), v=float(v), point_W=point))
    return calibrate(sightings, DRAWING)
