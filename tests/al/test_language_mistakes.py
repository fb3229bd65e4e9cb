"""Every mistake gets one clear diagnostic, and nothing but that."""

import pytest
from al_support import codes, compiled, diagnose

from handeye.core.codes import CODES
from handeye.core.diagnostics import LIMIT, Diagnostic, Label, as_json, render, suggestion
from handeye.core.source import Source, Span

LANGUAGE = [code for code, entry in CODES.items() if entry.phase == "language"]


@pytest.mark.parametrize("code", LANGUAGE)
def test_example_of_a_code_gets_exactly_that_diagnostic(code: str) -> None:
    assert codes(CODES[code].example, CODES[code].required) == [code]


@pytest.mark.parametrize("number", ["nan", "inf", "-inf", "1.2.3", "0x10", "1_0", "1e", "-nan"])
def test_what_is_no_number_is_called_so(number: str) -> None:
    assert codes(f"OPEN {number}") == ["malformed-number"]
    assert codes(f"CHANGE [0 0 {number}] 1") == ["malformed-number"]


@pytest.mark.parametrize("number", ["1e999", "-1e999", "9" * 400, "1e7"])
def test_numbers_beyond_all_measure_are_refused(number: str) -> None:
    assert codes(f"TOOL {number}") == ["number-out-of-range"]
    assert codes(f"CHANGE [0 0 {number}] 1") == ["number-out-of-range"]


@pytest.mark.parametrize(
    "text",
    [
        "OPEN 4.14",
        "OPEN -1",
        "CLOSE 5",
        "CLOSE .3 .2",
        "CENTER 5",
        "SEARCH 0",
        "CHANGE [0 0 1] 0",
        "TURN T 0",
        "STOP -3\nPARK",
    ],
)
def test_numbers_that_make_no_sense_are_refused(text: str) -> None:
    assert codes(text) == ["number-out-of-range"]


def test_error_numbers_are_whole_and_between_1_and_63() -> None:
    assert [codes(f"PARK\nSKIPE {n}\nPARK") for n in ("0", "64", "2.5")] == [
        ["number-out-of-range"],
        ["number-out-of-range"],
        ["wrong-operand"],
    ]


def test_each_line_with_a_mistake_gets_one_diagnostic() -> None:
    assert codes("OPEN\nMOVE NOWHERE\nGRAB 1\nOPEN 1 2") == [
        "missing-operand",
        "unknown-position",
        "unknown-instruction",
        "too-many-operands",
    ]


def test_broken_statement_does_not_accuse_those_that_need_it() -> None:
    assert codes("L: OPEN 9\nJUMP L") == ["number-out-of-range"]
    assert codes("TRANS A [1 2]\nMOVE A") == ["vector-size"]
    assert codes("MOVE\nRESTORE H\nSAVE H") == ["missing-operand"]
    assert codes("STOP 5\nMOOVE T") == ["unknown-instruction"]
    assert codes("PARK\nSKIPE 23\nOPEN") == ["missing-operand"]


def test_diagnostics_stand_in_order_of_position() -> None:
    assert codes("JUMP A\nOPEN 9\nMOVE X9") == ["unknown-label", "number-out-of-range", "unknown-position"]


def test_at_most_twenty_diagnostics_are_given() -> None:
    assert len(diagnose("GRAB\n" * 500)) == LIMIT
    assert len(diagnose("MOVE X9\n" * 500)) == LIMIT


def test_warnings_do_not_hide_errors() -> None:
    assert "unknown-position" in codes("MOVE T\nRESTORE H\n" * 30 + "MOVE X9")


def test_mistake_in_a_macro_is_reported_once_however_often_it_is_called() -> None:
    assert codes("DEFINE A\nSTOP 5\nOPEN 1\n\nA\nA\nA") == ["modifier-without-motion"]


def test_modifier_at_the_end_has_no_motion() -> None:
    assert codes("PARK\nSTOP 5") == ["modifier-without-motion"]


@pytest.mark.parametrize("between", ["OPEN 1\n", "STOP 5\n", "L: ", "SAVE H\n"])
def test_restore_follows_its_move_immediately(between: str) -> None:
    assert "restore-without-move" in codes(f"SAVE H\nMOVE T\n{between}RESTORE H\nMOVE T")


def test_position_that_is_taught_cannot_be_written_again() -> None:
    (diagnostic,) = diagnose("TRANS T [0 0 0 0 0 0]\nPARK")
    assert (diagnostic.code, diagnostic.notes) == ("position-twice", ("`T` is taught",))


@pytest.mark.parametrize(
    ("text", "help"),
    [
        ("MVOE T", "did you mean `MOVE`?"),
        ("MOVE t", "did you mean `T`?"),
        ("MOVE X", "known: `P`, `PARK`, `T`"),
        ("L1 MOVE T", "a label ends with a colon: `L1:`"),
        ("GENERAL BAES V\nLOOK V", "did you mean `BASE`?"),
        ("LOOP: PARK\nJUMP LOPO", "did you mean `LOOP`?"),
    ],
)
def test_help_names_what_was_probably_meant(text: str, help: str) -> None:
    assert diagnose(text)[0].help == help


def test_a_label_without_its_colon_is_one_mistake() -> None:
    assert [d.code for d in diagnose("L1 MOVE T\nJUMP L1")] == ["unknown-instruction"]


def test_suggestion_is_at_most_a_third_of_the_name_away() -> None:
    assert suggestion("bolt_hloe", ["bolt_hole", "nut"]) == "did you mean `bolt_hole`?"
    assert suggestion("abcdef", ["abxyzf"]) == "known: `abxyzf`"
    assert suggestion("abcdef", [f"name{i}" for i in range(9)]) is None


def test_frame_shows_the_guilty_span_and_its_cause() -> None:
    text = "SAVE H\n\tOPEN 1\nL1:\tMOVE T\n; \nL1:     PARK\n"
    (diagnostic,) = diagnose(text)
    assert render(diagnostic, Source(name="plans/pump.al", text=text)) == (
        "error[label-twice]: label `L1` is defined twice\n"
        " ┌─ plans/pump.al:5:1\n"
        " │\n"
        "3│ L1:     MOVE T\n"
        " │ -- first here\n"
        " ·\n"
        "5│ L1:     PARK\n"
        " │ ^^"
    )


def test_frame_keeps_marks_in_place_behind_tabs_and_control_characters() -> None:
    text = "\tOPEN\t\x1b[0"
    (diagnostic,) = diagnose(text)
    rows = render(diagnostic, Source(name="x.al", text=text)).splitlines()
    assert rows[3:5] == ["1│         OPEN    ␛[0", " │                 ^"]


def test_frame_cuts_a_line_that_is_too_long() -> None:
    text = "OPEN " + " " * 400 + "T" + " " * 400 + ";"
    rows = render(diagnose(text)[0], Source(name="x.al", text=text)).splitlines()
    assert max(map(len, rows)) < 130
    assert rows[3].index("T") == rows[4].index("^")


def test_two_labels_on_a_line_do_not_overwrite_each_other() -> None:
    source = Source(name="x.al", text="ON FORCE > INCHES")
    cause = Label(span=Span(start=3, end=8), text="this is a force")
    primary = Label(span=Span(start=11, end=17), text="this is a distance")
    diagnostic = Diagnostic(code="wrong-operand", message="no", primary=primary, secondary=(cause,))
    assert render(diagnostic, source).splitlines()[3:] == [
        "1│ ON FORCE > INCHES",
        " │    -----   ^^^^^^ this is a distance",
        " │    |",
        " │    this is a force",
    ]


def test_json_form_gives_lines_and_columns_from_one() -> None:
    text = "PARK\nOPEN 9"
    assert as_json(diagnose(text)[0], Source(name="x.al", text=text)) == {
        "code": "number-out-of-range",
        "severity": "error",
        "message": "`9` is too large for the gap of `OPEN`",
        "file": "x.al",
        "primary": {
            "file": "x.al",
            "line": 2,
            "column": 6,
            "end": 7,
            "text": "a gap must be between 0 and 4.13 in",
        },
        "secondary": [],
        "notes": [],
        "help": None,
    }


def test_warning_leaves_a_program() -> None:
    assert codes("PARK\nSKIPE 42\nPARK") == ["unknown-error-number"]
    assert len(compiled("PARK\nSKIPE 42\nPARK").steps) == 3


@pytest.mark.parametrize(
    ("text", "help"),
    [
        ("GO", "a script needs no console commands"),
        ("DO PUMP", "a script needs no console commands"),
        (
            "do CHANGE [0 0 -1] 1",
            "a script needs no console commands; write only the instruction: `CHANGE [0 0 -1] 1`",
        ),
    ],
)
def test_word_of_the_console_is_told_apart_from_a_misspelling(text: str, help: str) -> None:
    (diagnostic,) = diagnose(f"OPEN 1\n{text}")
    assert (diagnostic.code, diagnostic.help) == ("typed-word", help)


def test_macro_may_have_the_name_of_a_word_of_the_console() -> None:
    assert codes("DEFINE GO\nPARK\n\nGO") == []
