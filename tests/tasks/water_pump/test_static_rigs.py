"""Forces of the simulation, and those that the hand feels, are what arithmetic says; docs/figures.md has them all."""

import importlib.util
from functools import cache
from pathlib import Path
from types import ModuleType

import pytest
import screw_rigs
from figures import as_recorded
from static_rigs import SLIDING, Force, pulled

from handeye.arm.dynamics import GRAVITY
from handeye.tasks.water_pump.pump_world import PumpWorld
from handeye.units import OUNCE_INCH

pytestmark = pytest.mark.slow

CLOSE = 0.02  # relative
STUCK = 0.04  # relative: friction of a head that has come to rest is a little below its limit
FALSE_FORCE, FALSE_MOMENT = 0.2, 17 * OUNCE_INCH
"""What the joint friction of world 1 is felt as, N and N m."""
DOCS = Path(__file__).parents[3] / "docs"


@cache
def maker() -> ModuleType:
    """The program that writes the page."""
    spec = importlib.util.spec_from_file_location("make_figures", DOCS / "make_figures.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@cache
def weights() -> list[Force]:
    return maker().weights()


@cache
def screws() -> list[Force]:
    return maker().screws()


@cache
def felt(seed: int | None) -> list[Force]:
    return maker().felt(PumpWorld.nominal() if seed is None else PumpWorld.sample(seed))


def wrong(forces: list[Force], limit: float) -> list[Force]:
    return [force for force in forces if abs(force.off) > limit]


def misfelt(force: Force) -> float:
    """By how much the hand is mistaken, beyond what arithmetic leaves open (N, N m)."""
    assert force.felt is not None
    return abs(force.felt - force.reckoned) - CLOSE * force.reckoned


def test_weights_levers_and_springs_press_as_reckoned() -> None:
    assert wrong(weights(), CLOSE) == []


def test_friction_holds_until_its_limit_and_no_further() -> None:
    limit = SLIDING * 2 * GRAVITY
    assert abs(pulled(0.98 * limit)) < 1e-4
    assert pulled(1.02 * limit) == pytest.approx(0.02 * limit / 2 * 0.5, rel=0.1)


def test_a_screw_clamps_as_its_torque_and_friction_say() -> None:
    assert wrong(screws(), STUCK) == []


def test_a_plane_ring_under_the_head_would_clamp_nearly_twice_as_hard() -> None:
    assert screw_rigs.textbook(0.28) == pytest.approx(157, abs=0.5)
    assert screws()[-1].simulated < 0.6 * screw_rigs.textbook(0.28)


@pytest.mark.parametrize("seed", [None, 1], ids=["nominal", "seed 1"])
def test_the_hand_presses_as_the_spring_says(seed: int | None) -> None:
    assert wrong(felt(seed), CLOSE) == []


@pytest.mark.parametrize("seed", [None, 1], ids=["nominal", "seed 1"])
def test_the_hand_feels_what_it_presses_with(seed: int | None) -> None:
    stated = {"N": FALSE_FORCE, "N m": FALSE_MOMENT}
    assert [force for force in felt(seed) if misfelt(force) > stated[force.unit]] == []


def test_without_errors_of_the_arm_the_hand_feels_to_half_a_percent() -> None:
    assert [force for force in felt(None) if misfelt(force) > (0.005 - CLOSE) * force.reckoned] == []


def test_the_page_is_what_the_rigs_show() -> None:
    there = (DOCS / "figures.md").read_text(encoding="utf-8")
    made = maker().tables(weights(), screws(), felt(None), felt(maker().SEED))
    assert as_recorded(maker().page(made), there) == there, "run: python docs/make_figures.py"
