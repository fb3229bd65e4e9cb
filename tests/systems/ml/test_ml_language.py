"""Lines of ML, their mistakes, and listings that can be read back."""

import re
from pathlib import Path

import pytest
from hypothesis import given, settings
from ml_bench import FOLLOWER, PLANS, codes, messages, statements

from handeye.core.codes import CODES as OTHER_CODES
from handeye.core.diagnostics import render
from handeye.core.errors import InvalidInput
from handeye.core.source import Source
from handeye.systems.ml.errors import MEANINGS
from handeye.systems.ml.language.check import checked
from handeye.systems.ml.language.codes import CODES
from handeye.systems.ml.language.commands import COMMANDS
from handeye.systems.ml.language.language import LANGUAGE
from handeye.systems.ml.language.parser import parsed_line, statement_of
from handeye.systems.ml.language.syntax import Statement
from handeye.systems.ml.ml_api import Ml
from handeye.systems.ml.tables.layout import SHAPES


def test_there_are_76_commands_and_30_tables() -> None:
    assert len(COMMANDS) == 106
    assert len(SHAPES) == 30
    assert not {*SHAPES} - {*COMMANDS}


@pytest.mark.ml_row(2)
@pytest.mark.parametrize(
    ("text", "expected"), [("0 STOP", ["M02"]), ("5001 STOP", ["M02"]), ("1 STOP\n5000 STOP", [])]
)
def test_sequence_numbers_go_from_1_to_5000(text: str, expected: list[str]) -> None:
    assert codes(text) == expected


@pytest.mark.ml_row(3)
def test_a_line_has_as_many_parameters_as_its_command_allows() -> None:
    assert codes(f"10 PRINT{' 1' * 15}") == []
    assert codes(f"10 PRINT{' 1' * 16}") == ["M03"]
    assert codes("10 MOVE 1 2 3 4 0 0 0 8 9 10 11 12") == ["unguarded-motion"]
    assert codes(f"10 MOVE{' 1' * 13}") == ["M03"]
    assert codes("10 SENSOR 5 0") == ["M03"]
    assert messages("10 SENSOR 5 0") == ["SENSOR takes 0, 1 or 3 parameters, not 2"]


@pytest.mark.ml_row(4)
@pytest.mark.parametrize(
    ("value", "expected"), [(32767, []), (-32768, []), (32768, ["M04"]), (-32769, ["M04"])]
)
def test_a_number_has_16_bits(value: int, expected: list[str]) -> None:
    assert codes(f"10 LOAD 1 {value}") == expected


@pytest.mark.ml_row(6)
def test_six_ampersands_are_accepted_and_seven_are_not() -> None:
    assert codes("10 PRINT &&&&&&17") == []
    assert codes("10 PRINT &&&&&&&17") == ["M06"]
    with pytest.raises(
        InvalidInput, match=r"^M06: a reference can have at most 6 `&`, but this reference has 7"
    ):
        Ml().do("PRINT &&&&&&&17")


@pytest.mark.ml_row(7)
def test_variables_go_from_1_to_256() -> None:
    assert codes("10 PRINT &1 &256") == []
    assert codes("10 PRINT &257") == codes("10 PRINT &0") == codes("10 LOAD 257 5") == ["M05"]


@pytest.mark.ml_row(9)
@pytest.mark.parametrize("text", ["10 MOVE 0 0 0 0 5", "10 DMOVE 0 0 0 0 0 0 5", "10 MOTOR 6 100"])
def test_absent_motors_are_found_before_the_program_runs(text: str) -> None:
    assert "M09" in codes(text)


@pytest.mark.ml_row(43)
@pytest.mark.parametrize(
    ("text", "left", "found"),
    [
        ("10 MOTOR 3 100\n20 STOP\n100 MOTOR 12 5", 100, ["M09"]),
        ("10 MOTOR 3 100\n20 STOP\n100 MOTOR 9 12000\n110 MOTOR 2 7000", 100, ["M10"]),
        ("10 MOTOR 9 12000\n20 STOP\n100 MOTOR 9 12000", 100, ["M10"]),
        ("10 LEFT\n20 MOVE 0 0 0 0 0 0 0 0 12000\n30 RIGHT\n40 MOVE 0 0 0 0 0 0 0 0 12000", None, ["M10"]),
        ("10 LEFT\n20 MOVE 5 0 0 0\n30 GETPOS 1 12\n40 HAND 50 0\n50 DHAND 50 0", None, ["M09"] * 3),
        (
            "10 GOSUB 100\n20 LEFT\n30 GOSUB 100\n40 STOP\n100 MOTOR 9 12000\n110 MOTOR 1 50\n120 RETURN",
            None,
            [],
        ),
        ("10 GOSUB 100\n20 LEFT\n30 GOSUB 100\n40 STOP\n100 MOTOR 9 17500\n120 RETURN", None, ["M10"]),
        ("10 STOP\n100 MOTOR 9 12000", None, []),  # a program for a left arm, perhaps
    ],
)
def test_motors_and_goals_are_those_of_the_arm_that_a_statement_commands(
    text: str, left: int | None, found: list[str]
) -> None:
    mistakes = checked(Source(name="t.ml", text=text), left=left)[1]
    assert [each.code for each in mistakes if each.severity == "error"] == found


@pytest.mark.ml_row(34)
def test_no_table_has_the_name_of_a_command() -> None:
    assert messages("10 GET 1 IF 1 1") == ["`IF` is a command, so no table has this name"]
    assert codes("10 GET 1 IF 1 1") == ["M11"]


def test_blanks_inside_a_reference_are_accepted_as_in_the_figure() -> None:
    line, _ = parsed_line("14 DMOVE 0 0 - & 1 - & 2")
    assert line is not None
    assert str(line.statement) == "DMOVE 0 0 -&1 -&2"


@settings(max_examples=50)
@given(statements())
def test_a_listed_statement_reads_back_as_itself(statement: Statement) -> None:
    line, wrong = parsed_line(f"17 {statement}")
    assert wrong is None
    assert line is not None
    assert line.statement == statement
    assert LANGUAGE.formatted(f"17   {statement}") == f"17 {statement}\n"


@pytest.mark.parametrize("code", CODES)
def test_the_example_of_a_code_makes_that_mistake_and_says_a_cure(code: str) -> None:
    found = checked(Source(name="example.ml", text=CODES[code].example))[1]
    shown = [each for each in found if each.code == code]
    assert shown
    assert all(each.help for each in shown)
    assert code not in OTHER_CODES
    assert (LANGUAGE.explanation(code) or "").startswith(f"{CODES[code].severity}[{code}]: ")


def test_every_number_of_an_error_is_explained() -> None:
    assert all(LANGUAGE.explanation(code.lower()) for code in MEANINGS)


@pytest.mark.parametrize("code", COMMANDS)
def test_the_example_of_a_command_can_be_read(code: str) -> None:
    line = statement_of(COMMANDS[code].example)
    assert line is not None
    assert line.statement.code == code
    assert COMMANDS[code].form in (LANGUAGE.explanation(code) or "")


def test_the_follower_has_one_unguarded_motion() -> None:
    source = Source(name=FOLLOWER.name, text=FOLLOWER.read_text(encoding="utf-8"))
    found = checked(source)[1]
    assert [each.code for each in found] == ["unguarded-motion"]
    assert source.text[found[0].primary.span.start :].startswith("DMOVE 0 0 - & 1 - & 2")


@pytest.mark.parametrize("file", sorted(PLANS.glob("*.ml")), ids=lambda file: file.stem)
def test_our_programs_have_no_errors(file: Path) -> None:
    found = checked(Source(name=file.name, text=file.read_text(encoding="utf-8")))[1]
    assert [each.message for each in found if each.severity == "error"] == []


def test_motions_without_a_guard_are_reported_together_and_fingers_are_not() -> None:
    free = "10 HAND 500\n20 DMOTOR 3 5\n30 DMOTOR 3 5\n40 DMOTOR 3 5\n"
    text = f"{free}50 SENSOR 8 1 9\n60 DMOTOR 3 5\n70 SENSOR\n80 DMOTOR 3 5"
    assert messages(text) == [
        "no sensor is guarded during this motion and the 2 motions after it",
        "no sensor is guarded during this motion",
    ]


def test_a_motion_after_a_branch_on_a_flag_is_found_along_any_path() -> None:
    text = (
        "10 SENSOR 8 1 9\n20 DMOTOR 3 5\n30 BRANCH 50 60 8\n50 GOSUB 90\n60 STOP\n90 DMOTOR 3 -5\n95 RETURN"
    )
    assert codes(text) == ["flag-left-on"]
    assert codes(text.replace("50 GOSUB", "40 STOP\n50 SENSOR 8 1 9\n55 GOSUB")) == []
    assert codes(text.replace("30 BRANCH 50 60 8", "30 BRANCH 60 50 -8")) == ["flag-left-on"]


def test_the_return_of_a_subroutine_by_bal_is_followed() -> None:
    text = "10 SENSOR 8 1 9\n20 BAL 7 80\n30 DMOTOR 3 5\n40 STOP\n80 SENSOR\n90 BRANCH &7"
    assert codes(text) == ["unguarded-motion"]
    assert codes(text.replace("80 SENSOR", "80 PRINT 1")) == []


def test_the_lint_follows_the_law_of_the_jolt() -> None:
    text = "10 SENSOR 7 -300 300\n20 PUT MT 2 8 {}\n30 DMOTOR 2 500\n40 STOP"
    assert codes(text.format(29)) == []
    assert codes(text.format(30)) == ["too-fast"]
    source = Source(name="t.ml", text=text.format(30))
    assert "`PUT MT 2 8 29`" in render(checked(source)[1][0], source)


@pytest.mark.parametrize(
    ("typed", "wanted"),
    [
        ("10 MO", "MOVE"), ("10 MOTOR ", "3"), ("10 BRANCH ", "900"), ("10 GET 1 ", "MT"), ("10 SENSOR ", "5"),
        ("10 BRANCH 9", "900"), ("MO", "MOTOR"),
    ],
)  # fmt: skip
def test_completion_offers_what_fits(typed: str, wanted: str) -> None:
    text = f"{typed}\n900 STOP\n"
    assert wanted in [word for word, _ in LANGUAGE.words(Source(name="t.ml", text=text), len(typed))]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("10 MOOVE 1", "`MOOVE` is not a command"),
        ("250", "there is no command after the number 250"),
        ("10 LOAD 1 5 * FIVE", "LOAD takes 2 parameters, not 4"),
        ("10 LOAD 1 &*", "`&*` is neither a number nor a reference"),
        ("5 POINT * 1 2", "a POINT must have the positions of 12 motors, not of 2"),
        ("10 SENSOR 5 4 4", "the lower limit, 4, must be below the upper limit, 4"),
        ("10 LOAD 1 1\n10 LOAD 1 2", "two statements have the number 10; the second replaces the first"),
        ("10 QUERY MT 13", "there is no line 13 in this table; the last line is 12"),
        ("MOTOR 3 200", "MOTOR has no sequence number, so it cannot be stored"),
    ],
)
def test_a_mistake_is_described_in_a_sentence(text: str, message: str) -> None:
    assert message in messages(text)


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (f"10 PRINT {'9' * 450}", "M04"), (f"{'9' * 450} STOP", "M02"), (f"10 PRINT {'&' * 400}1", "M06"),
        (f"10 PRINT &{'9' * 400}", "M05"), ("10 STOP\x00", "M01"), ("\u0661\u0660 STOP", "M01"),
        ("10 PRINT \u0665", "bad-parameter"),
        ("1E3 STOP", "M02"), ("10.5 STOP", "M02"), ("-5 STOP", "M02"), ("+5 STOP", "M02"),
        ("10 PRINT --5", "bad-parameter"),
        ("10 PRINT 5-3", "bad-parameter"), (f"10 {'A' * 470}", "M01"), (f"10 PRINT{' ' * 600}", "long-line"),
    ],
)  # fmt: skip
def test_hostile_lines_get_one_sentence(text: str, code: str) -> None:
    assert codes(text) == [code]
    assert not re.search(r"\n.*\n", messages(text)[0])


def test_a_return_goes_only_where_bal_has_called() -> None:
    called = "10 SENSOR 8 1 9\n20 BAL 7 80\n30 DMOTOR 3 5\n40 STOP\n"
    text = f"{called}50 SENSOR\n60 DMOTOR 3 5\n70 STOP\n80 PRINT 1\n90 BRANCH &7"
    assert codes(text) == []


def test_where_paths_meet_the_worse_one_counts() -> None:
    assert codes("10 GT? &1 0\n20 BRCOMP 40\n30 SENSOR 8 1 9\n40 DMOTOR 3 5") == ["unguarded-motion"]
    flags = "10 SENSOR 8 1 9\n20 DMOTOR 3 5\n30 BRANCH 40 50 8\n40 PRINT 1\n50 DMOTOR 3 5"
    assert codes(flags) == ["flag-left-on"]
    speeds = "10 SENSOR 7 -300 300\n20 BRCOMP 40\n30 PUT MT 2 8 10\n40 DMOTOR 2 5"
    assert codes(speeds) == ["too-fast"]
