"""The listing of 1977 carried out: counting its tries at the pin, feeling for the hole, placing."""

import numpy as np
import pytest
from pump_bench import SEATED, TAUGHT, at_standard, bench, shifted

from handeye.core.errors import NO_FORCE, NOTHING_HELD
from handeye.core.mutable_records import copied
from handeye.core.units import DEGREE, INCH
from handeye.program.events import HandTold
from handeye.program.program import Position

pytestmark = pytest.mark.slow

LISTING = """
        VECT FV [0 0 -50]
        OPEN 1
        ASSIGN TRIES 2
        MOVE PIN
PICKUP: CLOSE .1
        SKIPE 2
        JUMP OK
        OPEN 1
        CHANGE Z,-1,NIL,0,0
        SOJG TRIES,PICKUP
        WAIT NO PIN
        JUMP PICKUP
OK:     MOVE HOLE
        STOP FV,NIL
        CHANGE Z,-.6,NIL,0,0
        SKIPE 23
        JUMP NOHOLE
        FREE 2,X,Y
        SPIN 2,X,Y
        STOP FV,NIL
        CHANGE Z,-2,NIL,0,0
NOHOLE: WAIT NO HOLE
"""


def picking(up: float) -> dict[str, Position]:
    """Positions of a pin taught so far (in) above where it is, and of its hole."""
    return {"PIN": shifted("P1", z=up), "HOLE": TAUGHT.positions["T1"]}


def test_pin_an_inch_lower_than_taught_is_found_at_the_second_try_and_goes_in() -> None:
    run = bench(LISTING, positions=picking(1.0), lay=at_standard()).go()
    assert run.errors == [NOTHING_HELD, NO_FORCE]
    assert run.run.state.counters == {"TRIES": 1}
    assert run.told == "NO HOLE"
    assert run.place("pin0")[2] == pytest.approx(SEATED, abs=0.005)


def test_pin_that_is_not_there_is_tried_for_twice_and_the_operator_called() -> None:
    run = bench(LISTING, positions=picking(4.0), lay=at_standard()).go()
    assert run.errors == [NOTHING_HELD] * 2
    assert run.told == "NO PIN"


def test_place_sets_the_hand_down_on_what_it_meets() -> None:
    run = bench("MOVE HOLE\nPLACE\nPARK", positions=picking(0.0), lay=at_standard()).to("PARK")
    assert run.errors == []


def test_where_tells_what_trans_would_write() -> None:
    run = bench("TRANS TILTED [25 38 6 90 60 20]\nMOVE TILTED\nWHERE").go()
    (told,) = run.all(HandTold)
    assert np.array(told.at[:3]) / INCH == pytest.approx((25, 38, 6), abs=0.1)
    assert np.array(told.at[3:]) / DEGREE == pytest.approx((90, 60, 20), abs=1)


def test_counters_are_remembered_with_the_rest() -> None:
    run = bench(LISTING, positions=picking(0.0)).to("MOVE PIN")
    kept = copied(run.run.state)
    run.run.state.counters["TRIES"] = 7
    run.run.restore(kept)
    assert run.run.state.counters == {"TRIES": 2}
