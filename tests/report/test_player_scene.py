"""The scene that a page is given looks like the cell's, in few bytes."""

from functools import cache
from typing import Any

import cv2
import mujoco
import numpy as np
import pytest
from player_bytes import Unpacked

from handeye.report.player.scene import lowest, scene_bytes
from handeye.report.player.surfaces import Surface, surface
from handeye.tasks.water_pump.scene import dressed
from handeye.tasks.water_pump.world.pump_world import PumpWorld

SCENE = """
<mujoco>
  <statistic center="0 0 .2" extent="2"/>
  <asset>
    <texture name="wood" type="2d" builtin="checker" width="64" height="64" rgb1=".9 .6 .3" rgb2=".6 .4 .2"/>
    <material name="bench" texture="wood" rgba="1 1 1 1"/>
    <material name="plain" rgba=".5 .5 .5 1" specular=".6" shininess=".6"/>
    <mesh name="wedge" vertex="0 0 0  1 0 0  0 1 0  0 0 1"/>
  </asset>
  <worldbody>
    <geom name="bench_top" type="box" size="1 .5 .02" pos="0 0 -.02" material="bench" group="2"/>
    <geom type="box" size=".5 .5 .5" pos="0 0 -.5" material="plain" group="1"/>
    <geom type="box" size="9 9 9" group="3"/>
    <camera name="studio" pos="2 0 1.2" xyaxes="0 1 0 -.4472 0 .8944" fovy="40"/>
    <body name="pin0" pos="0 0 1" quat=".7071 .7071 0 0"><freejoint/>
      <geom type="cylinder" size=".01 .05" material="plain" group="2"/>
      <geom type="sphere" size=".02" pos="0 0 .1" group="2"/>
    </body>
    <body name="pin1" pos="0 0 2"><freejoint/>
      <geom type="cylinder" size=".01 .05" material="plain" group="2"/>
      <geom type="sphere" size=".02" pos="0 0 .1" group="2"/>
    </body>
    <body name="hidden"><freejoint/><geom type="mesh" mesh="wedge" group="4"/></body>
    <body name="felt"><freejoint/><geom type="box" size=".1 .1 .1" group="3"/></body>
  </worldbody>
</mujoco>
"""


@cache
def small() -> Any:
    """A scene of a few shapes."""
    return mujoco.MjModel.from_xml_string(SCENE)


@cache
def seen() -> Unpacked:
    """What a page is given of it."""
    return Unpacked.of(scene_bytes(small()))


def shown(body: str) -> list[int]:
    """The surface of a body as a page has it: first corner and number of corners of triangles."""
    (told,) = (told for told in seen().header["bodies"] if told["name"] == body)
    fine: list[int] = seen().header["meshes"][told["mesh"]]["fine"]
    return fine


def volume(piece: Surface) -> float:
    """Volume inside a surface, m3; below zero if it is turned inside out."""
    a, b, c = piece.points[piece.triangles].transpose(1, 0, 2)
    return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6


def test_bodies_that_are_seen_or_will_be_are_there() -> None:
    assert [body["name"] for body in seen().header["bodies"]] == ["world", "pin0", "pin1", "hidden"]


def test_people_read_names_in_words() -> None:
    assert [body["label"] for body in seen().header["bodies"]] == ["world", "pin 0", "pin 1", "hidden"]


def test_parts_of_the_world_have_names_and_what_is_behind_all_else_comes_last() -> None:
    assert [part[0] for part in seen().header["meshes"][0]["parts"]] == ["plain", "bench top"]


def test_people_read_what_the_scene_says_they_call_a_body() -> None:
    text = '<custom><text name="called/pin" data="dowel"/><text name="called/hidden" data="wedge"/></custom>'
    model = mujoco.MjModel.from_xml_string(SCENE.replace("<asset>", f"{text}<asset>"))
    labels = [body["label"] for body in Unpacked.of(scene_bytes(model)).header["bodies"]]
    assert labels == ["world", "dowel 0", "dowel 1", "wedge"]


def test_a_material_is_as_glossy_as_the_scene_says() -> None:
    text = '<custom><numeric name="gloss/plain" data=".7 .3"/></custom>'
    told = Unpacked.of(
        scene_bytes(mujoco.MjModel.from_xml_string(SCENE.replace("<asset>", f"{text}<asset>")))
    )
    assert [row[4:6] for row in told.header["materials"]].count([0.7, 0.3]) == 1
    assert [row[4:6] for row in seen().header["materials"]].count([0.7, 0.3]) == 0


def test_equal_bodies_share_a_surface() -> None:
    assert shown("pin0") == shown("pin1")
    assert len(seen().header["meshes"]) == 3


def test_what_is_below_the_world_is_put_away() -> None:
    assert lowest(small()) == pytest.approx(-1.0)


@pytest.mark.parametrize(
    ("shape", "true"), [(0, 0.08), (3, np.pi * 1e-5), (4, 4 / 3 * np.pi * 8e-6), (7, 1 / 6)]
)
def test_a_surface_encloses_what_its_shape_does(shape: int, true: float) -> None:
    piece = surface(small(), shape)
    assert piece is not None
    assert volume(piece) == pytest.approx(true, rel=0.02)


@pytest.mark.parametrize("shape", [0, 3, 4, 7])
def test_normals_point_outwards_and_round_shapes_are_round(shape: int) -> None:
    piece = surface(small(), shape)
    assert piece is not None
    a, b, c = piece.points[piece.triangles].transpose(1, 0, 2)
    flat = np.cross(b - a, c - a)
    flat /= np.linalg.norm(flat, axis=1, keepdims=True)
    cosines = np.einsum("ik,ijk->ij", flat, piece.normals[piece.triangles])
    assert np.linalg.norm(piece.normals, axis=1) == pytest.approx(1.0)
    assert cosines.min() > np.cos(np.radians(20))


def test_points_and_normals_come_back_where_the_body_has_them() -> None:
    data, (first, count) = seen(), shown("hidden")
    mesh = data.header["meshes"][2]
    corners = data.summed("triangles")[first : first + count]
    points = np.array(mesh["scale"][:3]) + mesh["scale"][3] * data.rows("points", 3)[corners]
    wedge = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
    assert {tuple(point) for point in points.round(4)} == {tuple(map(float, point)) for point in wedge}
    x, y = data.array("normals").reshape(2, -1)[:, corners] / 127
    assert set((np.abs(x) + np.abs(y)).round(1)) <= {
        0.7,
        1.0,
        2.0,
    }  # the slope, the upright sides, the bottom


def test_the_cameras_of_the_scene_are_views() -> None:
    (room,) = seen().header["views"]
    assert (room["name"], room["angle"]) == ("room", 40.0)
    assert room["eye"] == pytest.approx([2, 0, 1.2])
    assert room["at"] == pytest.approx([0, 0, 0.2], abs=1e-3)


def test_a_grain_is_a_grey_picture_and_its_tint_is_in_the_colour() -> None:
    data = seen()
    grey = cv2.imdecode(data.array("picture"), cv2.IMREAD_UNCHANGED)
    assert grey.shape[:2] == (512, 512)
    r, g, b, *_, grain, _, along, across = data.header["materials"][0]
    assert r > g > b
    assert (grain, along, across) == (0, 0.5, 1.0)  # once over the table


@cache
def pump() -> bytes:
    """The scene of the pump."""
    return scene_bytes(dressed(PumpWorld.nominal()))


@pytest.mark.slow
def test_equal_scenes_give_equal_bytes_of_which_a_page_can_carry_many() -> None:
    assert pump() == scene_bytes(dressed(PumpWorld.nominal()))
    assert len(pump()) < 250_000


@pytest.mark.slow
def test_small_bodies_have_coarser_surfaces() -> None:
    header = Unpacked.of(pump()).header
    wanted = {"screw0", "carrier0", "base", "top"}
    meshes = [header["meshes"][body["mesh"]] for body in header["bodies"] if body["name"] in wanted]
    assert len(meshes) == len(wanted)
    assert all(mesh["coarse"][1] < mesh["fine"][1] / 2 for mesh in meshes)
