"""What is in the scene for people alone is seen by no television camera, and changes nothing that happens."""

from functools import cache

import mujoco
import numpy as np
import pytest
from finished import finished_cell
from manifold3d import Manifold, Mesh

from handeye.cell.camera import make_renderer
from handeye.cell.looks import LATENT, PLAIN, SCENERY, SEEN
from handeye.cell.photograph import SHOWN
from handeye.cell.posed import as_it_stands
from handeye.cell.vidicon import Luminance
from handeye.core.errors import InvalidInput
from handeye.core.pose import Array
from handeye.ports.camera import CLOSE_UP, WIDE
from handeye.report.player.surfaces import surface
from handeye.tasks.water_pump.cell import build_cell
from handeye.tasks.water_pump.scene import build, dressed
from handeye.tasks.water_pump.scene.dressing import bevelled
from handeye.tasks.water_pump.world.nominal import DRAWING
from handeye.tasks.water_pump.world.pump_world import PumpWorld

pytestmark = pytest.mark.slow

LOOKS = [(WIDE, (1.1, 0.7, 0.03)), (CLOSE_UP, (0.37, 1.0, 0.05)), (WIDE, (0.6, 0.9, 0.1))]
"""Lens and place (m): the belt, blocks and pins, all fixtures."""


@cache
def working() -> mujoco.MjModel:
    return build(PumpWorld.sample(3))


@cache
def shown() -> mujoco.MjModel:
    """The same world as people are shown it."""
    return dressed(PumpWorld.sample(3))


def picture(model: mujoco.MjModel, kind: str, lens: float, at: tuple[float, float, float]) -> Luminance:
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return make_renderer(kind, model).render(data, DRAWING.view(lens, *DRAWING.aim(at, lens)))


def without(model: mujoco.MjModel) -> set[str]:
    """Names of what only people's scene has."""
    there = {working().body(number).name for number in range(working().nbody)}
    return {model.body(number).name for number in range(model.nbody)} - there


def extent(shape: int) -> Array:
    """Lowest and highest corner of a shape in the frame of its body."""
    found = surface(shown(), shape)
    assert found is not None
    return np.stack([found.points.min(axis=0), found.points.max(axis=0)])


@pytest.mark.render
@pytest.mark.parametrize(("kind", "lens", "at"), [*(("gl", *look) for look in LOOKS), ("ray", *LOOKS[-1])])
def test_the_television_camera_sees_the_same(kind: str, lens: float, at: tuple[float, float, float]) -> None:
    try:
        plain, dressed = (picture(model, kind, lens, at) for model in (working(), shown()))
    except InvalidInput:
        pytest.skip("there is no OpenGL here")
    assert plain.tobytes() == dressed.tobytes()


def test_physics_is_the_same_to_the_byte() -> None:
    ends = []
    for model in (working(), shown()):
        data = mujoco.MjData(model)
        data.ctrl[:6] = (5.0, -8.0, 60.0, 1.0, -1.0, 0.5)
        mujoco.mj_step(model, data, 60)
        ends.append(np.concatenate([data.qpos, data.qvel, data.act]).tobytes())
    assert ends[0] == ends[1]


def test_it_meets_and_weighs_nothing() -> None:
    model = shown()
    scenery = model.geom_group == SCENERY
    assert scenery.sum() > 250
    assert not model.geom_contype[scenery].any()
    assert not model.geom_conaffinity[scenery].any()
    assert {name: float(model.body(name).mass[0]) for name in without(model)} == dict.fromkeys(
        without(model), 0.0
    )


def test_no_working_cell_has_any_of_it() -> None:
    assert without(shown()) == {"teletype", "hour_hand", "minute_hand", "second_hand"}
    assert working().ntex == 0
    (_, room, seen, felt, latent), (_, more, left, *same, plain) = (
        np.bincount(model.geom_group).tolist() for model in (working(), shown())
    )
    assert (left + plain, same) == (seen, [felt, latent])
    assert more > room


def test_a_box_that_people_are_shown_bevelled_is_where_it_was() -> None:
    model = shown()
    plain = np.flatnonzero(model.geom_group == PLAIN)
    assert {"block_far", "block_left", "driver", "riser"} <= {model.geom(shape).name for shape in plain}
    assert not SHOWN[PLAIN]
    for name in ("block_far", "driver"):
        box, look = model.geom(name), model.geom(f"{name}_bevelled")
        assert (box.bodyid, box.matid, look.group) == (look.bodyid, look.matid, SCENERY)
        assert np.allclose(extent(box.id), extent(look.id), atol=1e-7)


def test_a_bevel_takes_half_a_millimetre_off_every_edge() -> None:
    points, triangles = bevelled(np.array([0.02, 0.01, 0.005]))
    solid = Manifold(Mesh(points.astype(np.float32), triangles))
    assert np.ptp(points, axis=0) == pytest.approx([0.04, 0.02, 0.01])
    edges = 0.0005**2 / 2 * 4 * (0.04 + 0.02 + 0.01)
    assert solid.volume() == pytest.approx(0.04 * 0.02 * 0.01 - edges, abs=8 * 0.0005**3)


def test_people_see_the_cell_as_it_stands() -> None:
    truth = finished_cell().truth
    scene = dressed(PumpWorld.nominal())
    model, data = as_it_stands(scene, truth)
    for body in range(1, truth.model.nbody):
        name = truth.model.body(body).name
        there = data.body(name)
        assert np.allclose(there.xpos, truth.data.xpos[body], atol=1e-12), name
    screws = [model.geom_bodyid == model.body(f"carrier{k}").id for k in range(6)]
    assert all((model.geom_group[shapes] == SEEN).all() for shapes in screws)
    assert all((scene.geom_group[shapes] == LATENT).any() for shapes in screws)


def test_no_screw_is_shown_in_a_thread_that_none_has_entered() -> None:
    model, _ = as_it_stands(shown(), build_cell(PumpWorld.sample(3), camera="ray").truth)
    assert ((model.geom_group == LATENT) == (shown().geom_group == LATENT)).all()


def test_the_tripod_is_out_of_the_view_of_the_studio() -> None:
    model = shown()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    eye, axes = data.camera("studio").xpos, data.camera("studio").xmat.reshape(3, 3)
    high = np.tan(np.radians(model.camera("studio").fovy[0] / 2))
    for name in ("tripod", "tripod_leg0", "tripod_leg1", "tripod_leg2"):
        shape = model.geom(name).id
        half = data.geom_xmat[shape].reshape(3, 3)[:, 2] * model.geom_size[shape][1]
        along = np.linspace(data.geom_xpos[shape] - half, data.geom_xpos[shape] + half, 50)
        x, y, z = ((along - eye) @ axes).T
        inside = (np.abs(x / z) < high * 4 / 3 + 0.02) & (np.abs(y / z) < high + 0.02)
        assert not inside.any(), name
