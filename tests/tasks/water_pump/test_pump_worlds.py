"""The worlds drawn from seeds, and whether their errors are as large as they say."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace as replaced

from handeye.arm.ik import solve
from handeye.arm.kinematics import forward
from handeye.arm.robots.stanford import STANFORD
from handeye.core.pose import Array, hand
from handeye.core.units import DEGREE, INCH
from handeye.core.variation import LARGEST_SEED, Level, Overrides, WorldSpec
from handeye.judge.measured import SettledState, tilt
from handeye.tasks.water_pump.cell import build_cell
from handeye.tasks.water_pump.referee.measure import deepest
from handeye.tasks.water_pump.scene import build
from handeye.tasks.water_pump.world.pump_world import Placing, PumpWorld
from handeye.tasks.water_pump.world.variation import BELT_X, BELT_Y, DRILLED, STOOD, variation

NEAR = np.array([-25.0, 105.0, 0.0, 0.0, 75.0, 20.0]) * DEGREE + np.array([0, 0, 31 * INCH, 0, 0, 0])


def later(seed: int) -> WorldSpec:
    """The world of a seed, its pump with seven screws."""
    return WorldSpec(seed=seed, overrides=Overrides(set={"pump.screws": 7.0}))


@cache
def work_area() -> Array:
    """Joint positions with the hand pointing down at places all over the work area, shape (n, 6)."""
    places = [(x, y, z) for x in (8, 16, 24, 32, 40, 46) for y in (28, 34, 40, 46) for z in (1, 4, 8)]
    found = (
        solve(STANFORD, hand(x * INCH, y * INCH, z * INCH, np.pi / 2, np.pi / 2, 0.0), NEAR)
        for x, y, z in places
    )
    return np.array([result.q for result in found if result.q is not None])


@cache
def hand_errors(worlds: int = 150) -> Array:
    """Distance between where the controller thinks the hand is and where it is, in, shape (worlds, n)."""
    q = work_area()
    true = forward(STANFORD, q)[:, :3, 3]
    readings = [PumpWorld.sample(seed).arm.readings(q) for seed in range(worlds)]
    return np.array([np.linalg.norm(forward(STANFORD, r)[:, :3, 3] - true, axis=1) for r in readings]) / INCH


def test_the_hand_is_wrong_by_a_sixteenth_of_an_inch_in_the_median() -> None:
    assert np.median(hand_errors()) == pytest.approx(0.060, abs=0.010)


def test_ninety_five_percent_of_hand_errors_stay_under_an_eighth() -> None:
    assert 0.09 < np.percentile(hand_errors(), 95) < 0.125


def test_equal_seeds_give_equal_worlds() -> None:
    assert repr(PumpWorld.sample(7)) == repr(PumpWorld.sample(7))


def test_different_seeds_give_different_worlds() -> None:
    assert PumpWorld.sample(7).base != PumpWorld.sample(8).base


def test_readings_and_positions_are_inverse() -> None:
    arm, q = PumpWorld.sample(3).arm, work_area()
    assert np.abs(arm.positions(arm.readings(q)) - q).max() < 1e-12


def test_the_nominal_world_reads_true() -> None:
    q = work_area()
    assert np.array_equal(PumpWorld.nominal().arm.readings(q), q)


def test_every_base_lies_within_the_pick_up_area() -> None:
    bases = [PumpWorld.sample(seed).base for seed in range(100)]
    assert all(
        BELT_X[0] <= base.x / INCH <= BELT_X[1] and BELT_Y[0] <= base.y / INCH <= BELT_Y[1] for base in bases
    )
    assert all(abs(base.yaw - np.pi / 2) <= 30 * DEGREE for base in bases)


def test_noise_streams_of_a_world_are_independent() -> None:
    world = PumpWorld.sample(1)
    assert world.generator("sensors").random() != world.generator("camera").random()


@pytest.mark.parametrize("seed", [0, 7_000_000, 20261126, 1_795_000_000, LARGEST_SEED])
def test_seeds_are_random_numbers_and_every_pump_has_six_screws_unless_it_is_set(seed: int) -> None:
    assert (PumpWorld.sample(seed).screws, PumpWorld.draw(later(seed)).screws) == (6, 7)


@given(st.integers(0, LARGEST_SEED), st.sampled_from(["low", "nominal", "high"]))
def test_a_seventh_screw_moves_no_other_draw(seed: int, level: Level) -> None:
    six = variation().draw(WorldSpec(seed=seed, level=level)).values
    seven = variation().draw(replaced(later(seed), level=level)).values
    assert {name for name in six if six[name] != seven[name]} == {"pump.screws"}


def test_a_pump_with_seven_screws_has_one_more_hole_and_thread() -> None:
    more = variation().draw(later(0)).values.keys() - variation().draw(WorldSpec(seed=0)).values.keys()
    holes = {f"holes.{part}.7.{axis}" for part in DRILLED for axis in "xy"}
    assert more == {*holes, "thread_phase.7", "parts.screws.7.x", "parts.screws.7.y"}


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 7_000_000])
def test_every_quantity_reaches_the_world(seed: int) -> None:
    before = PumpWorld.draw(later(seed))
    for name, quantity in variation().quantities.items():
        value = 6.0 if name == "pump.screws" else 0.5 * quantity.measure.size
        moved = PumpWorld.draw(
            WorldSpec(seed=seed, overrides=Overrides(set={"pump.screws": 7.0, name: value}))
        )
        unlike = repr(replace(moved, drawn=before.drawn))
        assert unlike != repr(before), name


def test_no_error_shares_its_name_with_a_sense() -> None:
    first = {name.split(".")[0] for name in variation().quantities}
    assert not first & {"sight", "vision", "touch", "force", "search"}


@pytest.mark.slow
@pytest.mark.parametrize("level", ["nominal", "high"])
def test_no_part_starts_in_another(level: Level) -> None:
    for seed in range(3):
        truth = build_cell(PumpWorld.draw(WorldSpec(seed=seed, level=level)), camera="ray").truth
        assert max(overlap.depth for overlap in deepest(SettledState(truth))) < 1e-6


def test_a_person_puts_gasket_and_top_down_within_three_hundredths_and_a_degree() -> None:
    found = [PumpWorld.sample(seed).parts[part] for seed in range(100) for part in STOOD]
    places = np.array([(part.x / INCH, part.y / INCH, part.yaw / DEGREE) for part in found])
    assert np.abs(places).max(axis=0) == pytest.approx((0.03, 0.03, 1.0), rel=0.05)


def test_a_placing_turns_a_thing_about_its_point_and_tilts_it() -> None:
    error = Placing(x=0.001, z=0.002, yaw=0.01, pitch=0.003, roll=-0.004)
    X = error.about(0.5, 0.3)
    assert pytest.approx((0.501, 0.3, 0.002, 1.0)) == X @ (0.5, 0.3, 0.0, 1.0)
    assert tilt(X) == pytest.approx(0.005, rel=1e-3)


def test_high_errors_keep_masses_frictions_and_forces_positive() -> None:
    for seed in range(50):
        world = PumpWorld.draw(WorldSpec(seed=seed, level="high"))
        scales = [
            *world.arm_build.link_mass,
            *world.friction.values(),
            *world.hand.switch_force,
            world.part_mass,
        ]
        assert min(scales) > 0
        assert world.arm_build.friction.min() >= 0


def test_without_the_arm_the_hand_is_where_the_controller_thinks() -> None:
    world = PumpWorld.draw(WorldSpec(seed=3, overrides=Overrides(without=("arm",))))
    q = work_area()
    assert np.array_equal(world.arm.readings(q), q)
    assert world.arm_build.friction == pytest.approx(STANFORD.compliance.friction)


def test_every_quantity_says_where_its_figures_come_from() -> None:
    assert [name for name, q in variation().quantities.items() if not q.source.endswith((".", '".'))] == []


@pytest.mark.slow
@pytest.mark.parametrize("seed", [910033, 910118, 910152])
def test_a_flat_link_of_any_mass_makes_a_scene(seed: int) -> None:
    assert build(PumpWorld.sample(seed)).nv > 0
