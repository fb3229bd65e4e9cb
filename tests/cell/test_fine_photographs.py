"""Fine photographs: soft shadows, depth of field, a light of their own, and films that are the same each time."""

from collections import Counter
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import mujoco
import numpy as np
import pytest
from conftest import Command
from numpy.typing import NDArray

from handeye.cell import exposures
from handeye.cell.exposures import APERTURE, ExposurePlan, Lens, exposing, photographed, polish
from handeye.cell.film_stock import FILMS
from handeye.cell.opengl import OpenGlRenderer, context
from handeye.core.errors import InvalidInput
from handeye.core.pose import pose

SCENE = """
<mujoco>
  <statistic center="0 0 0" extent="1"/>
  <visual><headlight ambient=".2 .2 .2" diffuse="{lamp} {lamp} {lamp}"/></visual>
  <asset><material name="steel" rgba=".6 .6 .6 1" specular="0"/></asset>
  <custom><numeric name="gloss/steel" data=".9 .3"/>{studio}</custom>
  <worldbody>
    <light name="key" type="spot" pos="-1 0 2" dir=".4 0 -.9" diffuse="{lamp} {lamp} {lamp}" cutoff="60"/>
    <geom type="box" size="2 2 .05" pos="0 0 -.05" group="2" rgba=".5 .5 .5 1"/>
    <geom type="box" size=".03 .03 .1" pos="0 0 .1" group="2" material="steel"/>
    <geom type="box" size=".02 .02 .02" pos="-.9 .1 .1" group="2" rgba=".9 .1 .1 1"/>
    <camera name="front" pos=".9 -.9 .6" xyaxes="1 1 0 -.45 .45 1"/>
  </worldbody>
</mujoco>"""
STATED = '<numeric name="studio_lamp" data=".5 -1.0 2.0"/>'
SIZE = (64, 48)


@pytest.fixture(autouse=True)
def opengl() -> None:
    try:
        context()
    except InvalidInput:
        pytest.skip("there is no OpenGL here")


def scene(lamp: float = 0.5, studio: str = "") -> tuple[mujoco.MjModel, mujoco.MjData]:
    """A post on a floor, before a red box far behind; lit by a lamp so bright."""
    model = mujoco.MjModel.from_xml_string(SCENE.format(lamp=lamp, studio=studio))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def photo(how: ExposurePlan | None = None, lamp: float = 0.5, studio: str = "") -> NDArray[np.uint8]:
    width, height = SIZE
    return photographed(*scene(lamp, studio), camera="front", width=width, height=height, how=how)


def lens_at(distance: float) -> tuple[Lens, mujoco.MjvScene]:
    """A lens at the origin that looks along x, and is sharp at a distance (m)."""
    axes = {"eye": np.zeros(3), "forward": np.array([1.0, 0, 0]), "up": np.array([0.0, 0, 1])}
    made = Lens(**axes, slopes=(0.4, 0.3), size=SIZE, focus=distance)
    return made, mujoco.MjvScene(scene()[0], maxgeom=10)


def seen(scene: mujoco.MjvScene, place: tuple[float, float, float]) -> NDArray[np.float64]:
    """Where a place is in the picture: -1 to 1 to the right and up."""
    eye = scene.camera[0]
    forward, up, away = np.array(eye.forward), np.array(eye.up), np.subtract(place, eye.pos)
    x, y = (away @ axis / (away @ forward) * eye.frustum_near for axis in (np.cross(forward, up), up))
    middle, high = (eye.frustum_top + eye.frustum_bottom) / 2, (eye.frustum_top - eye.frustum_bottom) / 2
    return np.array([(x - eye.frustum_center) / eye.frustum_width, (y - middle) / high])


@pytest.mark.parametrize("film", FILMS)
def test_a_fine_photograph_is_the_same_each_time(film: str) -> None:
    how = ExposurePlan(exposures=2, film=film)
    assert (photo(how) == photo(how)).all()


@pytest.mark.slow
def test_its_light_is_not_that_of_the_world() -> None:
    assert (photo(ExposurePlan(exposures=2), lamp=0.2) == photo(ExposurePlan(exposures=2), lamp=0.8)).all()
    assert (photo(lamp=0.2) != photo(lamp=0.8)).any()


@pytest.mark.slow
def test_many_exposures_make_soft_edges() -> None:
    hard, soft = (
        np.abs(np.diff(photo(ExposurePlan(exposures=number)).astype(int), axis=1)).max() for number in (1, 24)
    )
    assert soft < 0.7 * hard


@pytest.mark.slow
def test_more_exposures_are_not_brighter() -> None:
    few, many = (photo(ExposurePlan(exposures=number)).mean() for number in (2, 12))
    assert few == pytest.approx(many, rel=0.05)


def test_lamp_and_sky_stand_elsewhere_in_each_exposure_and_light_the_middle() -> None:
    model, _ = scene()
    prepared, lighting = mujoco.MjvScene(model, maxgeom=10), FILMS["colour"].lighting
    places, skies, still = [], [], np.zeros(2)
    for at in ((1.0, 0.0), (-1.0, 0.0)):
        lighting.throw(prepared, model, np.array(at), 0.5 * np.array(at), still)
        lamp, sky, everywhere = prepared.lights[:3]
        places.append(lamp.pos.copy())
        skies.append(sky.dir.copy())
        assert np.linalg.norm(np.cross(lamp.dir, model.stat.center - lamp.pos)) < 1e-6
        assert (lamp.castshadow, sky.castshadow, lamp.headlight) == (1, 1, 0)
        assert not everywhere.castshadow
    assert np.linalg.norm(places[0] - places[1]) == pytest.approx(2 * lighting.radius, rel=1e-5)
    assert skies[0] - skies[1] == pytest.approx([-1.0, 0.0, 0.0])


def test_the_maps_of_shadows_move_between_exposures_and_the_lamp_does_not() -> None:
    model, _ = scene()
    prepared, lighting = mujoco.MjvScene(model, maxgeom=10), FILMS["colour"].lighting
    lamps, aims, skies = [], [], []
    for wander in ((0.5, -0.5), (-0.5, 0.5)):
        lighting.throw(prepared, model, np.zeros(2), np.zeros(2), np.array(wander))
        lamp, sky = prepared.lights[:2]
        lamps.append(lamp.pos.copy())
        aims.append(lamp.dir.copy())
        skies.append(np.concatenate([sky.pos, sky.dir]))
    assert (lamps[0] == lamps[1]).all()
    assert 0.02 < np.linalg.norm(aims[0] - aims[1]) < 0.1
    assert np.linalg.norm(skies[0][:2] - skies[1][:2]) > 0.05
    assert (skies[0][3:] == skies[1][3:]).all()


@pytest.mark.slow
def test_a_scene_that_states_a_lamp_is_lit_by_it_in_every_photograph() -> None:
    stated = [photo(lamp=lamp, studio=STATED) for lamp in (0.2, 0.8)]
    assert (stated[0] == stated[1]).all()
    assert stated[0].mean() > 1.3 * photo(lamp=0.2).mean()


def test_the_television_camera_does_not_see_the_lamp_that_a_scene_states() -> None:
    above: Any = SimpleNamespace(
        X_WC=pose(np.diag([1.0, -1.0, -1.0]), np.array([0.0, 0.0, 2.0])), focal=(400.0, 300.0)
    )
    (bare, data), (stated, _) = scene(), scene(studio=STATED)
    assert (
        OpenGlRenderer(bare).render(data, above).tobytes()
        == OpenGlRenderer(stated).render(data, above).tobytes()
    )


def test_metal_shines_and_what_nothing_is_told_of_does_not() -> None:
    model, data = scene()
    prepared = mujoco.MjvScene(model, maxgeom=10)
    every = int(mujoco.mjtCatBit.mjCAT_ALL)
    mujoco.mjv_updateScene(model, data, mujoco.MjvOption(), None, mujoco.MjvCamera(), every, prepared)
    before = [shape.specular for shape in prepared.geoms[: prepared.ngeom]]
    polish(prepared, model)
    steel = model.material("steel").id
    for shape, dull in zip(prepared.geoms[: prepared.ngeom], before, strict=True):
        assert (shape.specular > 0.5) == (shape.matid == steel)
        assert shape.matid == steel or shape.specular == dull


def test_the_film_of_1973_is_one_tone_of_grey_paper() -> None:
    red, green, blue = photo(ExposurePlan(exposures=1, film="1973")).reshape(-1, 3).T.astype(float)
    assert np.abs(np.stack([red / 1.0 - green / 0.985, red - blue / 0.945])).max() < 1.1
    assert red.min() > 0


def test_photographing_changes_neither_scene_nor_the_pictures_of_the_television_camera() -> None:
    model, data = scene()
    tape = [model.mat_specular, model.light_diffuse, model.geom_rgba, model.vis.headlight.diffuse]
    before = [values.copy() for values in tape]
    camera = OpenGlRenderer(model)
    above: Any = SimpleNamespace(
        X_WC=pose(np.diag([1.0, -1.0, -1.0]), np.array([0.0, 0.0, 2.0])), focal=(400.0, 300.0)
    )
    taken = camera.render(data, above)
    photographed(model, data, camera="front", width=64, height=48, how=ExposurePlan(exposures=2))
    assert (camera.render(data, above) == taken).all()
    assert all((values == old).all() for values, old in zip(tape, before, strict=True))


@pytest.mark.parametrize("at", [(1.0, 0.0), (0.0, -1.0), (0.5, 0.5)])
def test_what_is_in_focus_stays_where_it_is_and_what_is_behind_moves(at: tuple[float, float]) -> None:
    made, picture = lens_at(2.0)
    sharp, behind = (2.0, 0.3, -0.2), (4.0, 0.3, -0.2)
    made.aim(picture, np.zeros(2), np.zeros(2))
    middle = seen(picture, sharp), seen(picture, behind)
    made.aim(picture, np.array(at), np.zeros(2))
    moved = seen(picture, behind) - middle[1]
    assert np.allclose(seen(picture, sharp), middle[0], atol=1e-6)
    assert np.allclose(moved, APERTURE * (1 / 2.0 - 1 / 4.0) * np.array(at) / made.slopes, atol=1e-6)


def test_a_shift_is_counted_in_points_of_the_picture() -> None:
    made, picture = lens_at(2.0)
    made.aim(picture, np.zeros(2), np.zeros(2))
    still = seen(picture, (2.0, 0.1, 0.1))
    made.aim(picture, np.zeros(2), np.array([0.5, -0.5]))
    assert np.allclose(seen(picture, (2.0, 0.1, 0.1)) - still, np.array([-1.0, 1.0]) / SIZE, atol=1e-6)


def test_it_is_focused_on_what_is_in_the_middle() -> None:
    deep = np.full((48, 64), 1.0, dtype=np.float32)
    deep[20:28, 28:36] = (1 / exposures._NEAR - 1 / 1.5) / (
        1 / exposures._NEAR - 1 / exposures._FAR
    )  # 1.5 m away
    assert Lens.looked_at(deep) == pytest.approx(1.5, rel=1e-4)


def test_every_exposure_has_a_point_of_its_own_on_lens_lamp_and_sky() -> None:
    made = list(exposures._exposures(24))
    for name in ("lens", "lamp", "sky"):
        points = np.array([getattr(each, name) for each in made])
        assert len(Counter(map(tuple, points))) == 24
        assert np.linalg.norm(points, axis=1).max() <= 1
        assert np.linalg.norm(points.mean(axis=0)) < 0.03
    together = [each for each in made if (each.lens == each.lamp).all() or (each.lamp == each.sky).all()]
    assert len(together) <= 3


@pytest.mark.parametrize(
    ("asked", "made"),
    [
        ({"fine": False, "film": None, "exposures": None}, None),
        ({"fine": True, "film": None, "exposures": None}, ExposurePlan(exposures=48, film="colour")),
        ({"fine": False, "film": "1973", "exposures": None}, ExposurePlan(exposures=48, film="1973")),
        ({"fine": True, "film": 1973, "exposures": None}, ExposurePlan(exposures=48, film="1973")),
        ({"fine": False, "film": None, "exposures": 3}, ExposurePlan(exposures=3, film="colour")),
    ],
)
def test_film_and_exposures_are_of_fine_photographs(
    asked: dict[str, object], made: ExposurePlan | None
) -> None:
    assert exposing(**asked) == made  # type: ignore[arg-type]


@pytest.mark.parametrize("number", [0, 1001, 2.5])
def test_so_many_exposures_cannot_be(number: object) -> None:
    with pytest.raises(InvalidInput, match=r"^.* exposures are not possible; choose 1 to 1000$"):
        ExposurePlan(exposures=number)  # type: ignore[arg-type]


def test_there_is_no_such_film() -> None:
    with pytest.raises(InvalidInput, match=r"^there is no film `1974`; the films are colour, 1973$"):
        ExposurePlan(film="1974")


@pytest.mark.slow
def test_an_interrupted_photograph_leaves_no_file(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(Lens, "aim", interrupted)
    code, _, err = command("render", "-o", "it.png", "--fine", "--size", "64x48")
    assert (code, err) == (130, "\nhandeye: interrupted\n")
    assert not Path("it.png").exists()
