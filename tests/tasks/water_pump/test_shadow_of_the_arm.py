"""Where the arm is while the last pictures are taken: its shadow should not lie on the heads of the screws."""

import math

import numpy as np
import pytest
from scene_bench import standard_base

from handeye.cell.raycasting import cast
from handeye.core.resources import plans
from handeye.core.units import DEGREE, INCH
from handeye.planfile.store import read_plan
from handeye.program.vision_operations import Look
from handeye.tasks.stanford_cell.dimensions import base_top, dimensions, screw_holes, standard

LAMPS = [(zenith * DEGREE, azimuth * DEGREE) for zenith in range(5, 51, 3) for azimuth in range(-180, 180, 6)]
"""Directions of the key light, all over its range (`light.zenith` and `light.azimuth`)."""
HEAD = 0.7 * INCH  # the top of a screw's head, over the face of the base


@pytest.mark.slow
def test_the_arm_shades_a_head_in_the_last_pictures_under_one_lamp_in_a_hundred_at_most() -> None:
    plan, d, bench = read_plan(plans() / "water_pump.plan.json"), dimensions(), standard_base()
    steps = plan.program.steps
    taken = {
        step.operation.picture: number
        for number, step in enumerate(steps)
        if isinstance(step.operation, Look)
    }
    postures = [plan.motions[taken[picture] - 1].knots[-1] for picture in ("WHOLE", "DONE")]
    assert postures[0] == pytest.approx(postures[1])  # else its shadow moves from one to the next
    bench.data.qpos[:6] = postures[0]
    bench.put("pin0", np.eye(4))  # updates the scene; the pins do not matter here
    X_WB = standard()
    heads = np.array([X_WB[:3, :3] @ (x, y, base_top() + HEAD) + X_WB[:3, 3] for x, y in screw_holes()])
    arm = {i for i in range(bench.model.nbody) if bench.model.body(i).name.startswith("stanford")}
    shaded = 0
    for zenith, azimuth in LAMPS:
        across = math.sin(zenith)
        towards = np.array([across * math.cos(azimuth), across * math.sin(azimuth), math.cos(zenith)])
        lamp = np.array(d.all("camera.light_target")) + d("camera.light_distance") * towards
        rays = heads - lamp
        met, _, _ = cast(bench.model, bench.data, lamp, rays / np.linalg.norm(rays, axis=1)[:, None])
        shaded += any(int(bench.model.geom_bodyid[geom]) in arm for geom in met if geom >= 0)
    assert shaded <= len(LAMPS) / 100
