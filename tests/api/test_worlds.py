"""Worlds are chosen in the units of `handeye world`, and a mistake is told with the nearest name."""

from pathlib import Path

import mujoco
import pytest

import handeye
from handeye.core.errors import InvalidInput
from handeye.core.variation import Overrides, WorldSpec


def test_a_world_is_recorded_in_si_units() -> None:
    world = handeye.World(seed=3, level="high", without=["arm.offset"], set={"camera.place.x": 0.3})
    wanted = Overrides(without=("arm.offset",), set={"camera.place.x": pytest.approx(0.3 * 0.0254)})
    assert world.spec == WorldSpec(seed=3, level="high", overrides=wanted)


def test_values_are_in_their_own_units() -> None:
    world = handeye.World(set={"camera.place.x": ".3in", "camera.place.y": "1 mm"})
    assert (world["camera.place.x"], world["camera.place.y"]) == (pytest.approx(0.3), pytest.approx(1 / 25.4))
    assert (world.unit("camera.place.x"), world.values["camera.place.x"]) == ("in", pytest.approx(0.3))


def test_the_tasks_of_all_systems_have_worlds() -> None:
    world = handeye.World(seed=3, task="chess", set={"beams.height": "1 mm"})
    assert (world.task, world["beams.height"], world.unit("beams.height")) == ("chess", 1.0, "mm")
    with pytest.raises(InvalidInput, match="the task `chess` exports no scene"):
        world.export("x")


def test_nobody_changes_the_values_of_a_world() -> None:
    with pytest.raises(TypeError, match="does not support item assignment"):
        handeye.World().values["camera.place.x"] = 7.0


def test_equal_worlds_are_equal() -> None:
    assert handeye.World(3, without="camera") == handeye.World(3, without=["camera"])
    assert handeye.World(3) != handeye.World(4)
    assert len({handeye.World(3), handeye.World(3), handeye.World(4)}) == 2


def test_a_world_shows_how_it_was_chosen() -> None:
    said = "World(seed=3, level='low', without=['camera'], set={'arm.friction': 0})"
    assert repr(handeye.World(3, level="low", without="camera", set={"arm.friction": 0})) == said


def test_the_page_of_a_world_has_a_row_a_quantity() -> None:
    world = handeye.World(3, set={"arm.friction": 0})
    page = world._repr_html_()
    assert page.count("<tr>") == 1 + len(world.values)
    assert page.count(">set<") == 6


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ({"level": ["high"]}, r"^there is no level \['high'\]; the levels are "),
        ({"level": "hihg"}, r"^there is no level 'hihg'; the levels are low, nominal, high$"),
        (
            {"without": ["arm.ofset"]},
            r"^the world has no quantity `arm\.ofset`; did you mean `arm\.offset`\?$",
        ),
        ({"without": [3]}, r"^`without` takes names, not 3$"),
        (
            {"set": {"arm.fricton": 0}},
            r"^the world has no quantity `arm\.fricton`; did you mean `arm\.friction`\?$",
        ),
        ({"set": {"camera.place.x": "3 oz"}}, r"^camera\.place\.x is not measured in `oz`; known: "),
        ({"set": {"arm.friction": -1}}, r"^arm\.friction\.1 cannot be `-1`"),
        ({"set": {"arm.friction": None}}, r"^arm\.friction\.1 cannot be `None`, which is not a number$"),
        (
            {"set": ["arm.friction"]},
            r"^`set` must be a dictionary from names of quantities to values, not ",
        ),
    ],
)
def test_what_is_no_world_is_told_in_one_sentence(words: dict[str, object], sentence: str) -> None:
    with pytest.raises(InvalidInput, match=sentence):
        handeye.World(3, **words)


def test_a_quantity_is_found_by_its_whole_name() -> None:
    with pytest.raises(InvalidInput, match=r"did you mean `arm\.offset"):
        handeye.World()["arm.offest.3"]
    with pytest.raises(InvalidInput, match=r"^give a quantity by its name, not by 3$"):
        handeye.World()[3]
    with pytest.raises(InvalidInput, match=r"^`arm\.offset` is a group of quantities: arm\.offset\.1, "):
        handeye.World()["arm.offset"]


def test_a_world_says_what_its_quantities_are() -> None:
    world = handeye.World(3)
    screws, first = world.quantities[:2]
    assert (screws.name, screws.value, screws.distribution) == ("pump.screws", 6.0, "choice")
    assert (first.name, first.value, first.unit) == ("base.x", world["base.x"], "in")
    assert first.source.startswith("Position of the pump base on the belt")
    assert [each.name for each in world.quantities] == [*world.values]


def test_a_world_of_a_pump_with_seven_screws_has_the_quantities_of_the_seventh() -> None:
    seven = handeye.World(
        2**53 - 1, set={"pump.screws": 7, "holes.top.7.x": ".001 in"}, faults=["screw.7.missing"]
    )
    assert (seven["pump.screws"], seven["holes.top.7.x"], len(seven.values)) == (
        7.0,
        0.001,
        len(handeye.World().values) + 9,
    )
    with pytest.raises(
        InvalidInput,
        match=r"^the world has the quantity `holes\.top\.7\.x` only if pump\.screws is set to 7$",
    ):
        handeye.World()["holes.top.7.x"]


@pytest.mark.slow
def test_a_world_is_exported_as_it_is_drawn(tmp_path: Path) -> None:
    world = handeye.World(seed=3)
    scene = world.export(tmp_path / "scene")
    assert (scene.moment, scene.format, scene.world) == ("drawn", "mjcf", world.spec)
    assert mujoco.MjModel.from_xml_path(f"{scene.path}/scene.xml").nkey == 1
    solids = world.export(tmp_path / "pump.glb", part="pump")
    assert {each.body for each in solids.weights if abs(each.by_volume / each.in_model - 1) > 0.01} == {
        "rotor"
    }
    assert (solids.solids, solids.open, {each.body for each in solids.weights} >= {"gasket"}) == (
        16,
        (),
        True,
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "part", "sentence"),
    [
        ("scene", "pump", r"^a part must be exported to a file whose name ends in \.glb, not to .*scene$"),
        ("pump.glb", "motor", r"^there is no part `motor` to export; known: `cell`, `pump`$"),
        (
            3,
            None,
            r"^the destination of an export must be a folder, or a file whose name ends in \.glb, not 3$",
        ),
    ],
)
def test_what_cannot_be_exported_is_told_in_one_sentence(
    tmp_path: Path, name: str | int, part: str | None, sentence: str
) -> None:
    with pytest.raises(InvalidInput, match=sentence):
        handeye.World(seed=3).export(tmp_path / name if isinstance(name, str) else name, part=part)
    assert [*tmp_path.iterdir()] == []


def test_a_world_has_faults_by_name_size_and_the_number_of_a_stage() -> None:
    world = handeye.World(3, faults=["lamp.dead", "gap_potentiometer.off=1mm@2"])
    assert [(fault.name, fault.value, fault.stage) for fault in world.spec.faults] == [
        ("gap_potentiometer.off", 0.001, 2),
        ("lamp.dead", None, None),
    ]
    assert repr(world) == "World(seed=3, faults=['lamp.dead', 'gap_potentiometer.off=1mm@2'])"
    assert world != handeye.World(3)


def test_a_fault_that_there_is_not_is_refused_with_the_nearest() -> None:
    with pytest.raises(InvalidInput, match=r"^there is no fault `lamp.daed`; did you mean `lamp.dead`\?$"):
        handeye.World(faults="lamp.daed")
