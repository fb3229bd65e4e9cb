"""What was taught for the pump agrees with the drawing of the cell."""

import numpy as np
import pytest

from handeye.core.pose import planar
from handeye.core.resources import plans
from handeye.program.program import Part
from handeye.program.taught import load_taught
from handeye.tasks.stanford_cell.dimensions import (
    base_top,
    dimensions,
    dispenser_places,
    screw_holes,
    standard,
)

TAUGHT = load_taught(plans() / "water_pump.toml")


@pytest.mark.parametrize("name", ["BASE", "PUMP"])
def test_the_base_has_the_holes_and_the_height_of_the_drawing(name: str) -> None:
    part: Part = TAUGHT.parts[name]
    d = dimensions()
    drawn = [
        (0.0, d("base.large_hole_1.diameter")),
        (d("base.large_hole_2.x"), d("base.large_hole_2.diameter")),
    ]
    assert np.array([(hole.x, hole.diameter) for hole in part.holes]) == pytest.approx(np.array(drawn))
    assert part.face == pytest.approx(base_top())


def test_the_pump_is_planned_in_the_standard_position() -> None:
    assert planar(*TAUGHT.parts["PUMP"].at) == pytest.approx(standard(), abs=1e-9)


def test_the_base_has_the_screw_holes_of_the_drawing() -> None:
    taught = [(hole.x, hole.y) for hole in TAUGHT.parts["BASE"].screw_holes]
    assert np.array(taught) == pytest.approx(np.array(screw_holes()), abs=1e-5)


@pytest.mark.parametrize("hole", range(6))
def test_each_screw_is_taken_to_its_hole(hole: int) -> None:
    assert TAUGHT.positions[f"H{hole}"].at[:2] == pytest.approx(screw_holes()[hole], abs=1e-5)


@pytest.mark.parametrize(("pin", "hole"), list(enumerate(dimensions().all("base.screw_holes.pinned"), 1)))
def test_each_pin_is_taken_to_its_hole(pin: int, hole: float) -> None:
    for name in (f"T{pin}", f"Q{pin}"):
        assert TAUGHT.positions[name].at[:2] == pytest.approx(screw_holes()[int(hole)], abs=1e-5)


@pytest.mark.parametrize("screw", range(6))
def test_each_screw_is_fetched_from_its_place_in_the_dispenser(screw: int) -> None:
    assert TAUGHT.positions[f"S{screw + 1}"].at[:2] == pytest.approx(dispenser_places()[screw][:2], abs=1e-6)
