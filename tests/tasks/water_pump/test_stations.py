"""A new station is one entry of the drawing: scene, world and planner take it from there."""

from collections.abc import Iterator

import mujoco
import numpy as np
import pytest

from handeye.al import compile_text
from handeye.core.errors import InvalidInput
from handeye.core.resources import plans, scenes
from handeye.core.source import Source
from handeye.core.units import INCH
from handeye.core.variation import Overrides, WorldSpec
from handeye.planning.planner import make_plan
from handeye.program.diagnosis.plan_findings import RunsInto
from handeye.program.taught import Taught
from handeye.runs.scripts import taught
from handeye.tasks import task
from handeye.tasks.stanford_cell.dimensions import Dimensions, Point, parse
from handeye.tasks.water_pump.world import stations, variation

ENTRY = """
[stations.tool_tray]
boxes = { value = [10, 40, 0, 14, 44, 1, 10, 44, 0, 14, 45, 5], unit = "in", source = "chosen: for this test" }
"""
THROUGH = "TRANS OVER [12 48 3 90 90 0]\nTRANS BESIDE [12 41 3 90 90 0]\nMOVE OVER\nMOVE BESIDE DIRECT\n"


def drawn(entry: str) -> Dimensions:
    return parse((scenes() / "water_pump" / "dimensions.toml").read_text(encoding="utf-8") + entry)


@pytest.fixture
def tray(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """The drawing with one more entry."""
    monkeypatch.setattr(stations, "dimensions", lambda: drawn(ENTRY))
    variation.variation.cache_clear()
    yield
    variation.variation.cache_clear()


def middle(model: mujoco.MjModel, body: str) -> Point:
    """Where the boxes of a body are, on the table."""
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    places = data.geom_xpos[model.geom_bodyid == model.body(body).id]
    return float(places[:, 0].mean()), float(places[:, 1].mean())


@pytest.mark.slow
@pytest.mark.usefixtures("tray")
def test_a_new_station_stands_in_the_scene_with_an_error_of_its_own() -> None:
    moved = Overrides(set={"fixtures.tool_tray.x": 0.1 * INCH}, without=("fixtures",))
    there = middle(task().scene(WorldSpec(seed=3, overrides=Overrides(without=("fixtures",)))), "tool_tray")
    shifted = middle(task().scene(WorldSpec(seed=3, overrides=moved)), "tool_tray")
    assert there == pytest.approx((12 * INCH, (42 + 44.5) / 2 * INCH), abs=1e-9)
    assert np.subtract(shifted, there) == pytest.approx([0.1 * INCH, 0.0], abs=1e-9)


def test_a_new_station_moves_no_other_quantity(monkeypatch: pytest.MonkeyPatch) -> None:
    before = task().variation().draw(WorldSpec(seed=3)).values
    monkeypatch.setattr(stations, "dimensions", lambda: drawn(ENTRY))
    variation.variation.cache_clear()
    after = task().variation().draw(WorldSpec(seed=3)).values
    variation.variation.cache_clear()
    assert {name: after[name] for name in before} == before
    assert set(after) - set(before) == {
        f"fixtures.tool_tray.{axis}" for axis in ("x", "y", "z", "yaw", "pitch", "roll")
    }


@pytest.mark.usefixtures("tray")
def test_the_planner_keeps_clear_of_a_new_station() -> None:
    known: Taught = taught(plans() / "water_pump.al")
    program, _ = compile_text(Source(name="through.al", text=THROUGH), known)
    assert program is not None
    _, findings = make_plan(program, task().arm, task="water_pump")
    assert "TOOL_TRAY" in {finding.fixture for finding in findings if isinstance(finding, RunsInto)}


def test_without_the_entry_nothing_is_in_the_way() -> None:
    program, _ = compile_text(Source(name="through.al", text=THROUGH), taught(plans() / "water_pump.al"))
    assert program is not None
    assert not [
        problem
        for problem in make_plan(program, task().arm, task="water_pump")[1]
        if isinstance(problem, RunsInto)
    ]


@pytest.mark.parametrize("value", ["[1, 2, 3]", "[1, 1, 1, 0, 2, 2]"])
def test_boxes_that_are_none_are_refused(value: str, monkeypatch: pytest.MonkeyPatch) -> None:
    entry = f'[stations.tray]\nboxes = {{ value = {value}, unit = "in", source = "none" }}\n'
    monkeypatch.setattr(stations, "dimensions", lambda: drawn(entry))
    with pytest.raises(InvalidInput, match=r"^the dimension `stations.tray.boxes` must be a list of boxes, "):
        stations.stations()
