"""The pin-insertion listing of 1973, as printed, with the hole where the program thinks and where it does not.

The base stands in its standard position; the hole is displaced by teaching T beside it, so that `off` is how
far the hole lies from T.
"""

from functools import cache
from math import cos, sin

import pytest
from pump_bench import (
    COUNT,
    IN_WORLDS,
    INSERT,
    SEATED,
    TAUGHT,
    Bench,
    at_standard,
    bench,
    shifted,
    world_of,
    written,
)

from handeye.core.errors import NOTHING_HELD, SEARCH_EXHAUSTED
from handeye.core.mutable_records import copied
from handeye.core.units import OUNCE_FORCE
from handeye.program.events import GuardTripped, Saved, SearchAdvanced
from handeye.program.program import Position

pytestmark = pytest.mark.slow

PLAY = 0.02
"""Sideways play (in) of the hand that holds a seated pin: pin in hole, pin in fingers, give of the servo."""


def ready(T: Position, more: str = "", seed: int | None = None) -> Bench:
    positions = {"P": TAUGHT.positions["P1"], "T": T}
    return bench("OPEN 1\n" + INSERT + more, world=world_of(seed), positions=positions, lay=at_standard())


@cache
def held(seed: int | None) -> Bench:
    """The hand holds the pin, and goes to T next: the same wherever T is."""
    return ready(TAUGHT.positions["T1"], seed=seed).to("MOVE  T")


def inserting(T: Position, more: str = "", seed: int | None = None) -> Bench:
    """A run with the pin in the hand."""
    run, before = ready(T, more, seed), held(seed)
    fetched = range(before.executor.state.at or 0)
    assert [run.run.plan.program.steps[n] for n in fetched] == [
        before.run.plan.program.steps[n] for n in fetched
    ]
    run.cell.restore(before.cell.capture())
    run.run.restore(copied(before.run.state))
    return run


def hole_off(x: float, y: float, more: str = "", seed: int | None = None) -> Bench:
    """A run with the hole displaced from T by (x, y) in."""
    return inserting(shifted("T1", -x, -y), more, seed)


def over_large_hole() -> Bench:
    return inserting(written(25.0, 38.0, 3.931, -90))


DEEP = 0.954
"""How far (in) the hand goes down from T until a pin is seated, by the drawing: from 3.931 to what it has of the pin
below it, 1.227, over the base's 1.750."""


@cache
def went_in(off: float) -> tuple[Bench, float]:
    """The run to its end, the hole `off` (in) along x, and how far (in) the hand truly went down from T to SAVE."""
    run = hole_off(off, 0.0)
    above = run.to("CHANGE").hand()[2]
    seated = run.to("SAVE").hand()[2]
    return run.go(), float(above - seated)


@pytest.mark.row(12, nominal=1)
def test_row_12_a_hole_exactly_at_t_is_found_at_the_first_place() -> None:
    run, deep = went_in(0.0)
    assert (run.finished, run.tries) == (True, 1)
    assert deep == pytest.approx(DEEP, abs=0.01)
    assert run.saved("H") == pytest.approx([0.0, 0.0, -deep], abs=PLAY)
    assert run.place("pin0")[2] == pytest.approx(SEATED, abs=0.005)


@pytest.mark.row(13, nominal=1)
def test_row_13_a_hole_one_step_off_is_found_at_the_second_place() -> None:
    run, deep = went_in(0.07)
    assert (run.finished, len(run.all(SearchAdvanced))) == (True, 1)
    assert deep == pytest.approx(DEEP, abs=0.01)
    assert run.saved("H") == pytest.approx([0.07, 0.0, -deep], abs=PLAY)


def test_row_13_the_first_try_lands_on_the_base_with_fifty_ounces() -> None:
    landed, seated = went_in(0.07)[0].all(GuardTripped)
    assert (landed.limit, seated.limit) == pytest.approx((50 * OUNCE_FORCE, 60 * OUNCE_FORCE))
    assert 0.0 < landed.value - landed.limit < 3.0


def around(distance: float) -> list[tuple[float, float]]:
    """Four places at a distance (in), one of them along the grid of the search."""
    return [(round(distance * cos(a), 4), round(distance * sin(a), 4)) for a in (0.0, 1.3, 3.9, 5.5)]


TENTH = around(0.1)
FIFTEEN = [(0.0, -0.15), around(0.15)[1]]


@pytest.mark.row(14, nominal=len(TENTH))
@pytest.mark.parametrize("off", TENTH)
def test_row_14_a_hole_a_tenth_off_is_found_within_nine_tries(off: tuple[float, float]) -> None:
    run = hole_off(*off).go()
    assert run.finished
    assert 2 <= run.tries <= 9
    assert run.saved("H")[:2] == pytest.approx(off, abs=PLAY)


@pytest.mark.row(15, nominal=len(FIFTEEN))
@pytest.mark.parametrize("off", FIFTEEN)
def test_row_15_a_hole_fifteen_hundredths_off_is_found_within_twenty_four_tries(
    off: tuple[float, float],
) -> None:
    run = hole_off(*off).go()
    assert run.finished
    assert 10 <= run.tries <= 24
    assert run.saved("H")[:2] == pytest.approx(off, abs=PLAY)


@pytest.mark.row(16, **COUNT)
@IN_WORLDS
def test_row_16_beside_the_base_nothing_resists_and_the_search_goes_on(seed: int | None) -> None:
    run = inserting(written(25.0, 34.0, 3.931, -90), seed=seed)
    run.go(lambda: run.tries > 3)
    assert run.errors == [23, 23] * 3
    assert not run.all(Saved)


def test_row_17_over_the_large_hole_both_force_tests_pass() -> None:
    run = over_large_hole().to("OPEN  .5")
    assert run.errors == [23]
    assert not run.all(SearchAdvanced)


@pytest.mark.row(17)
def test_row_17_a_pin_that_fell_over_in_the_large_hole_is_missed_by_the_closing_hand() -> None:
    """The pin stands on the floor of the hole (`test_loose_pin.py`); the experimenter flicks it over."""
    run = over_large_hole().to("OPEN  .5")
    run.executor.step()
    run.flick("pin0", (-0.05, 0.0, 0.0)).go()
    assert run.called.error == NOTHING_HELD
    assert "there is nothing between them, or the object is too thin" in run.told


@pytest.mark.row(18, drawn=1)
def test_row_18_at_600_oz_the_pin_is_in_the_hole_and_the_whole_search_goes_by() -> None:
    """So 60 oz it must have been: the arm presses with a sixth of 600. The checker warns of it."""
    script = "OPEN 1\n" + INSERT.replace("-60]", "-600]")
    positions = {"P": TAUGHT.positions["P1"], "T": TAUGHT.positions["T1"]}
    run = bench(script, world=world_of(1), positions=positions, lay=at_standard(0.03, -0.03))
    assert run.to("SKIPN").place("pin0")[2] == pytest.approx(SEATED, abs=0.02)
    run.go(lambda: run.tries > 2)
    assert run.run.state.search is not None
    run.run.state.search.limit = 12  # the rest of the 49 places would be no different
    assert run.go().called.error == SEARCH_EXHAUSTED
    assert (run.tries, run.all(Saved)) == (12, [])
    assert max(trip.limit for trip in run.all(GuardTripped)) == pytest.approx(50 * OUNCE_FORCE)


@pytest.mark.row(19, **COUNT)
@IN_WORLDS
def test_row_19_restoring_brings_the_hand_back_to_the_hole_without_a_search(seed: int | None) -> None:
    run = hole_off(0.08, 0.0, "MOVE T\nRESTORE H\n", seed).to("SAVE")
    inserted, tries = run.hand(), run.tries
    run.go()
    assert run.finished
    assert run.hand() == pytest.approx(inserted, abs=PLAY)
    assert run.tries == tries


def test_a_search_that_finds_no_hole_ends_with_the_operator() -> None:
    """The hole is half an inch away along the casting, beyond the spiral's reach."""
    run = hole_off(0.35, 0.35)
    run.go(lambda: run.tries > 2)
    assert run.run.state.search is not None
    run.run.state.search.limit = 5  # the rest of the 49 places would be no different
    assert run.go().called.error == SEARCH_EXHAUSTED
