"""FLATNESS: the base lies flat, or something lies under it, although the arm misreads heights."""

import re

import mujoco
import numpy as np
import pytest
from pump_bench import MACROS, SCRIPT, TAUGHT, Bench, at_standard, bench

from handeye.arm.converters import position_step
from handeye.arm.ik import solve
from handeye.arm.robots.stanford import STANFORD
from handeye.core.pose import Array, hand, planar, translated
from handeye.core.units import INCH
from handeye.core.variation import Overrides, WorldSpec
from handeye.tasks.water_pump import cell
from handeye.tasks.water_pump.scene import specification
from handeye.tasks.water_pump.world.pump_world import PumpWorld

SOUND = 8000883
"""A world of the high level. Compared with the height of the table at a place to which it reaches 1.8 in farther, the
arm misreads the height of the face at one hole by .033 in.
"""
CARD = 1.2e-3
CHIP = 1.5e-3
"""Thickness of a card and of a chip, m."""
PRESSED = re.findall(r"PRESS +(FACE\d) (TABLEL?) UNEVEN", SCRIPT)
"""Each hole where the face is felt, and the place of the table with which it is compared."""
SHOULDER = STANFORD.X_WB[:2, 3]


def at(name: str, *, down: float = 0.0) -> Array:
    """`X_WT` of a place taught on the pump, or of a place below it (in)."""
    X_WT = planar(*TAUGHT.parts["PUMP"].at) @ hand(*TAUGHT.positions[name].at)
    return translated(X_WT, (0.0, 0.0, -down * INCH))


def reach(name: str) -> float:
    """Distance (in) of a taught place from the column of the arm."""
    return float(np.hypot(*(at(name)[:2, 3] - SHOULDER))) / INCH


def test_the_arm_reaches_as_far_to_the_table_as_to_the_holes_compared_with_it() -> None:
    """Its error in height depends on how far it reaches."""
    assert len(PRESSED) == 4
    for beside in ("TABLEL", "TABLE"):
        holes = [reach(hole) for hole, table in PRESSED if table == beside]
        assert np.mean(holes) == pytest.approx(reach(beside), abs=0.25)


def test_a_second_touch_lies_half_a_step_of_the_shoulders_converter_farther_out() -> None:
    """In the same place, the converter would mislead the arm by as much again."""
    (step,) = {float(found) for found in re.findall(r"SEARCH +(\S+) ALONG 90 STEPS 1", SCRIPT)}
    for hole, _ in PRESSED:
        X_WT = at(hole, down=0.4)
        here = solve(STANFORD, X_WT, STANFORD.middle).q
        assert here is not None
        there = solve(STANFORD, translated(X_WT, (0.0, step * INCH, 0.0)), here).q
        assert there is not None
        assert abs(there - here)[1] / position_step(STANFORD)[1] == pytest.approx(0.5, abs=0.1)


def felt(world: PumpWorld | None = None, *, high: float = 0.0) -> Bench:
    """The program feels whether the base lies flat; the base stands so high (m) on what lies under it."""
    lay = at_standard()
    lay["base"] = translated(lay["base"], (0.0, 0.0, high))
    return bench(f'{MACROS}STAGE "flat"\n        FLATNESS\n', world=world, lay=lay).go()


@pytest.mark.slow
def test_in_a_world_of_large_errors_a_flat_base_passes() -> None:
    world = PumpWorld.draw(WorldSpec(seed=SOUND, level="high", overrides=Overrides(without=("fixtures",))))
    assert felt(world).finished


@pytest.mark.slow
@pytest.mark.parametrize(
    ("x0", "x1", "y0", "y1", "thick"),
    [
        pytest.param(26.2, 27.3, 38.9, 40.0, CHIP, id="chip under a corner"),
        pytest.param(20.8, 30.3, 35.5, 40.4, CARD, id="card that sticks out to one side"),
    ],
)
def test_what_lies_under_the_base_is_noticed(
    monkeypatch: pytest.MonkeyPatch, x0: float, x1: float, y0: float, y1: float, thick: float
) -> None:
    def build(world: PumpWorld) -> mujoco.MjModel:
        spec = specification(world)
        card = spec.worldbody.add_geom(
            spec.find_default("solid"), name="card", type=spec.geom("block_far").type
        )
        card.pos[:] = (x0 + x1) / 2 * INCH, (y0 + y1) / 2 * INCH, thick / 2
        card.size[:] = (x1 - x0) / 2 * INCH, (y1 - y0) / 2 * INCH, thick / 2
        return spec.compile()

    monkeypatch.setattr(cell, "build", build)
    run = felt(high=thick)
    assert run.told.startswith("THE BASE DOES NOT LIE FLAT")
