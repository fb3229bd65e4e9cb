"""Counters, named vectors, PLACE, and the listing of 1977 with its commas."""

import pytest
from al_support import codes, compiled, diagnose, moves, only, walk

from handeye import al
from handeye.core.units import INCH, OUNCE_FORCE, OUNCE_INCH
from handeye.program.flow_operations import Assign, Countdown
from handeye.program.guards import Force, Moment, Touch
from handeye.program.motion_operations import Change, Move
from handeye.program.program import Program

LISTING_1977 = """\
        TRANS PIN [18 44 4 -90 90 0]   ;location of pin
        TRANS HOLE [30 40 5 -90 90 0]
        VECT FV [0 0 -50]
        ASSIGN TRIES 2
        MOVE PIN             ;first +Z, then above PIN, then -Z
PICKUP: CLOSE 1
        SKIPE 2              ;error 2: fingers closed beyond argument
        JUMP OK
        OPEN 4
        CHANGE Z,-1,NIL,0,0  ;down one inch
        SOJG TRIES,PICKUP
        WAIT NO PIN          ;print, wait for operator
        JUMP PICKUP
OK:     MOVE HOLE
        STOP FV,NIL          ;stop on 50 oz
        CHANGE Z,-1,NIL,0,0
        SKIPE 23             ;error 23: failed to stop
        JUMP NOHOLE
        FREE 2,X,Y
        SPIN 2,X,Y
        STOP FV,NIL
        CHANGE Z,-2,NIL,0,0
NOHOLE: WAIT NO HOLE
"""
"""As remembered from the reprint of 1983, but for positions, FV and OPEN 5, which is wider than this hand."""


def listing() -> Program:
    return compiled(LISTING_1977)


def test_listing_of_1977_has_nothing_to_be_warned_of() -> None:
    assert codes(LISTING_1977) == []


def test_listing_of_1977_opens_a_hand_that_is_not_this_one() -> None:
    assert codes(LISTING_1977.replace("OPEN 4", "OPEN 5"))[0] == "number-out-of-range"


def test_pin_found_at_once_is_taken_to_the_hole() -> None:
    trace = walk(listing(), {"CHANGE Z,-1,NIL,0,0": [23]})
    assert trace[:6] == ["ASSIGN TRIES 2", "MOVE PIN", "CLOSE 1", "SKIPE 2", "JUMP OK", "MOVE HOLE"]
    assert trace[-3:] == ["SKIPE 23", "CHANGE Z,-2,NIL,0,0", "WAIT NO HOLE"]


def test_pin_not_found_is_looked_for_an_inch_below() -> None:
    trace = walk(listing(), {"CLOSE 1": [2, None]})
    assert trace.count("CLOSE 1") == 2
    assert trace[5:8] == ["CHANGE Z,-1,NIL,0,0", "SOJG TRIES,PICKUP", "CLOSE 1"]
    assert "WAIT NO PIN" not in trace


def test_pin_never_found_calls_the_operator_when_the_counter_is_used_up() -> None:
    trace = walk(listing(), {"CLOSE 1": [2] * 2})
    assert trace.count("SOJG TRIES,PICKUP") == 2
    assert trace[trace.index("WAIT NO PIN") - 1] == "SOJG TRIES,PICKUP"


def test_listing_of_1977_keeps_its_commas_when_laid_out() -> None:
    laid = al.format_text(LISTING_1977)
    assert "        CHANGE  Z,-1,NIL,0,0    ;down one inch\n" in laid
    assert al.format_text(laid) == laid
    assert compiled(laid).steps[5].operation == listing().steps[5].operation


def test_commas_and_blanks_say_the_same() -> None:
    assert only("CHANGE [0,0,-1],0.6,2", Change) == only("CHANGE [0 0 -1] 0.6 2", Change)


@pytest.mark.parametrize(
    "text", ["CLOSE ,.1", "CLOSE .1,", "CLOSE .1,,.2", "CHANGE [,0 0 1] 1", "CHANGE [0 0 1,] 1"]
)
def test_comma_with_nothing_beside_it_is_reported(text: str) -> None:
    assert codes(text) == ["misplaced-comma"]


def test_axis_letters_are_unit_vectors_and_a_distance_has_a_sign() -> None:
    assert only("CHANGE Z,-1", Change).displacement == pytest.approx((0, 0, -INCH))
    assert only("CHANGE X 2", Change).displacement == pytest.approx((2 * INCH, 0, 0))


def test_named_vector_takes_the_unit_of_its_place() -> None:
    text = "VECT D [0 0 -2]\nSTOP D\nCHANGE D 1"
    change = only(text, Change)
    assert change.guards == (Force(force=(0, 0, pytest.approx(-2 * OUNCE_FORCE))),)
    assert change.displacement == pytest.approx((0, 0, -INCH))


def test_vector_may_be_named_before_it_is_written_and_in_a_macro() -> None:
    assert codes("DEFINE A\nCHANGE D 1\n\nA\nVECT D [0 0 1]") == []


def test_nil_and_a_speed_of_nothing_change_nothing() -> None:
    assert only("CHANGE Z,-1,NIL,0,0", Change) == only("CHANGE [0 0 -1] 1", Change)
    assert codes("CHANGE Z,-1,NIL,0,5") == ["number-out-of-range"]


def test_counted_axes_are_those_in_which_the_hand_gives_way() -> None:
    assert only("FREE 2,X,Y\nCHANGE Z,-1", Change).free == (1.0, 1.0, 0.0)
    assert only("FREE 1 Z\nCHANGE X 1", Change).free == (0.0, 0.0, 1.0)


def test_counted_axes_are_those_about_which_the_hand_gives_way() -> None:
    assert only("SPIN 2,X,Y\nCHANGE Z,-1", Change).spin == (1.0, 1.0, 0.0)


@pytest.mark.parametrize("axes", ["2,X", "1,X,Y", "2,X,X", "0", "1.5,X"])
def test_axes_have_to_be_as_many_as_counted(axes: str) -> None:
    assert codes(f"FREE {axes}\nCHANGE Z 1") == ["axis-count"]


def test_moment_stands_after_the_force_and_nil_for_what_there_is_none_of() -> None:
    twenty = pytest.approx((0, 0, 20 * OUNCE_INCH))
    ten = pytest.approx((0, 0, -10 * OUNCE_FORCE))
    assert only("STOP [0 0 -10] [0 0 20]\nCHANGE Z -1", Change).guards == (
        Force(force=ten),
        Moment(moment=twenty),
    )
    assert only("STOP NIL,[0 0 20]\nCHANGE Z -1", Change).guards == (Moment(moment=twenty),)
    assert only("VECT D [0 0 20]\nSTOP NIL D\nCHANGE Z -1", Change).guards == (Moment(moment=twenty),)
    change = only("FORCE [0 0 -10],NIL\nCHANGE Z -1", Change)
    assert (change.press, change.moment) == (ten, None)
    change = only("FORCE nil [0 0 20]\nCHANGE Z -1", Change)
    assert (change.press, change.moment) == (None, twenty)


@pytest.mark.parametrize("text", ["STOP NIL", "STOP NIL,NIL", "FORCE NIL"])
def test_neither_force_nor_moment_is_reported(text: str) -> None:
    (diagnostic,) = diagnose(f"{text}\nCHANGE Z -1")
    word = text.split()[0]
    assert (diagnostic.code, diagnostic.message) == (
        "missing-operand",
        f"`{word}` has no force and no moment",
    )


def test_via_names_what_is_passed_on_the_way() -> None:
    move = moves(compiled("VIA P,T\nMOVE T DIRECT"))[0]
    assert (move.via, move.goal, move.direct) == (("P", "T"), "T", True)
    assert moves(compiled("VIA P\nSTOP 9\nPARK"))[0].via == ("P",)


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("VIA P\nCHANGE Z 1", "modifier-misplaced"),
        ("VIA P\nVIA T\nMOVE T", "modifier-twice"),
        ("VIA\nMOVE T", "missing-operand"),
        ("VIA P P P P P\nMOVE T", "too-many-operands"),
        ("VIA P NOWHERE\nMOVE T", "unknown-position"),
    ],
)
def test_via_that_cannot_be_meant_is_reported(text: str, code: str) -> None:
    assert codes(text) == [code]


def test_touch_enables_one_finger_or_either() -> None:
    assert only("TOUCH 3\nMOVE T", Move).guards == (Touch(fingers=3),)
    assert codes("TOUCH 4\nMOVE T") == ["number-out-of-range"]
    assert codes("TOUCH 1.5\nMOVE T") == ["wrong-operand"]
    assert codes("TOUCH 1\nSTOP 5\nMOVE T") == ["modifier-twice"]


def test_place_is_a_short_way_down_that_stops_on_the_table() -> None:
    place = only("PLACE", Change)
    assert place.displacement == pytest.approx((0, 0, -3 * INCH))
    assert place.guards == (Force(force=(0.0, 0.0, -50 * OUNCE_FORCE)),)
    assert codes("STOP 5\nPLACE") == ["modifier-misplaced"]


def test_counter_is_set_and_counted_down() -> None:
    program = compiled("ASSIGN N 3\nL: OPEN 1\nSOJG N,L\nPARK")
    assert program.steps[0].operation == Assign(counter="N", value=3)
    assert program.steps[2].operation == Countdown(counter="N", positive=1)
    assert walk(program, {}).count("OPEN 1") == 3


@pytest.mark.parametrize("number", ["-1", "1001", "2.5"])
def test_counter_is_a_whole_number_within_reason(number: str) -> None:
    assert codes(f"ASSIGN N {number}\nL: PARK\nSOJG N L")[0] in ("number-out-of-range", "wrong-operand")


def test_counter_nothing_sets_is_reported_with_the_nearest_name() -> None:
    (diagnostic,) = diagnose("ASSIGN TRIES 2\nL: PARK\nSOJG TIRES,L")
    assert (diagnostic.code, diagnostic.help) == ("unknown-counter", "did you mean `TRIES`?")


@pytest.mark.parametrize(
    ("name", "note"), [("X", "`X` is an axis of the table"), ("NIL", "`NIL` is not a vector")]
)
def test_vector_that_is_there_already_cannot_be_written_again(name: str, note: str) -> None:
    diagnostic = diagnose(f"VECT {name} [0 1 0]\nCHANGE {name} 1")[0]
    assert (diagnostic.code, diagnostic.notes) == ("vector-twice", (note,))
