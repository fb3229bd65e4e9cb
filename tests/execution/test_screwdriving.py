"""The first screws: driven until the motor meets its torque, judged by depth, and found where the base has moved."""

import pytest
from pump_bench import Bench, bench, put, stacked, stage

from handeye.errors import NO_FORCE, WRONG_TRAVEL
from handeye.events import GuardTripped, SearchAdvanced
from handeye.mutable_records import copied
from handeye.pose import planar, translated
from handeye.tasks.water_pump import threads
from handeye.tasks.water_pump.drawing import screw_holes
from handeye.tasks.water_pump.threads import holes_of
from handeye.units import INCH, OUNCE_INCH

pytestmark = pytest.mark.slow


PLAY = 0.04
"""Play (in) of a screw's tip in a mouth, and of the hand that holds the driver."""
MOVED = (0.1, 0.0)
"""How far the base is moved between two screws (in)."""
NEXT = "MOVE H5\nRESTORE E1 LEVEL\nRESTORE HS LEVEL\nSAVE NOTHING"
"""The way to the hole after those of the first two screws."""


def two_screws() -> Bench:
    """The program's own text for the first two screws, on a stack held by its two pins."""
    text = stage("drive the first two screws")
    return bench(text[: text.index("SEARCH  .07\nD1:")] + NEXT, lay=stacked())


def first_screw() -> Bench:
    """The first is driven, the second is to come."""
    return two_screws().to("MOVE    S2")


@pytest.fixture(scope="module")
def driven() -> Bench:
    return first_screw()


@pytest.fixture(scope="module")
def moved(driven: Bench) -> Bench:
    """Taken up where the first screw is home; the experimenter pulls the stack aside, and the second is driven."""
    run = two_screws()
    run.cell.restore(driven.cell.capture())
    run.run.restore(copied(driven.run.state))
    for part in ("base", "gasket", "top", "pin0", "pin1"):
        put(run.cell, part, translated(run.pose(part), (MOVED[0] * INCH, MOVED[1] * INCH, 0.0)))
    return run.to("MOVE H5")


@pytest.fixture(scope="module")
def crossed() -> Bench:
    """In a world in which a fresh thread crosses, however straight its screw stands."""
    with pytest.MonkeyPatch.context() as world:
        world.setattr(threads, "SQUARE", -1.0)
        return first_screw()


@pytest.mark.row(23, nominal=1)
def test_row_23_a_base_that_was_moved_by_a_tenth_is_found_by_the_next_search(
    driven: Bench, moved: Bench
) -> None:
    assert driven.saved("HS")[:2] == pytest.approx([0.0, 0.0], abs=PLAY)
    assert moved.saved("HS")[:2] == pytest.approx(MOVED, abs=PLAY)
    assert len(moved.all(SearchAdvanced)) == 1


def test_row_23_the_second_screw_goes_home_all_the_same(moved: Bench) -> None:
    homes = {number for number, thread in enumerate(holes_of(moved.cell.truth)) if thread.clamp > 40.0}
    assert homes == {0, 2}


def test_row_23_the_holes_after_it_use_the_new_place(moved: Bench) -> None:
    moved.to("SAVE NOTHING")
    X_WB, (x, y) = moved.pose("base"), screw_holes()[5]
    hole = X_WB @ planar(x, y, 0.0, 0.0)
    assert moved.hand()[:2] == pytest.approx(hole[:2, 3] / INCH, abs=PLAY)


@pytest.mark.row(60, nominal=1)
def test_row_60_driving_ends_by_torque(driven: Bench) -> None:
    trip = driven.all(GuardTripped)[-1]
    assert (trip.guard, driven.errors) == ("torque", [NO_FORCE])
    assert trip.value >= trip.limit == pytest.approx(42 * OUNCE_INCH)


def test_row_60_the_screw_is_home_and_clamps(driven: Bench) -> None:
    (thread, *others) = holes_of(driven.cell.truth)
    assert (thread.screw, thread.crossed) == (0, False)
    assert thread.clamp > 40.0
    assert all(other.screw is None for other in others)


def test_row_60_a_crossed_thread_ends_by_torque_too(crossed: Bench) -> None:
    assert [trip.guard for trip in crossed.all(GuardTripped)].count("torque") == 2


def test_row_60_a_crossed_thread_is_told_by_its_depth(crossed: Bench) -> None:
    assert crossed.errors.count(WRONG_TRAVEL) == 1


def test_row_60_a_crossed_screw_is_backed_out_and_goes_home_in_a_scarred_thread(crossed: Bench) -> None:
    thread = holes_of(crossed.cell.truth)[0]
    assert (thread.screw, thread.crossed, thread.scarred) == (0, False, True)
    assert thread.clamp > 40.0
