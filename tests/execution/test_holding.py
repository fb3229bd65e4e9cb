"""Is something held? The fingers close on fins of some thickness and on a pin, and the gap that is left tells."""

from dataclasses import replace

import pytest
from block_task import block_run
from pump_bench import bench

from handeye.core.errors import NOTHING_HELD, WRONG_THICKNESS
from handeye.core.units import INCH
from handeye.runs.advance import advance
from handeye.tasks.water_pump.world.pump_world import PumpWorld

pytestmark = pytest.mark.slow

SEEDS = (0, 1)
"""Worlds in which the fin does not stand where it should."""

TRIES = """
        OPEN  1
        MOVE  P1
        CLOSE .1        ;held
        OPEN  1
        CLOSE .2 .3     ;held
        OPEN  1
        CLOSE .3 .4     ;too thin: error 2, tested
        SKIPE 2
        JUMP  END
        OPEN  1
        CLOSE .1 .2     ;too thick: the program calls the operator
END:    OPEN  1
"""
SOFT = 0.004
"""How far (in) the fingers press into a fin."""


def closed(statement: str, seed: int, thickness: float) -> tuple[float, int | None]:
    """The gap (in) after the small hand has closed on a fin (in), and the error that the operator got."""
    runner = block_run(f"OPEN 2.5\nMOVE BLOCK\n{statement}", seed, **{"block.thickness": thickness * INCH})
    error = advance(runner).error
    return runner.cell.devices.sense().gap / INCH, error


@pytest.mark.row(29, drawn=len(SEEDS))
@pytest.mark.parametrize(
    ("seed", "thickness", "error"),
    [(0, 0.24, None), (0, 0.05, NOTHING_HELD), (1, 0.12, None), (1, 0.08, NOTHING_HELD)],
)
def test_a_close_to_a_tenth_holds_24_hundredths_and_not_5(
    seed: int, thickness: float, error: int | None
) -> None:
    assert closed("CLOSE .1", seed, thickness) == (pytest.approx(thickness, abs=SOFT), error)


@pytest.mark.row(30, drawn=len(SEEDS))
@pytest.mark.parametrize(
    ("seed", "thickness", "error"),
    [
        (0, 0.24, None),
        (0, 0.35, WRONG_THICKNESS),
        (0, 0.1, NOTHING_HELD),
        (1, 0.28, None),
        (1, 0.32, WRONG_THICKNESS),
        (1, 0.18, NOTHING_HELD),
    ],
)
def test_a_close_with_a_range_rejects_both_sides_of_it(
    seed: int, thickness: float, error: int | None
) -> None:
    assert closed("CLOSE .2 .3", seed, thickness) == (pytest.approx(thickness, abs=SOFT), error)


def test_a_close_without_a_minimum_holds_anything_that_is_thicker_than_a_twentieth() -> None:
    assert closed("CLOSE", 0, 0.07) == (pytest.approx(0.07, abs=SOFT), None)


@pytest.mark.parametrize("off", [-0.04, 0.0, 0.04])
def test_a_close_without_a_minimum_holds_anything_and_not_nothing(off: float) -> None:
    """Shut on nothing, by hands whose gap is off by as much as at the high level (in)."""
    world = PumpWorld.sample(0)
    wrong = replace(world, hand=replace(world.hand, gap_offset=off * INCH))
    assert bench("OPEN 1\nCLOSE", world=wrong).go().called.error == NOTHING_HELD


@pytest.mark.row(29, nominal=1, drawn=len(SEEDS))
@pytest.mark.row(30, nominal=1, drawn=len(SEEDS))
@pytest.mark.parametrize(
    "world", [PumpWorld.nominal(), *map(PumpWorld.sample, SEEDS)], ids=["nominal", *map(str, SEEDS)]
)
def test_the_hand_of_the_pump_holds_a_pin_by_its_thickness(world: PumpWorld) -> None:
    """A pin of .248 in, by a hand that reads its gap wrong."""
    run = bench(TRIES, world=world).go()
    assert run.errors == [NOTHING_HELD, WRONG_THICKNESS]
    assert run.called.error == WRONG_THICKNESS
