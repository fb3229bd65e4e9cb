"""The last stage pushes the pump back to its blocks, also if the screwdriver has turned it away from them, and calls the
operator if the pump ends at another place than before.
"""

from dataclasses import replace

import numpy as np
import pytest
from pump_bench import MACROS, Bench, bench, stacked

from handeye.core.pose import Pose
from handeye.core.units import INCH
from handeye.tasks.water_pump.referee.findings import judge
from handeye.tasks.water_pump.world.pump_world import Placing, PumpWorld
from handeye.tasks.water_pump.world.stations import Station

pytestmark = pytest.mark.slow

ROUGH, HEAVY = 1.3, 1.08
"""Friction of the table and mass of the castings, at the limits of their errors at the high level."""


def pushed(lay: dict[str, Pose], blocks: float = 0.0) -> Bench:
    """BLOCKS pushes a pump, in the world without errors, but with a rough table and heavy castings. `blocks` is the
    distance (in) by which a person has moved the blocks along y since the pins were felt.
    """
    drawn = PumpWorld.nominal()
    world = replace(
        drawn,
        friction={**drawn.friction, "table": ROUGH},
        part_mass=HEAVY,
        fixtures={**drawn.fixtures, Station.BLOCKS: Placing(y=blocks * INCH)},
    )
    run = bench(f"{MACROS}        BLOCKS\n", world=world, lay=lay, felt={"BARE": 1.75})
    run.run.state.saved["BARE"] = np.array([0.0, 0.0, -0.3 * INCH])
    return run.go()


def test_a_pump_that_the_screwdriver_has_turned_about_a_corner_is_pushed_against_both_blocks() -> None:
    run = pushed(stacked(x=0.040, y=-0.036, turn=-0.5))
    assert run.finished
    assert run.place("base")[:2] == pytest.approx([25.0, 38.0], abs=0.005)
    findings = judge(run.cell.truth)
    assert all(findings[f"base_{side}"].ok for side in ("far", "left", "yaw"))


def test_a_pump_that_ends_at_another_place_than_before_is_reported() -> None:
    off = -0.13
    run = pushed(stacked(y=off - 0.02), blocks=off)
    assert run.told == "THE PUMP IS NOT WHERE IT WAS PUT: IT HAS MOVED, OR A JOINT READS WRONG"
    assert run.place("base")[1] == pytest.approx(38.0 + off, abs=0.005)
