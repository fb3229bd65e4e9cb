"""The pump's cell in its initial state, for trials of vision: parts are placed at given poses, and located with
the camera. Parts and camera are described as a program knows them.
"""

import math
from collections.abc import Iterator
from typing import Final

import mujoco
import numpy as np

from handeye.arm.robots.stanford import STANFORD
from handeye.cell.camera import CameraState, SimulatedCamera, make_renderer, true_camera
from handeye.cell.compiled_arm import CompiledArm
from handeye.cell.keyframe import body_pose
from handeye.core.pose import Array, Pose, planar
from handeye.core.record import Vector3
from handeye.core.units import DEGREE, INCH
from handeye.execution.camera_calibration import calibrate_camera
from handeye.execution.friction_measurement import measure_joints
from handeye.execution.state import DriveState
from handeye.ports.camera import CLOSE_UP, LENSES, WIDE, Picture, TvCamera
from handeye.program.program import Hole, Part
from handeye.tasks.stanford_cell.arm import ARM
from handeye.tasks.stanford_cell.dimensions import PARK, base_top, dimensions, pin_seat, screw_holes
from handeye.tasks.trial import Known
from handeye.tasks.water_pump.cell import build_cell
from handeye.tasks.water_pump.scene import build
from handeye.tasks.water_pump.world.nominal import DRAWING, LOOKS
from handeye.tasks.water_pump.world.pump_world import PumpWorld
from handeye.tasks.water_pump.world.variation import BELT_LINE, BELT_X, BELT_Y
from handeye.vision.base import Failure, GeneralLocation, SpecificLocation, locate_general, locate_specific
from handeye.vision.calibration import Calibration, Sighting, calibrate
from handeye.vision.camera_model import CameraModel, View

SPOTS: Final = 20  # number of simulated sightings with each lens
ARM_ERROR_M: Final = 0.1 * INCH  # greatest simulated error of the arm along each axis
SPOT_NOISE_PX: Final = 0.5
Place = tuple[float, float, float, float]  # x, y, z (m) and yaw (rad) in W


class StillPump:
    """The cell of a world in its initial state, with the arm parked."""

    def __init__(self, world: PumpWorld, *, renderer: str = "auto") -> None:
        self.world, model = world, build(world)
        self._model, self._data = model, mujoco.MjData(model)
        for number, q in enumerate(PARK, 1):
            self._data.joint(f"{ARM}j{number}").qpos = float(q)
        mujoco.mj_forward(model, self._data)
        eye, noise = make_renderer(renderer, model), world.generator("camera")
        self.camera = SimulatedCamera(self._data, world.camera, noise, eye, DRAWING)
        self.true_camera = true_camera(world.camera, DRAWING)

    def put(self, part: str, X_WP: Pose) -> None:
        """Put a free body at a pose, without checking whether another body is there."""
        quat: Array = np.zeros(4)
        mujoco.mju_mat2Quat(quat, X_WP[:3, :3].ravel())
        self._data.joint(part).qpos = [*X_WP[:3, 3], *quat]
        mujoco.mj_forward(self._model, self._data)

    def pose(self, part: str) -> Pose:
        """Return `X_WP`, the pose of a body."""
        return body_pose(self._data, part)


def pump_base(at: Place | None = None) -> Part:
    """Describe the pump base as a program does, using the dimensions of the scene. By default the base is
    expected on the belt."""
    d = dimensions()
    first = Hole(x=0.0, y=0.0, diameter=d("base.large_hole_1.diameter"))
    second = Hole(x=d("base.large_hole_2.x"), y=0.0, diameter=d("base.large_hole_2.diameter"))
    middle, length, width = d("base.plate.centre_x"), d("base.plate.length"), d("base.plate.width")
    (x0, x1), (y0, y1) = BELT_X, BELT_Y
    belt = ((x0 + x1) / 2 * INCH, (y0 + y1) / 2 * INCH, d("belt.height"), sum(BELT_LINE) / 2 * DEGREE)
    return Part(
        at=at or belt,
        face=base_top(),
        holes=(first, second),
        screw_holes=tuple(
            Hole(x=x, y=y, diameter=2 * d("base.screw_holes.radius")) for x, y in screw_holes()
        ),
        region=((x1 - x0) / 2 * INCH, (y1 - y0) / 2 * INCH),
        outline=(middle - length / 2, -width / 2, middle + length / 2, width / 2),
    )


def put_base(still: StillPump, place: Place, *, pins: bool) -> None:
    """Put the base at a place. If `pins` is True, put the aligning pins into the base; if not, leave the pins where
    they are.
    """
    X_WP = planar(*place)
    still.put("base", X_WP)
    d = dimensions()
    seat = base_top() + pin_seat(d("base.screw_holes.chamfer"), d("base.screw_holes.radius"))
    for number, hole in enumerate(d.all("base.screw_holes.pinned") if pins else ()):
        x, y = screw_holes()[int(hole)]
        still.put(f"pin{number}", X_WP @ planar(x, y, seat, 0.0))


def look(camera: TvCamera, known: CameraModel, lens: float, point: tuple[float, float, float]) -> View:
    """Select the lens, aim the camera, and focus the lens, as the executor does. Returns the view that the program
    computes from its camera model and the potentiometers.
    """
    camera.lens(lens)
    camera.aim(*known.aim(point, lens))
    camera.focus(math.dist(point, known.mount))
    return known.view(lens, *camera.pots())


def locate(
    camera: TvCamera, known: CameraModel, part: Part
) -> tuple[SpecificLocation | Failure, list[tuple[Picture, View, GeneralLocation | None]]]:
    """Locate the part with both stages of vision. Also returns the pictures used."""
    x, y, z, _ = part.at
    view = look(camera, known, WIDE, (x, y, z))
    picture = camera.digitise()
    general = locate_general(picture, view, part)
    if isinstance(general, Failure):
        return general, [(picture, view, None)]
    pictures: list[tuple[Picture, View, GeneralLocation | None]] = [(picture, view, general)]
    middle = np.mean(general.corners, axis=0)
    view = look(camera, known, CLOSE_UP, (float(middle[0]), float(middle[1]), float(middle[2])))
    picture = camera.digitise()
    pictures.append((picture, view, None))
    return locate_specific(picture, view, part, general), pictures


def base_poses(world: PumpWorld, number: int) -> Iterator[Vector3]:
    """Yield poses of the base, each as x and y (m) and yaw (rad). The base's pose in the world comes first."""
    yield world.base.x, world.base.y, world.base.yaw
    rng, ranges = world.generator("trial.base"), np.array([BELT_X, BELT_Y, BELT_LINE])
    for _ in range(number - 1):
        x, y, yaw = rng.uniform(*ranges.T) * (INCH, INCH, DEGREE)
        yield float(x), float(y), float(yaw)


def known_camera(
    still: StillPump, known: Known, renderer: str, about: tuple[float, float, float]
) -> CameraModel:
    """Return the camera model that the program knows. If `known` is `sightings`, the model is calibrated with
    simulated sightings of points near `about` (m, in W). Raises CalibrationFailed if the camera cannot be calibrated.
    """
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
    """Calibrate as in a run: the arm measures the errors of its joints, and then carries its lamp through the
    camera's view.

    The calibration is done in a separate cell. Afterwards, the state of that cell's camera is copied to the camera of
    the still cell: lens, aim, and noise generator. Raises CalibrationFailed if the lamp was seen too few times.
    """
    cell = build_cell(still.world, camera=renderer)
    drive = DriveState.holding(cell.devices.sense(), STANFORD)
    found = measure_joints(cell.devices, STANFORD, drive, arithmetic=CompiledArm)
    drive.friction, drive.links = found.friction, found.links
    assert cell.camera is not None
    with cell.camera.without_shadows():
        calibration = calibrate_camera(cell.devices, STANFORD, drive, DRAWING, LOOKS, arithmetic=CompiledArm)
    state = cell.truth.states["camera"]
    assert isinstance(state, CameraState)
    still.camera.restore(state)
    return calibration


def by_sightings(still: StillPump, about: tuple[float, float, float]) -> Calibration:
    """Calibrate with simulated sightings of a lamp at random points near the point `about` (m), without
    rendering.

    This calibration is fast but too accurate, because it does not simulate the errors of the joints, of the lamp's
    position and of the raster.
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
