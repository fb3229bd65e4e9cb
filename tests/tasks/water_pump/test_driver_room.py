"""The driver has room over every screw hole, and does not go through the hub."""

import mujoco
import numpy as np
import pytest
from scene_bench import Bench

from handeye.core.pose import translated
from handeye.tasks.stanford_cell.dimensions import dimensions, screw_holes

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


def over_the_rack(bench: Bench, x: float, y: float) -> float:
    """Let the driver down into its rack from 80 mm up, so far aside (m); how deep its socket went into a post, m."""
    home, deepest = bench.pose("driver"), 0.0
    posts = [
        g for g in range(bench.model.ngeom) if bench.model.body(bench.model.geom_bodyid[g]).name == "rack"
    ][:4]
    ring = [
        g for g in range(bench.model.ngeom) if bench.model.body(bench.model.geom_bodyid[g]).name == "socket"
    ]
    bench.put("driver", translated(home, (x, y, 0.08)))
    guide = bench.model.joint("driver").dofadr[0]
    for _ in range(1200):  # as slowly as a hand lets it down that gives way sideways
        bench.data.qvel[guide + 2] = max(bench.data.qvel[guide + 2], -0.1)
        bench.data.qvel[guide + 3 : guide + 6] = 0.0
        bench.run(bench.model.opt.timestep)
        met = np.isin(bench.data.contact.geom, posts).any(axis=1) & np.isin(
            bench.data.contact.geom, ring
        ).any(axis=1)
        deepest = min(deepest, bench.data.contact.dist[met].min(initial=0.0))
    assert bench.pose("driver")[2, 3] == pytest.approx(home[2, 3], abs=3e-4)
    return float(-deepest)


@pytest.mark.slow
@pytest.mark.parametrize(("x", "y"), [(0.0, 0.0), (0.003, 0.0), (0.0, -0.003), (-0.0025, 0.0025)])
def test_a_driver_let_down_a_little_aside_passes_the_posts_of_its_rack(x: float, y: float) -> None:
    assert over_the_rack(Bench(), x, y) == 0.0


@pytest.mark.slow
def test_a_socket_over_a_post_of_the_rack_meets_it_and_slides_off() -> None:
    assert 0.0 < over_the_rack(Bench(), 0.006, 0.006) < 0.5e-3
