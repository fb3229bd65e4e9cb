"""The arm in the cell: set free it stays where it is, and without its computer it stops."""

import pytest
from pump_bench import Bench, bench, world_of, written
from released_arm import let_go

from handeye.core.errors import WATCHDOG
from handeye.core.units import DEGREE, INCH
from handeye.tasks.water_pump.world.pump_world import PumpWorld

pytestmark = pytest.mark.slow

POUND = 4.448
"""Weight of a pound, N."""


STILL = 0.1 * INCH
"""How far the hand of a released arm may go by itself, m."""


@pytest.mark.row(31, nominal=1, drawn=20)
@pytest.mark.parametrize("seed", [None, *range(20)])
def test_row_31_the_released_arm_stays_where_it_is(seed: int | None) -> None:
    gone = let_go(world_of(seed), 10.0)
    assert gone.joints[[0, 1, 3, 4, 5]].max() < 0.5 * DEGREE
    assert gone.hand < STILL


@pytest.mark.row(31)
@pytest.mark.parametrize("seed", range(20))
def test_row_31_a_push_of_two_pounds_moves_the_released_arm(seed: int) -> None:
    """Down, against the joint that bears the arm."""
    assert let_go(world_of(seed), 2.0, (0.0, 0.0, -2 * POUND)).hand > STILL


def late_in(script: str, ticks: int, world: PumpWorld | None = None) -> Bench:
    """A run in which the computer misses one servo period, `ticks` after the hand was at T."""
    script = "OPEN 2\nMOVE T\nSEARCH 1\n" + script
    run = bench(script, world=world, positions={"T": written(25, 38, 6, 0)}).to("SEARCH")
    count = iter(range(10_000))

    def watch(_: object) -> None:
        if next(count) == ticks:
            run.cell.advance(run.run.drive.period)

    run.run.drive.watch = watch
    return run.go()


ACTIONS = ["CHANGE [0 0 -1] 2", "STOP 40\nCHANGE [0 0 1] 2", "MOVE PARK", "CENTER", "OPEN 3"]


@pytest.mark.row(34, drawn=1)
@pytest.mark.parametrize("script", ACTIONS)
def test_row_34_a_missed_servo_period_aborts_the_action(script: str) -> None:
    run = late_in(script, 20, PumpWorld.sample(1))
    assert run.errors == [WATCHDOG]
    assert run.told == "the computer missed a servo period; the drives were switched off, and the brakes set"


@pytest.mark.row(34, nominal=1)
def test_row_34_the_arm_stands_still_at_once_with_its_brakes_set() -> None:
    run = late_in("CHANGE [0 0 -1] 2", 30)
    start = run.hand()
    run.rest(1.0)
    assert run.run.drive.sensed.braked
    assert run.hand() == pytest.approx(start, abs=0.01)
    assert 4.5 < run.hand()[2] < 5.9
