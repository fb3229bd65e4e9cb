"""Step 3: the base is pushed against both blocks, and stops there by force."""

import pytest
from pump_bench import Bench, at_standard, bench, shifted, stage

from handeye.core.units import INCH
from handeye.program.events import GuardTripped
from handeye.tasks.water_pump.referee.findings import judge
from handeye.tasks.water_pump.world.pump_world import PumpWorld

pytestmark = pytest.mark.slow


def pushed(world: PumpWorld | None = None) -> Bench:
    """The base in the hand on the table, .4 in short of both blocks; the pushes are the program's."""
    text = stage("put the base in its standard position")
    grasp = "OPEN 1.85\nMOVE W\nCLOSE .9 1.4\n"
    script = grasp + text[text.index("STOP    [0 72 0]") : text.rindex("FLATNESS")]
    positions = {"W": shifted("S0", z=-0.5)}
    return bench(script, world=world, positions=positions, lay=at_standard(0.4, -0.4)).go()


@pytest.fixture(scope="module")
def nominal() -> Bench:
    return pushed()


def test_row_59_every_push_is_stopped_by_force(nominal: Bench) -> None:
    assert [trip.guard for trip in nominal.all(GuardTripped)] == ["force", "force", "force"]


@pytest.mark.row(59, nominal=1)
def test_row_59_the_base_ends_within_five_hundredths_of_its_standard_position(nominal: Bench) -> None:
    assert nominal.place("base")[:2] == pytest.approx([25.0, 38.0], abs=0.05)


SEEDS = (0, 1)


@pytest.mark.row(59, drawn=len(SEEDS))
@pytest.mark.parametrize("seed", SEEDS)
def test_row_59_it_lies_against_both_blocks_in_a_drawn_world(seed: int) -> None:
    findings = judge(pushed(PumpWorld.sample(seed)).cell.truth)
    assert max(findings[f"base_{side}"].value for side in ("far", "left")) < 0.05 * INCH * 1000
    assert findings["base_yaw"].ok
