"""Forces of the simulation, and those that the hand feels, are what arithmetic says; docs/figures.md has them all."""

import importlib.util
from functools import cache
from pathlib import Path
from types import ModuleType

import numpy as np
import pressing_rigs
import pytest
import screw_rigs
from figures import as_recorded
from static_rigs import SLIDING, Force, pulled

from handeye.arm.dynamics import GRAVITY
from handeye.arm.friction import felt_friction
from handeye.arm.ik import solve
from handeye.arm.robots.stanford import STANFORD
from handeye.tasks.stanford_cell.dimensions import PARK
from handeye.tasks.water_pump.world.pump_world import PumpWorld

pytestmark = pytest.mark.slow

CLOSE = 0.02  # relative
STUCK = 0.04  # relative: friction of a head that has come to rest is a little below its limit
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


def stated(seed: int | None) -> dict[str, float]:
    """What joint friction can be felt as where the rigs stand, N and N m: what the hand feels may be off by as much."""
    friction = (PumpWorld.nominal() if seed is None else PumpWorld.sample(seed)).arm_build.friction
    postures = [solve(STANFORD, X_WT, PARK).q for X_WT in (pressing_rigs.NEAR, pressing_rigs.FAR)]
    felt = [np.abs(felt_friction(STANFORD, q, friction)).sum(axis=1) for q in postures if q is not None]
    most = np.max(felt, axis=0)
    return {"N": float(most[:3].max()), "N m": float(most[3:].max())}


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
    limits = stated(seed)
    assert [force for force in felt(seed) if misfelt(force) > limits[force.unit]] == []


def test_the_page_states_what_friction_is_felt_as_in_its_drawn_world() -> None:
    limits, page = stated(maker().SEED), (DOCS / "figures.md").read_text(encoding="utf-8")
    assert f"{limits['N']:.1f} N of force and {limits['N m']:.2f} N m of moment" in " ".join(page.split())


def test_without_errors_of_the_arm_the_hand_feels_to_half_a_percent() -> None:
    assert [force for force in felt(None) if misfelt(force) > (0.005 - CLOSE) * force.reckoned] == []


def test_the_page_is_what_the_rigs_show() -> None:
    there = (DOCS / "figures.md").read_text(encoding="utf-8")
    made = maker().tables(weights(), screws(), felt(None), felt(maker().SEED))
    assert as_recorded(maker().page(made), there) == there, "run: python docs/make_figures.py"
