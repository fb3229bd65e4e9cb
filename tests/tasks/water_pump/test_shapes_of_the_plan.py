"""The boxes by which a plan is checked are those of the cell's drawing."""

from collections.abc import Sequence

import mujoco
import numpy as np
import pytest

from handeye.arm.robots.stanford import STANFORD
from handeye.core.obb import Box
from handeye.core.pose import Array, Pose, hand, inverse, planar, pose
from handeye.core.resources import plans
from handeye.core.units import INCH
from handeye.program.taught import load_taught
from handeye.program.world_model import WorldModel
from handeye.tasks.stanford_cell.arm import ARM
from handeye.tasks.water_pump.scene import build
from handeye.tasks.water_pump.world.pump_world import PumpWorld

TAUGHT = load_taught(plans() / "water_pump.toml")
WORLD = WorldModel(parts=TAUGHT.parts, positions=TAUGHT.positions)
CLOSE = 0.02 * INCH
"""Rounding in the taught file, and the corners of wedges around a hole."""
GAP = 0.03


@pytest.fixture(scope="module")
def scene() -> tuple[mujoco.MjModel, mujoco.MjData]:
    model = build(PumpWorld.nominal())
    data = mujoco.MjData(model)
    for finger in ("finger_a", "finger_b"):
        data.joint(ARM + finger).qpos = GAP / 2
    mujoco.mj_forward(model, data)
    return model, data


def points(model: mujoco.MjModel, data: mujoco.MjData, geom: int) -> Array:
    """Points of a geom's surface, its outermost among them, shape (n, 3), world."""
    size, kind = model.geom_size[geom], model.geom_type[geom]
    if kind == mujoco.mjtGeom.mjGEOM_MESH:
        mesh = model.geom_dataid[geom]
        first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
        local = model.mesh_vert[first : first + count]
    elif kind == mujoco.mjtGeom.mjGEOM_BOX:
        local = np.array(np.meshgrid(*([-s, s] for s in size))).reshape(3, -1).T
    else:
        turn = np.linspace(0, 2 * np.pi, 64, endpoint=False)
        ring = np.stack([size[0] * np.cos(turn), size[0] * np.sin(turn)], axis=1)
        local = np.vstack([np.column_stack([ring, np.full(64, z)]) for z in (-size[1], size[1])])
    return np.asarray(local @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom])


def around(cloud: Array, X_WF: Pose) -> Array:
    """The box around points, in a frame: shape (2, 3)."""
    X_FW = inverse(X_WF)
    local = cloud @ X_FW[:3, :3].T + X_FW[:3, 3]
    return np.array([local.min(axis=0), local.max(axis=0)])


def corners(boxes: Sequence[Box]) -> Array:
    return np.array(boxes).reshape(-1, 2, 3)


def geoms(model: mujoco.MjModel, bodies: Sequence[str], *, met: bool) -> list[int]:
    """Geoms of bodies; those that are met only, or those that are seen as well."""
    ids = {model.body(name).id for name in bodies}
    return [
        g
        for g in range(model.ngeom)
        if model.geom_bodyid[g] in ids and (not met or model.geom_contype[g] or model.geom_conaffinity[g])
    ]


FIXTURES = {
    "PIN_HOLDER": ("pin_holder", ""),
    "DISPENSER": ("dispenser", ""),
    "GASKET_STAND": ("gasket_stand", ""),
    "TOP_STAND": ("top_stand", ""),
    "RACK": ("rack", ""),
    "FAR_BLOCK": ("blocks", "block_far"),
    "LEFT_BLOCK": ("blocks", "block_left"),
    "BELT": ("world", "belt"),
}
"""Body of the scene, and geom if it is one of several."""


@pytest.mark.parametrize("name", FIXTURES)
def test_each_fixture_is_where_the_drawing_has_it(
    name: str, scene: tuple[mujoco.MjModel, mujoco.MjData]
) -> None:
    body, geom = FIXTURES[name]
    fixture, X_WF = TAUGHT.fixtures[name], planar(*TAUGHT.fixtures[name].at)
    chosen = [g for g in geoms(scene[0], [body], met=True) if geom in ("", scene[0].geom(g).name)]
    drawn = [around(points(*scene, g), X_WF) for g in chosen]
    for box in corners(fixture.boxes):
        inside = [d for d in drawn if (d[0] > box[0] - CLOSE).all() and (d[1] < box[1] + CLOSE).all()]
        drawn = [d for d in drawn if not any(d is i for i in inside)]
        assert inside
        np.testing.assert_allclose(box[0], np.min([d[0] for d in inside], axis=0), atol=CLOSE)
        np.testing.assert_allclose(box[1], np.max([d[1] for d in inside], axis=0), atol=CLOSE)
    assert drawn == []


def test_every_fixture_is_compared_but_the_arm_s_own_riser() -> None:
    assert set(TAUGHT.fixtures) - set(FIXTURES) == {"RISER"}


def test_the_riser_is_where_the_drawing_has_it(scene: tuple[mujoco.MjModel, mujoco.MjData]) -> None:
    (box,) = corners(TAUGHT.fixtures["RISER"].boxes)
    drawn = [around(points(*scene, g), np.eye(4)) for g in geoms(scene[0], ["world"], met=False)]
    assert any(np.allclose(box, d, atol=CLOSE) for d in drawn)


HELD = {
    "PIN": ("P1", ["pin0"]),
    "GASKET": ("G", ["gasket"]),
    "TOP": ("TOP", ["top", "rotor"]),
    "SCREWDRIVER": ("D", ["driver", "bit", "socket"]),
}
"""A position it is taken at, and the bodies of the scene it is made of."""


@pytest.mark.parametrize("name", HELD)
def test_what_is_held_is_as_large_as_drawn(name: str, scene: tuple[mujoco.MjModel, mujoco.MjData]) -> None:
    position, bodies = HELD[name]
    cloud = np.vstack([points(*scene, g) for g in geoms(scene[0], bodies, met=False)])
    boxes = corners(TAUGHT.held[name].boxes)
    drawn = around(cloud, WORLD.planned_position(position))
    np.testing.assert_allclose([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)], drawn, atol=CLOSE)


def test_the_casting_in_the_hand_is_as_large_as_drawn(
    scene: tuple[mujoco.MjModel, mujoco.MjData],
) -> None:
    model, data = scene
    base = data.body("base")
    X_WT = pose(base.xmat.reshape(3, 3), base.xpos) @ hand(*TAUGHT.positions["WEB"].at)
    looks = [g for g in geoms(model, ["base"], met=False) if "casting" in name_of(model, g)]
    plate = [g for g in geoms(model, ["base"], met=False) if "plate" in name_of(model, g)]
    drawn = [around(np.vstack([points(model, data, g) for g in part]), X_WT) for part in (plate, looks)]
    np.testing.assert_allclose(corners(TAUGHT.held["BASE_CASTING"].boxes), drawn, atol=CLOSE)


def name_of(model: mujoco.MjModel, geom: int) -> str:
    """The name of a geom's mesh, or its own."""
    mesh = model.geom_dataid[geom]
    return str(model.mesh(mesh).name if mesh >= 0 else model.geom(geom).name)


def test_everything_that_is_held_is_compared() -> None:
    assert set(TAUGHT.held) == {*HELD, "BASE_CASTING"}


def test_fingers_and_palm_are_those_of_the_drawing(scene: tuple[mujoco.MjModel, mujoco.MjData]) -> None:
    model, data = scene
    site = data.site(ARM + "tool")
    X_WT = pose(site.xmat.reshape(3, 3), site.xpos)
    parts = [["bar_a", "pad_a"], ["bar_b", "pad_b"], ["palm"]]
    for names, box in zip(parts, corners(STANFORD.hand.boxes(GAP))[:3], strict=True):
        cloud = np.vstack([points(model, data, model.geom(ARM + name).id) for name in names])
        np.testing.assert_allclose(box, around(cloud, X_WT), atol=1e-4)


def test_the_wrist_is_a_box_around_what_is_drawn_over_the_palm(
    scene: tuple[mujoco.MjModel, mujoco.MjData],
) -> None:
    model, data = scene
    site = data.site(ARM + "tool")
    X_WT = pose(site.xmat.reshape(3, 3), site.xpos)
    palm, wrist = corners(STANFORD.hand.boxes(GAP))[2:]
    for geom in geoms(model, [ARM + "link6"], met=False):
        low, high = around(points(model, data, geom), X_WT)
        if high[2] < palm[0, 2] + 1e-4:
            assert (low >= wrist[0] - 1e-4).all()
            assert (high <= wrist[1] + 1e-4).all()
