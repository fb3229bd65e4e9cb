"""The first screws: driven until the motor meets its torque, and found where the base has moved."""

from functools import cache

import pytest
from pump_bench import COUNT, IN_WORLDS, LAID, Bench, bench, put, stacked, stage, world_of

from handeye.cell.threads import holes_of
from handeye.core.errors import NO_FORCE
from handeye.core.mutable_records import copied
from handeye.core.pose import planar, translated
from handeye.core.units import INCH, OUNCE_INCH
from handeye.program.events import GuardTripped, SearchAdvanced
from handeye.tasks.stanford_cell.dimensions import screw_holes

pytestmark = pytest.mark.slow


PLAY = 0.04
"""Play (in) of a screw's tip in a mouth, and of the hand that holds the driver."""
MOVED = (0.1, 0.0)
"""How far the base is moved between two screws (in)."""
CENTRED = """
OPEN .6
MOVE Q1
CENTER .1
SAVE Y1
SAVE E1
OPEN 1
MOVE Q2
OPEN .6
CENTER .1
SAVE X2
SAVE E2
OPEN 1
"""
"""What the program has measured at its standing pins by then."""
SCREWS = stage("drive the first two screws")
NEXT = "MOVE H5\nRESTORE Y1\nRESTORE X2\nRESTORE HS LEVEL\nSAVE NOTHING"
"""The way to the hole after those of the first two screws."""
TWO = CENTRED + SCREWS[: SCREWS.rindex("        RACK")] + NEXT
AND_PINS = CENTRED + stage("drive the first two screws", "take out the aligning pins")


def two_screws(seed: int | None, script: str = TWO) -> Bench:
    """The program's own text for the first two screws, on a stack held by its two pins, a little off both blocks."""
    return bench(script, world=world_of(seed), lay=stacked(0.03, -0.03), felt={"LAID": LAID})


def gone_on(run: Bench, fresh: Bench) -> Bench:
    """A run taken up where another is, whose text is the same so far."""
    fresh.cell.restore(run.cell.capture())
    fresh.run.restore(copied(run.run.state))
    return fresh


@cache
def driven(seed: int | None) -> Bench:
    """The first is home, the second is to come."""
    return two_screws(seed).to("MOVE S2")


@cache
def moved(seed: int | None) -> Bench:
    """Taken up where the first screw is home; the experimenter pulls the stack aside, and the second is driven."""
    run = gone_on(driven(seed), two_screws(seed))
    for part in ("base", "gasket", "top", "pin0", "pin1"):
        put(run.cell, part, translated(run.pose(part), (MOVED[0] * INCH, MOVED[1] * INCH, 0.0)))
    return run.to("MOVE H5")


@pytest.mark.row(23, **COUNT)
@IN_WORLDS
def test_row_23_a_base_that_was_moved_by_a_tenth_is_found_by_the_next_search(seed: int | None) -> None:
    difference = moved(seed).saved("HS") - driven(seed).saved("HS")
    assert difference[:2] == pytest.approx(MOVED, abs=PLAY)
    assert moved(seed).tries > 1


def test_row_23_without_errors_the_next_place_of_the_search_will_do() -> None:
    assert driven(None).saved("HS")[:2] == pytest.approx([0.03, -0.03], abs=PLAY)
    assert len(moved(None).all(SearchAdvanced)) == 1


@IN_WORLDS
def test_row_23_the_second_screw_goes_home_all_the_same(seed: int | None) -> None:
    homes = {number for number, thread in enumerate(holes_of(moved(seed).cell.truth)) if thread.clamp > 40.0}
    assert homes == {0, 2}


@IN_WORLDS
def test_row_23_the_holes_after_it_use_the_new_place(seed: int | None) -> None:
    run = gone_on(moved(seed), two_screws(seed)).to("SAVE NOTHING")
    X_WB, (x, y) = run.pose("base"), screw_holes()[5]
    hole = X_WB @ planar(x, y, 0.0, 0.0)
    assert run.hand()[:2] == pytest.approx(hole[:2, 3] / INCH, abs=PLAY)


@pytest.mark.row(23, **COUNT)
@IN_WORLDS
def test_row_23_the_pins_are_taken_where_it_is_now_and_fit_their_holder_at_once(seed: int | None) -> None:
    run = gone_on(moved(seed), two_screws(seed, AND_PINS)).go()
    assert (run.finished, run.all(SearchAdvanced)) == (True, [])


@pytest.mark.row(60, **COUNT)
@IN_WORLDS
def test_row_60_driving_ends_by_torque(seed: int | None) -> None:
    *_, trip = (trip for trip in driven(seed).all(GuardTripped) if trip.guard == "torque")
    assert driven(seed).errors[-1] == NO_FORCE
    assert trip.value >= trip.limit == pytest.approx(42 * OUNCE_INCH)


@IN_WORLDS
def test_row_60_the_screw_is_home_and_clamps(seed: int | None) -> None:
    (thread, *others) = holes_of(driven(seed).cell.truth)
    assert (thread.screw, thread.crossed) == (0, False)
    assert thread.clamp > 40.0
    assert all(other.screw is None for other in others)
