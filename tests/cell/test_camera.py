"""The simulated television camera: its mechanics, its tube, and its two ways of rendering."""

import math
from types import SimpleNamespace
from typing import Any

import cv2
import mujoco
import numpy as np
import pytest

from handeye.cell.camera import REFOCUS, SLEW, SimulatedCamera, make_renderer, true_camera
from handeye.cell.rendering import SceneRenderer
from handeye.cell.vidicon import Vidicon, blur_disc
from handeye.core.errors import InvalidInput
from handeye.core.pose import pose
from handeye.ports.camera import CLOSE_UP, COLUMNS, DIGITISE, ROWS, WIDE, Renderer
from handeye.tasks.water_pump.world.nominal import DRAWING, LOOKS
from handeye.tasks.water_pump.world.pump_world import PumpWorld
from handeye.vision.camera_model import View

BLOCK = (0.65, 0.95, 0.0)
"""Where a black disc lies on a white block."""

SCENE = """<mujoco><worldbody>
  <light name="key" pos=".5 .9 2.3" dir=".05 0 -1" cutoff="60" exponent="0" diffuse=".6 .6 .6"/>
  <geom type="box" size="1 1 .05" pos=".7 .7 -.05" rgba=".4 .4 .4 1"/>
  <geom type="box" size=".1 .1 .01" pos=".65 .95 0" rgba=".8 .8 .8 1"/>
  <geom type="cylinder" size=".03 .001" pos=".65 .95 .01" rgba=".1 .1 .1 1"/>
  <geom type="sphere" size=".2" pos=".65 .95 .3" rgba="1 1 1 1" group="3"/>
</worldbody></mujoco>"""


def scene() -> mujoco.MjData:
    model = mujoco.MjModel.from_xml_string(SCENE)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return data


class Plain(SceneRenderer):
    """Light that gets brighter from left to right."""

    identity = Renderer(method="none")

    def render(self, data: mujoco.MjData, view: View) -> np.ndarray:
        return np.tile(np.linspace(0.1, 0.9, COLUMNS, dtype=np.float32), (ROWS, 1))


def camera(world: PumpWorld | None = None, renderer: SceneRenderer | None = None) -> SimulatedCamera:
    world = world or PumpWorld.nominal()
    return SimulatedCamera(scene(), world.camera, world.generator("camera"), renderer or Plain(), DRAWING)


@pytest.mark.row(50, nominal=1)
def test_a_picture_has_256_lines_of_333_integers_from_0_to_15():
    picture = camera().digitise()
    assert picture.shape == (256, 333)
    assert picture.dtype == np.uint8
    assert picture.max() <= 15


@pytest.mark.slow
@pytest.mark.render
@pytest.mark.parametrize("kind", ["ray", "gl"])
def test_lights_cast_shadows_except_while_those_are_switched_off(kind: str) -> None:
    model = mujoco.MjModel.from_xml_string(SCENE.replace(' group="3"', ""))  # a sphere between lamp and disc
    data, view = mujoco.MjData(model), DRAWING.view(WIDE, *DRAWING.aim(BLOCK, WIDE))
    mujoco.mj_forward(model, data)
    renderer = make_renderer(kind, model)
    first = renderer.render(data, view)
    with camera(renderer=renderer).without_shadows():
        plain = renderer.render(data, view)
    assert (plain > first + 0.1).mean() > 0.01
    assert (plain > first - 0.01).all()
    np.testing.assert_array_equal(renderer.render(data, view), first)


CRANK = """<mujoco><visual><map shadowclip="1.2" shadowscale=".8"/></visual><statistic extent="1.6"/><worldbody>
  <light name="key" pos="1.5 .3 1.84" dir="-.58 -.13 -.81" cutoff="40" exponent="0" diffuse=".6 .6 .6"/>
  <geom type="box" size="1 1 .05" pos="0 0 -.05" rgba=".8 .8 .8 1"/>
  <body><freejoint/>
    <geom type="box" size=".02 .01 .02" euler="0 0 25" rgba=".8 .8 .8 1"/>
    <geom type="cylinder" size=".008 .03" pos=".05 0 0"/>
  </body>
</worldbody></mujoco>"""
"""A part that casts a shadow in the light of the water pump's cell."""


@pytest.mark.slow
@pytest.mark.render
def test_a_shadow_moves_no_farther_than_the_part_that_casts_it() -> None:
    """With large points in the map of shadows, a push of .5 mm changed a block of the picture by .21."""
    model = mujoco.MjModel.from_xml_string(CRANK)
    data = mujoco.MjData(model)
    above: Any = SimpleNamespace(
        X_WC=pose(np.diag([1.0, -1.0, -1.0]), np.array([0.0, 0.0, 1.0])), focal=(1100.0, 1126.0)
    )
    renderer, pictures = make_renderer("gl", model), []
    for push in range(6):
        data.qpos[:3] = push * 1e-4, 0.0, 0.02
        mujoco.mj_forward(model, data)
        pictures.append(renderer.render(data, above))
    assert cv2.blur(np.abs(pictures[5] - pictures[0]), (5, 5)).max() > 0.01  # the part is in the picture
    for picture in pictures[1:]:
        assert cv2.blur(np.abs(picture - pictures[0]), (5, 5)).max() < 0.1


@pytest.mark.row(58)
def test_the_mechanics_take_time_by_the_way_they_go():
    tv = camera()
    assert (tv.lens(0.025), tv.lens(0.025)) == (20.0, 0.0)
    assert (tv.aim(0.1, 0.7), tv.aim(0.1, 0.7)) == (pytest.approx(0.7 / SLEW), 0.0)
    assert tv.aim(-0.2, 0.6) == pytest.approx(0.3 / SLEW)
    assert (tv.focus(1.6), tv.focus(1.6)) == (pytest.approx(1 / 1.6 / REFOCUS), 0.0)
    assert tv.focus(2.0) == pytest.approx((1 / 1.6 - 1 / 2.0) / REFOCUS)


def test_all_looks_of_a_pump_as_drawn_take_ninety_seconds():
    """From where calibration leaves the camera: the base on the belt by both lenses, and in its standard position."""
    tv, last = camera(), LOOKS[-1]
    tv.lens(last.lens)
    tv.aim(*DRAWING.aim(last.at, last.lens))
    tv.focus(math.dist(last.sharp, DRAWING.mount))
    belt, standard = (1.1303, 0.7461, 0.06985), (0.6001, 0.9652, 0.04445)
    seconds = 0.0
    for lens, at in ((WIDE, belt), (CLOSE_UP, belt), (CLOSE_UP, standard)):
        seconds += tv.lens(lens) + tv.aim(*DRAWING.aim(at, lens)) + tv.focus(math.dist(at, DRAWING.mount))
        seconds += DIGITISE
    assert seconds + DIGITISE == pytest.approx(90.0, abs=0.5)


def test_a_new_lens_must_be_focused_again():
    tv = camera()
    tv.focus(1.6)
    tv.lens(0.025)
    assert tv.focus(1.6) == pytest.approx(1 / 1.6 / REFOCUS)


def test_a_lens_that_is_not_there_is_refused():
    with pytest.raises(InvalidInput, match=r"^the turret has no 75 mm lens"):
        camera().lens(0.075)


@pytest.mark.parametrize("aim", [(math.nan, 0.7), (0.1, math.inf)])
def test_an_aim_that_is_not_a_number_is_refused(aim: tuple[float, float]):
    tv = camera()
    with pytest.raises(
        InvalidInput, match=r"^the aim of the camera holds a value that is not a finite number$"
    ):
        tv.aim(*aim)
    assert tv.pots() == (0.0, 0.0)


@pytest.mark.parametrize("distance", [-1.0, 0.0, 0.05, math.nan])
def test_a_focus_nearer_than_any_lens_can_have_is_refused(distance: float):
    with pytest.raises(InvalidInput, match=r"^the camera cannot be focused at .* m; the minimum is 0\.05 m$"):
        camera().focus(distance)


def test_the_pots_tell_the_aim_but_for_the_error_of_the_world():
    world = PumpWorld.sample(5)
    tv = camera(world)
    tv.aim(0.1, 0.8)
    assert tv.pots() == (0.1, 0.8)
    assert 0 < math.hypot(tv.true_view().pan - 0.1, tv.true_view().tilt - 0.8) < 5 * world.camera.pot_noise


def test_a_perfect_world_has_the_camera_of_the_drawing():
    assert true_camera(PumpWorld.nominal().camera, DRAWING) == DRAWING


def test_the_bright_parts_are_brought_to_the_same_level_in_any_light():
    light = Plain().render(scene(), DRAWING.view(0.025, 0, 0))
    levels = [np.percentile(Vidicon(np.random.default_rng(1)).expose(light * k), 90) for k in (0.1, 0.5, 1.0)]
    assert np.ptp(levels) <= 1


def test_a_held_target_shows_the_change_of_light():
    tube = Vidicon(np.random.default_rng(1))
    light = Plain().render(scene(), DRAWING.view(0.025, 0, 0))
    before = tube.expose(light).mean()
    assert tube.expose(light / 2, hold_target=True).mean() < 0.75 * before
    assert tube.expose(light / 2).mean() == pytest.approx(before, abs=0.1)


def test_noise_is_about_one_level():
    tube = Vidicon(np.random.default_rng(1))
    light = np.full((ROWS, COLUMNS), 0.5, np.float32)
    first, second = tube.expose(light).astype(float), tube.expose(light, hold_target=True).astype(float)
    assert (first - second).std() == pytest.approx(math.sqrt(2), rel=0.15)


def test_equal_seeds_give_equal_pictures():
    first, second = (camera(PumpWorld.sample(3)).digitise() for _ in range(2))
    assert (first == second).all()


def test_the_blur_of_a_forgotten_focus_is_fifteen_points_and_of_a_right_one_none():
    assert blur_disc(0.050, math.inf, 1.6) == pytest.approx(14.5, abs=0.5)
    assert blur_disc(0.025, math.inf, 1.6) == pytest.approx(3.6, abs=0.2)
    assert blur_disc(0.050, 1.6, 1.6) == 0


def test_defocus_takes_the_edges_out_of_a_picture():
    light = np.where(np.arange(COLUMNS) < 160, 0.1, 0.8).astype(np.float32) * np.ones((ROWS, 1), np.float32)
    sharp, soft = (
        Vidicon(np.random.default_rng(1)).expose(light, disc=disc).mean(axis=0) for disc in (0, 15)
    )
    assert np.abs(np.diff(sharp)).max() > 3 * np.abs(np.diff(soft)).max()


def test_an_unknown_renderer_is_refused():
    with pytest.raises(InvalidInput, match=r"^there is no renderer `film`; choose `auto`, `gl` or `ray`$"):
        make_renderer("film", scene().model)


@pytest.mark.render
@pytest.mark.parametrize("kind", ["auto", "ray"])
def test_a_renderer_gives_the_same_light_every_time(kind: str):
    data = scene()
    renderer = make_renderer(kind, data.model)
    view = DRAWING.view(0.050, *DRAWING.aim(BLOCK, 0.050))
    assert (renderer.render(data, view) == renderer.render(data, view)).all()


def silhouette_middle(view: View) -> np.ndarray:
    """Middle (u, v) of the disc as seen, in perspective and with its edge."""
    angles = np.linspace(0, 2 * np.pi, 720, endpoint=False)
    rims = [
        (BLOCK[0] + 0.03 * np.cos(a), BLOCK[1] + 0.03 * np.sin(a), z) for z in (0.010, 0.011) for a in angles
    ]
    moments = cv2.moments(cv2.convexHull(view.project(np.array(rims)).astype(np.float32)))
    return np.array([moments["m10"], moments["m01"]]) / moments["m00"]


def dark_middle(light: np.ndarray, near: np.ndarray) -> np.ndarray:
    """Middle (u, v) of what is darker than the block around a place; a point half dark counts half."""
    v, u = np.mgrid[:ROWS, :COLUMNS]
    off = np.hypot(u - near[0], v - near[1])
    white = np.median(light[(off > 70) & (off < 80)])
    dark = np.where((off < 65) & (light < 0.9 * white), white - light, 0.0)
    return np.array([(dark * u).sum(), (dark * v).sum()]) / dark.sum()


@pytest.mark.slow
@pytest.mark.render
@pytest.mark.parametrize("kind", ["auto", "ray"])
def test_what_is_projected_is_where_it_is_rendered(kind: str):
    data = scene()
    renderer = make_renderer(kind, data.model)
    for seed in range(6):
        view = true_camera(PumpWorld.sample(seed).camera, DRAWING).view(0.050, *DRAWING.aim(BLOCK, 0.050))
        expected = silhouette_middle(view)
        assert dark_middle(renderer.render(data, view), expected) == pytest.approx(expected, abs=0.1)


@pytest.mark.render
def test_both_renderers_give_nearly_the_same_light():
    data = scene()
    view = DRAWING.view(0.050, *DRAWING.aim(BLOCK, 0.050))
    first, second = (make_renderer(kind, data.model).render(data, view) for kind in ("auto", "ray"))
    assert np.abs(first - second).mean() < 0.01


@pytest.mark.render
@pytest.mark.render
def test_one_ray_is_enough_for_a_point_without_an_edge(monkeypatch: pytest.MonkeyPatch) -> None:
    data, view = scene(), DRAWING.view(0.050, *DRAWING.aim(BLOCK, 0.050))
    adaptive = make_renderer("ray", data.model).render(data, view)
    monkeypatch.setattr(
        "handeye.cell.raycasting._SMOOTH", -1.0
    )  # an edge everywhere: four samples in each point
    whole = make_renderer("ray", data.model).render(data, view)
    assert np.abs(adaptive - whole).max() < 1 / 64  # a quarter of a grey level


def test_collision_shapes_are_not_in_the_picture():
    data = scene()
    view = DRAWING.view(0.050, *DRAWING.aim(BLOCK, 0.050))
    light = make_renderer("ray", data.model).render(data, view)
    assert light[128, 166] < 0.3


@pytest.mark.render
def test_a_renderer_leaves_the_state_alone():
    data = scene()
    before = data.cam_xpos.copy(), data.geom_xpos.copy(), data.time
    make_renderer("auto", data.model).render(data, DRAWING.view(0.025, 0, 0.7))
    assert (data.geom_xpos == before[1]).all()
    assert data.time == before[2]
