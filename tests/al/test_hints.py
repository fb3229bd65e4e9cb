"""Slips of the hand, and words of other languages: the help says what is meant."""

import pytest
from al_support import LISTING, diagnose

from handeye.core.diagnostics import render
from handeye.core.source import Source


@pytest.mark.parametrize(
    ("text", "code", "help"),
    [
        ("OPEN O.5", "malformed-number", "a letter that looks like it: `0.5`"),
        ("OPEN 1.O", "malformed-number", "a letter that looks like it: `1.0`"),
        ("OPEN l", "wrong-operand", "a letter that looks like it: `1`"),
        ("STOP [0 0 -5O]\nMOVE T", "malformed-number", "a letter that looks like it: `-50`"),
        ("STOP [0 O 5]\nMOVE T", "wrong-operand", "a letter that looks like it: `0`"),
        ("OPEN 25mm", "unit-written", "distances are in inches"),
        ("STOP (0 0 -20)\nMOVE T", "unexpected-character", "write a vector in brackets"),
        ("MOVE(T)", "unexpected-character", "a space separates"),
        ("OPEN = 1", "unexpected-character", "a space separates"),
        ("CHANGE −Z 1", "unexpected-character", "use an ordinary minus sign: `-Z`"),
        ("CHANGE -Z 1", "unexpected-character", "a name cannot have a sign"),
        ("STAGE “fetch”", "unexpected-character", "straight quotes"),
        ("OPEN\N{NO-BREAK SPACE}1", "unexpected-character", "use an ordinary space"),
        ("MOVE Müller", "unexpected-character", "letters from A to Z"),
        ("OPEN 1 # wide", "unexpected-character", "a comment begins with `;`"),
        ("CHANGE 0 0 -1 .6", "wrong-operand", "write a vector in brackets"),
        ("CHANGE .6 [0 0 -1]", "wrong-operand", "the vector comes first"),
        ("CLOSE .1 OPEN", "wrong-operand", "`OPEN` is an instruction: put it on a new line"),
        ("MOVE DIRECT T", "wrong-operand", "usage: `MOVE position (DIRECT)`"),
        ("PARK\nSTOP", "missing-operand", "usage: `STOP force (moment)`: `STOP` ends the next motion when "),
        ("PARK\nSTOP", "missing-operand", "in ounces; a program needs no end statement"),
        ("PARK\nEND", "unknown-instruction", "a program needs no end statement: it ends after its last line"),
        (
            "PARK\nRETURN",
            "unknown-instruction",
            "a program needs no end statement: it ends after its last line",
        ),
        ("L: PARK\nGOTO L", "unknown-instruction", "`JUMP` goes to a label"),
        (
            "DEFINE M\nPARK\n\nCALL M",
            "unknown-instruction",
            "to call a macro, write its name and then its operands",
        ),
        ("L; MOVE T", "unknown-instruction", "a label ends with a colon: `L:`; a `;` begins a comment"),
        ("L MOVE T", "unknown-instruction", "a label ends with a colon: `L:`"),
        ("DEFINE M\nPARK\n\nL M", "unknown-instruction", "a label ends with a colon: `L:`"),
        ("N = 3\nPARK", "unknown-instruction", "`ASSIGN` sets a counter"),
        ("and down into the hole", "unknown-instruction", "a comment begins with `;`"),
    ],
)
def test_what_was_meant_is_told(text: str, code: str, help: str) -> None:
    (told,) = (d for d in diagnose(text) if d.severity == "error")
    assert told.code == code
    assert help in (told.help or "")


def test_a_name_that_looks_like_a_known_one_is_taken_for_it() -> None:
    (told,) = diagnose("TRANS T1 [25 38 6 -90 90 0]\nMOVE Tl\nMOVE T1")
    assert told.help == "did you mean `T1`?"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "ASSIGN N 3\nL: PARK\nSOJG L,N",
            "`L` is a label and `N` a counter, but `SOJG` takes them in the other order",
        ),
        (
            "LOOK V\nGENERAL V BASE",
            "`V` is a picture and `BASE` a part, but `GENERAL` takes them in the other order",
        ),
    ],
)
def test_two_names_in_the_wrong_order_are_one_mistake(text: str, message: str) -> None:
    (told,) = (d for d in diagnose(text) if d.severity == "error")
    assert told.code == "wrong-operand"
    assert told.message.startswith(message)


def test_a_label_inside_a_macro_is_shown_to_who_jumps_to_it() -> None:
    (told,) = (
        d
        for d in diagnose("DEFINE M\nTRY: OPEN 1\nSKIPE 2\nJUMP TRY\n\nM\nJUMP TRY")
        if d.severity == "error"
    )
    assert told.message == "label `TRY` belongs to a macro"
    assert [(label.span.start, label.text) for label in told.secondary] == [
        (9, "the label is inside a macro")
    ]
    assert "end the macro with a blank line" in (told.help or "")


@pytest.mark.parametrize("tool", ["", "TOOL 0\n"])
def test_a_torque_of_a_screwdriver_that_stands_still_is_told(tool: str) -> None:
    told = diagnose(f"{tool}TORQUE 42\nCHANGE Z -.5\nSKIPE 24\nPARK\nPARK")
    assert [d.code for d in told] == ["torque-without-tool"]


def test_a_torque_of_a_screwdriver_that_may_run_is_not_told() -> None:
    assert diagnose("TOOL 190\nTORQUE 42\nCHANGE Z -.5") == []
    assert diagnose("CLOSE .1\nSKIPE 2\nTOOL 190\nTORQUE 42\nCHANGE Z -.5") == []


def test_an_error_that_was_tested_before_cannot_be_there_any_more() -> None:
    (told,) = diagnose("STOP 9\nCHANGE Z -1\nSKIPE 23\nSKIPE 23\nPARK\nPARK")
    assert (told.code, told.message) == ("error-never-raised", "an earlier test has already cleared error 23")
    assert [label.text for label in told.secondary] == ["the earlier test"]


@pytest.mark.parametrize("text", ["WAIT 2", "WAIT 0.5 s", "WAIT 10 SECONDS"])
def test_a_wait_for_a_time_is_told(text: str) -> None:
    assert [d.code for d in diagnose(f"PARK\n{text}")] == ["wait-for-time"]


@pytest.mark.parametrize("text", ["WAIT NO PIN", "WAIT 2 PINS LEFT", 'WAIT "PRESS RETRY"'])
def test_a_wait_with_words_is_not(text: str) -> None:
    assert diagnose(f"PARK\n{text}") == []


def test_a_saved_difference_is_not_mixed_up_with_a_position() -> None:
    (told,) = diagnose("MOVE T\nRESTORE P")
    assert told.help == "`P` is a position, not a saved difference"


def test_listing_of_1973_needs_no_help() -> None:
    assert diagnose(LISTING) == []


def test_a_mark_just_behind_the_widest_line_is_shown() -> None:
    text = "\t" * 13 + "TORQUE"
    (told,) = (d for d in diagnose(text) if d.code == "missing-operand")
    rows = render(told, Source(name="x.al", text=text)).splitlines()
    assert rows[4].endswith("^ expected here")
