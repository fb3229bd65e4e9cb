"""A scene put back by the poses of its bodies alone looks as it did."""

import numpy as np
import pytest
from scene_bench import Bench

from handeye.cell.looks import SEEN
from handeye.cell.posed import posed
from handeye.core.pose import planar
from handeye.tasks.water_pump.scene import build
from handeye.tasks.water_pump.world.pump_world import PumpWorld

pytestmark = pytest.mark.slow


def test_every_shape_is_where_it_was() -> None:
    scene = Bench()
    scene.put("base", planar(0.5, 0.9, 0.05, 0.7))
    scene.put("screw3", planar(0.6, 0.8, 0.2, 2.0))
    bodies = range(1, scene.model.nbody)
    poses = {scene.model.body(b).name: (*scene.data.xpos[b], *scene.data.xquat[b]) for b in bodies}
    _, data = posed(build(PumpWorld.nominal()), poses)
    assert np.abs(data.geom_xpos - scene.data.geom_xpos).max() < 1e-9
    assert np.abs(data.geom_xmat - scene.data.geom_xmat).max() < 1e-9


def test_a_screw_is_seen_in_its_thread_once_it_has_a_pose_there() -> None:
    upright = (0.5, 0.5, 0.1, 1.0, 0.0, 0.0, 0.0)
    scene = build(PumpWorld.nominal())
    shown, _ = posed(scene, {"carrier2": upright, "no_such_body": upright})
    hidden, _ = posed(scene, {})
    body = shown.body("carrier2").id
    assert (shown.geom_group[shown.geom_bodyid == body] == SEEN).all()
    assert (hidden.geom_group[hidden.geom_bodyid == body] != SEEN).all()
