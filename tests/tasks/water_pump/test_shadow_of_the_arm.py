"""Where the arm is while the last pictures are taken: its shadow should not lie on the heads of the screws. If the
shadow of its column hides several of them, the pictures are refused.
"""

import math

import mujoco
import numpy as np
import pytest
from finished import finished
from scene_bench import standard_base

from handeye.cell.camera import SimulatedCamera, make_renderer
from handeye.cell.raycasting import cast
from handeye.core.pose import Array
from handeye.core.resources import plans
from handeye.core.units import DEGREE, INCH
from handeye.planfile.store import read_plan
from handeye.ports.camera import CLOSE_UP
from handeye.program.diagnosis.causes import DarkPart
from handeye.program.vision_operations import Look
from handeye.tasks.stanford_cell.dimensions import base_top, dimensions, screw_holes, standard
from handeye.tasks.water_pump.trials.still_pump import look
from handeye.tasks.water_pump.world.nominal import DRAWING
from handeye.tasks.water_pump.world.pump_world import PumpWorld
from handeye.vision.base import Failure, PartMatch
from handeye.vision.matching import match

PLAN = read_plan(plans() / "water_pump.plan.json")
LAMPS = [(zenith * DEGREE, azimuth * DEGREE) for zenith in range(5, 51, 3) for azimuth in range(-180, 180, 6)]
"""Directions of the key light, all over its range (`light.zenith` and `light.azimuth`)."""
HEAD = 0.7 * INCH  # the top of a screw's head, over the face of the base


def posture(picture: str) -> tuple[float, ...]:
    """The angles and lengths of the joints while a picture is taken."""
    (number,) = (
        number
        for number, step in enumerate(PLAN.program.steps)
        if isinstance(step.operation, Look) and step.operation.picture == picture
    )
    return PLAN.motions[number - 1].knots[-1]


def lamp(zenith: float, azimuth: float) -> tuple[Array, Array]:
    """Where the lamp is, and the unit vector towards it."""
    d, across = dimensions(), math.sin(zenith)
    towards = np.array([across * math.cos(azimuth), across * math.sin(azimuth), math.cos(zenith)])
    return np.array(d.all("camera.light_target")) + d("camera.light_distance") * towards, towards


@pytest.mark.slow
def test_the_arm_shades_a_head_in_the_last_pictures_under_one_lamp_in_a_hundred_at_most() -> None:
    bench = standard_base()
    assert posture("WHOLE") == pytest.approx(posture("DONE"))  # else its shadow moves from one to the next
    bench.data.qpos[:6] = posture("WHOLE")
    bench.put("pin0", np.eye(4))  # updates the scene; the pins do not matter here
    X_WB = standard()
    heads = np.array([X_WB[:3, :3] @ (x, y, base_top() + HEAD) + X_WB[:3, 3] for x, y in screw_holes()])
    arm = {i for i in range(bench.model.nbody) if bench.model.body(i).name.startswith("stanford")}
    shaded = 0
    for zenith, azimuth in LAMPS:
        place, _ = lamp(zenith, azimuth)
        rays = heads - place
        met, _, _ = cast(bench.model, bench.data, place, rays / np.linalg.norm(rays, axis=1)[:, None])
        shaded += any(int(bench.model.geom_bodyid[geom]) in arm for geom in met if geom >= 0)
    assert shaded <= len(LAMPS) / 100


def seen(zenith: float, azimuth: float, strength: float, ambient: float) -> PartMatch | Failure:
    """What MATCH finds if the earlier picture of a pump is taken under a lamp (degrees) that shines past the column."""
    truth, part = finished(), PLAN.program.parts["PUMP"]
    model, data = truth.model, truth.data
    data.qpos[:6] = posture("DONE")
    model.light("key").diffuse, model.vis.headlight.ambient[:] = strength, ambient
    mujoco.mj_forward(model, data)
    place, towards = lamp(zenith * DEGREE, azimuth * DEGREE)
    data.light("key").xpos, data.light("key").xdir = place, -towards
    eye = make_renderer("ray", model)
    camera = SimulatedCamera(data, PumpWorld.nominal().camera, np.random.default_rng(0), eye, DRAWING)
    x, y, z, yaw = part.at
    view = look(camera, DRAWING, CLOSE_UP, (x - part.holes[1].x / 2, y, z + part.face))
    picture = camera.digitise()
    return match(picture, picture, view, part, (x, y, yaw))


@pytest.mark.slow
def test_the_shadow_of_the_column_counts_only_if_it_hides_several_heads() -> None:
    found = seen(48.6, -109.5, 0.76, 0.354)  # it lies on half of the base, beside the heads
    assert isinstance(found, PartMatch)
    assert found.ok
    hidden = seen(49, -88, 0.79, 0.27)  # in it, three heads cannot be seen
    assert isinstance(hidden, Failure)
    assert isinstance(hidden.cause, DarkPart)
