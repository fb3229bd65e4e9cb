"""A pin that stands where it is not held: the program pushes each pin that it has inserted.

At the fingers a pin has .4 mm of play in its screw hole, and two inches in the large hole, on whose floor it may stand.
"""

import pytest
from pump_bench import COUNT, IN_WORLDS, Bench, at_standard, bench, stage, world_of, written

from handeye.core.errors import NO_FORCE
from handeye.core.pose import inverse, yaw
from handeye.program.events import SearchAdvanced
from handeye.program.program import Position

pytestmark = pytest.mark.slow

PUSH = "CHANGE  [0 1 0] .3 .5"
BOTH = stage("insert the aligning pins")
FIRST = BOTH[: BOTH.index("        MOVE    P2")]
"""The program's text for the first of the two pins."""
LARGE_HOLE = written(25.0, 38.0, 3.931, -90)


def inserting(seed: int | None, **positions: Position) -> Bench:
    """The first pin goes into a base that lies a little off both blocks, which differ from world to world."""
    return bench(FIRST, world=world_of(seed), positions=positions, lay=at_standard(0.03, -0.03))


def upright(run: Bench) -> bool:
    return bool(run.pose("pin0")[2, 2] > 0.99)


@pytest.mark.row(17, **COUNT)
@IN_WORLDS
def test_row_17_a_pin_that_stands_in_the_large_hole_is_caught_by_a_push_and_the_search_goes_on(
    seed: int | None,
) -> None:
    run = inserting(seed, T1=LARGE_HOLE).to(PUSH)
    assert (run.errors, run.all(SearchAdvanced), upright(run)) == ([NO_FORCE], [], True)
    assert run.to("AOJ").errors == [NO_FORCE, NO_FORCE]
    assert len(run.to("MOVE").all(SearchAdvanced)) == 1


@pytest.mark.parametrize("seed", [None, 1, 4])
def test_row_17_a_pin_in_its_hole_resists_the_push(seed: int | None) -> None:
    run = inserting(seed).to(PUSH)
    before = run.pose("base")
    assert run.go().finished
    assert upright(run)
    assert yaw(inverse(before) @ run.pose("base")) == pytest.approx(0.0, abs=0.01)
