"""The driver has room over every screw hole, and does not go through the hub."""

import mujoco
import numpy as np
import pytest
from scene_bench import Bench

from handeye.tasks.water_pump.dimensions import dimensions
from handeye.tasks.water_pump.drawing import screw_holes

DRIVER = ("driver", "bit", "socket")


def put_over(bench: Bench, x: float, y: float, z: float) -> None:
    """Put the bit's face over a place of the top (m)."""
    size = dimensions()
    over = size("driver.bit") + size("driver.height") / 2
    X = bench.pose("top") @ np.array([[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z + over], [0, 0, 0, 1]])
    bench.put("driver", X)


def room(bench: Bench, other: str) -> float:
    """Between the driver and a geom, m."""
    model, ends = bench.model, np.zeros(6)
    mine = [g for g in range(model.ngeom) if model.body(model.geom_bodyid[g]).name in DRIVER]
    solid = [g for g in mine if model.geom_contype[g] & 2]
    assert len(solid) == 11  # block, housing, face, and eight wedges of the ring
    other_id = model.geom(other).id
    return min(mujoco.mj_geomDistance(model, bench.data, g, other_id, 0.2, ends) for g in solid)


@pytest.mark.slow
@pytest.mark.parametrize("hole", range(6))
def test_the_driver_on_a_seated_screw_clears_hub_and_crank(hole: int) -> None:
    bench, size = Bench(), dimensions()
    put_over(bench, *screw_holes()[hole], size("top.flange") + size("screw.head_height"))
    assert room(bench, "hub") > 2.5e-3
    assert room(bench, "crank") > 10e-3


@pytest.mark.slow
def test_a_driver_set_down_on_the_hub_stands_on_it() -> None:
    bench, size = Bench(), dimensions()
    top = size("top.flange") + size("top.hub_height")
    put_over(bench, 0.0, 0.024, top + 0.003)
    bench.run(0.05)
    bit = bench.data.body("bit").xpos[2] - bench.pose("top")[2, 3]
    assert bit > top - 0.003  # its ring stands lower than its face
