"""Where the program searches for the pins with the gasket, compared with where the errors of worlds put the pins. This
is a calculation, without physics.
"""

import json
import tomllib
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from handeye.arm.ik import solve
from handeye.arm.kinematics import forward
from handeye.arm.robots.stanford import STANFORD
from handeye.core.pose import Array, Pose, hand, planar
from handeye.core.units import INCH
from handeye.core.variation import WorldSpec
from handeye.tasks.stanford_cell.dimensions import PARK, dimensions, screw_holes, standard, web_centre
from handeye.tasks.water_pump.world.pump_world import PumpWorld
from handeye.tasks.water_pump.world.stations import Station

WORLDS = 200
PLANS = Path(__file__).parents[3] / "plans"
CATCH = (
    dimensions()("gasket.screw_hole_radius")
    - dimensions()("pin.body_radius")
    + dimensions()("pin.body_bevel")
)


@cache
def joints(position: str) -> Array:
    """The joints at a taught position of the pump in its standard place, or of the table (rad, m)."""
    taught = tomllib.loads((PLANS / "water_pump.toml").read_text(encoding="utf-8"))["positions"][position]
    X = hand(*np.array(taught["at"][:3]) * INCH, *np.radians(taught["at"][3:]))
    found = solve(STANFORD, standard() @ X if "of" in taught else X, PARK).q
    assert found is not None
    return found


def arrived(world: PumpWorld, position: str) -> Pose:
    """Where the hand really is when the arm reads that it is at the position."""
    return forward(STANFORD, world.arm.positions(joints(position)))


def pins_aside(world: PumpWorld) -> tuple[float, float]:
    """How far along y (in) the hand must carry the gasket from GON, so that the middle of its two holes comes to the
    middle of the pins; and how far from Q1, as the arm reads it, the first pin stands (Y1)."""
    d = dimensions()
    far, left = d.all("blocks.far"), d.all("blocks.left")
    X_WB = world.fixtures[Station.BLOCKS].about(left[2], far[1]) @ standard()
    (x, y), high = d.all("gasket_stand.grasp"), d("gasket_stand.height")
    origin = (x + web_centre(), y, high)
    X_WG = (
        world.fixtures[Station.GASKET_STAND].about(x, y)
        @ world.parts["gasket"].about(*origin)
        @ planar(*origin, standard_yaw())
    )
    X_HG = np.linalg.inv(arrived(world, "G")) @ X_WG
    laid = arrived(world, "GON") @ X_HG
    holes = [screw_holes()[int(k)] for k in d.all("base.screw_holes.pinned")]
    middle = planar(*np.mean(holes, axis=0), 0.0, 0.0)
    pin = (X_WB @ planar(*holes[0], 0.0, 0.0) - arrived(world, "Q1"))[1, 3]
    return (X_WB @ middle - laid @ middle)[1, 3] / INCH, pin / INCH


def standard_yaw() -> float:
    return float(dimensions()("standard.yaw"))


@cache
def needs(level: str) -> Array:
    """Both figures of `pins_aside` in each world, shape (WORLDS, 2), in."""
    worlds = (PumpWorld.draw(WorldSpec(seed=seed, level=level)) for seed in range(WORLDS))
    return np.array([pins_aside(world) for world in worlds])


@cache
def steps() -> list[dict[str, Any]]:
    return json.loads((PLANS / "water_pump.plan.json").read_bytes())["program"]["steps"]  # type: ignore[no-any-return]


def places() -> Iterator[tuple[int, dict[str, Any]]]:
    """The motions with the gasket to a place of a search for the pins, with their numbers."""
    for number, step in enumerate(steps()):
        do = step["operation"]
        if do["op"] == "move" and do["goal"] == "GON" and do.get("searching"):
            yield number, do


def lines() -> Iterator[tuple[float, set[str]]]:
    """Of each search along y, how far it reaches to either side (in), and what shifts its places."""
    for number, do in places():
        search = next(
            step["operation"] for step in steps()[number::-1] if step["operation"]["op"] == "search"
        )
        if search.get("along"):
            shifts = {shift["name"] for shift in do["restore"]}
            yield (search["limit"] - 1) / 2 * search["step"] / INCH, shifts


@pytest.mark.slow
def test_the_first_pin_is_a_worse_guide_than_the_place_where_the_gasket_lay() -> None:
    aside, pin = needs("high").T
    assert np.std(aside) < 0.085 < np.std(aside - pin)
    assert not any({"Y1", "E1"} & shifts for _, shifts in lines())


@pytest.mark.slow
@pytest.mark.parametrize(("level", "choose"), [("nominal", min), ("high", max)])
def test_the_lines_of_the_search_reach_three_sigma(
    level: str, choose: Callable[[list[float]], float]
) -> None:
    """In nominal worlds the first line does, and at the high level the longer lines. The bevels of both pins guide the
    holes over them, even if the gasket is turned by half a degree."""
    spread = np.std(needs(level)[:, 0])
    half = np.hypot(*np.subtract(*(screw_holes()[k] for k in (1, 4)))) / 2
    catch = (CATCH - half * np.radians(0.5)) / INCH
    assert 3 * spread < choose([reach for reach, _ in lines()]) + catch


def test_at_each_place_the_program_asks_whether_the_gasket_met_anything() -> None:
    for number, _ in places():
        down = next(k for k in range(number, len(steps())) if steps()[k]["text"].startswith("CHANGE"))
        assert steps()[down + 1]["text"].split() == ["SKIPN", "23"]
