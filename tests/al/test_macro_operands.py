"""Macros with parameters: what a call gives stands in the place of its parameter, and is told where it is written."""

import pytest
from al_support import codes, compiled, diagnose, walk

from handeye import al
from handeye.al import AL
from handeye.arm.robots.stanford import STANFORD
from handeye.core.diagnostics import LIMIT, Diagnostic, quoted
from handeye.core.source import Source
from handeye.editor.samples import SAMPLE
from handeye.planning.planner import plan_program

TEXT = """\
DEFINE FETCH S G OUT
        OPEN    G
M:      MOVE    S DIRECT
        STOP    50
        CHANGE  [0 0 G] .5
        SKIPE   23
        JUMP    M
        WAIT    NO SCREW AT {S}, {T}
        JUMP    OUT

DEFINE DRIVE H NR V HOW
        ASSIGN  NR 2
        FETCH   H 1 M
        CHANGE  V NR_INCH
M:      MOVE    H
        RESTORE D HOW
        SAVE    D
        SOJG    NR M
        WAIT    "SCREW {NR} IS NOT ON {H} {V}"

        DRIVE   P A [0 0  1] LEVEL
        drive   T, B,Z LEVEL
"""
TEXT = TEXT.replace("NR_INCH", ".5")
CALLED = """\
        ASSIGN  {nr} 2
        OPEN    1
M{nr}:  MOVE    {h} DIRECT
        STOP    50
        CHANGE  [0 0 1] .5
        SKIPE   23
        JUMP    M{nr}
        WAIT    NO SCREW AT {h}, {{T}}
        JUMP    N{nr}
        CHANGE  {v} .5
N{nr}:  MOVE    {h}
        RESTORE D LEVEL
        SAVE    D
        SOJG    {nr} N{nr}
        WAIT    "SCREW {nr} IS NOT ON {h} {v}"
"""
WRITTEN = CALLED.format(nr="A", h="P", v="[0 0  1]") + CALLED.format(nr="B", h="T", v="Z")


def only(text: str) -> Diagnostic:
    (found,) = diagnose(text)
    return found


def marked(text: str, diagnostic: Diagnostic) -> list[str]:
    """What the labels of a diagnostic mark, each with its line."""
    labels = (diagnostic.primary, *diagnostic.secondary)
    source = Source(name="", text=text)
    return [f"{source.position(la.span.start)[0]}: {text[la.span.start : la.span.end]}" for la in labels]


def test_a_program_with_macros_is_the_program_written_out() -> None:
    with_macros, written = compiled(TEXT), compiled(WRITTEN)
    assert [step.operation for step in with_macros.steps] == [step.operation for step in written.steps]
    assert [step.ways for step in with_macros.steps] == [step.ways for step in written.steps]
    assert [len(step.modifiers) for step in written.steps] != [
        len(step.modifiers) for step in with_macros.steps
    ]


def test_steps_show_the_line_as_the_call_has_it_and_know_both_places() -> None:
    move = compiled(TEXT).steps[2]
    assert (move.text, move.line, move.macro) == ("MOVE P DIRECT", 3, "FETCH")
    assert [place.line for place in move.modifiers] == [21]
    assert "CHANGE [0 0  1] .5" in [step.text for step in compiled(TEXT).steps]


def test_a_label_that_is_given_is_one_where_the_call_stands() -> None:
    text = "DEFINE A OUT\nJUMP OUT\nL: PARK\nJUMP L\n\nA L\nOPEN 1\nL: OPEN 2"
    assert walk(compiled(text), {}) == ["JUMP L", "OPEN 2"]
    passed = "DEFINE B OUT\nA OUT\nL: OPEN 3\nJUMP L\n\n"
    assert walk(compiled(passed + text.replace("\nA L", "\nB L")), {}) == ["JUMP L", "OPEN 2"]


def test_a_text_shows_an_operand_as_it_is_written_without_quotes() -> None:
    text = 'DEFINE TELL A B C\nSTAGE "{A}"\nWAIT {B} "{C}"{A}{a}\n\nTELL "upper left" [1  0 -1] .50'
    program = compiled(text)
    assert program.stages == ("upper left",)
    assert program.steps[0].text == 'WAIT [1  0 -1] ".50"upper left{a}'
    assert codes(text) == ["unknown-parameter"]


def test_words_without_braces_are_no_parameters() -> None:
    found = only("DEFINE TELL A\nWAIT A SCREW\n\nTELL T")
    assert (found.code, found.help) == ("unused-parameter", "in a text, write a parameter in braces: `{A}`")


def test_braces_outside_of_macros_with_parameters_are_words() -> None:
    assert codes("DEFINE A\nWAIT {S}\n\nA\nWAIT {S}") == []


@pytest.mark.parametrize(
    ("text", "code", "labels"),
    [
        ("DEFINE A S\nMOVE S\n\nA X9", "unknown-position", ["4: X9", "2: S"]),
        ("DEFINE A S\nMOVE S\n\nA 1", "wrong-operand", ["4: 1", "2: S"]),
        ("DEFINE A S\nOPEN S\n\nA 9", "number-out-of-range", ["4: 9", "2: S"]),
        ("DEFINE A S\nMOVE S\n\nDEFINE B U\nA U\n\nB X9", "unknown-position", ["7: X9", "2: S"]),
        ("DEFINE A S\nCHANGE S 1\n\nA [0 0 0]", "zero-vector", ["4: [0 0 0]", "2: S"]),
        ("DEFINE A S\nCHANGE [0 0 S] 1\n\nA UP", "wrong-operand", ["4: UP", "2: S"]),
        ("DEFINE A S G\nTRAVEL S G\n\nCHANGE Z 1\nA .5 .2", "number-out-of-range", ["5: .2", "2: G"]),
        ("DEFINE A N\nPARK\nSKIPE N\nPARK\n\nA 42\nPARK", "unknown-error-number", ["6: 42", "3: N"]),
        ("DEFINE A L\nJUMP L\n\nA M", "unknown-label", ["4: M", "2: L"]),
        ("DEFINE A S\nMOVE S\n\nA [0 0", "unterminated-vector", ["4: ["]),
        ("DEFINE A S\nMOVE S\n\nA 1in", "unit-written", ["4: in"]),
        ("DEFINE A S\nOPEN 1 S\n\nA T", "too-many-operands", ["2: S", "4: A T"]),
        ("DEFINE A S\nTRAVEL S\n\nCHANGE Z 1\nA .2", "missing-operand", ["2: ", "5: A .2"]),
        ("DEFINE A S\nTRANS S [0 0 0 0 0 0]\nMOVE S\n\nA Q\nA Q", "position-twice", ["6: Q", "5: Q"]),
        ("DEFINE A S\nS: MOVE S\n\nA T", "parameter-name-taken", ["2: S", "1: S"]),
        ("DEFINE A S S\nMOVE S\n\nA T T", "parameter-twice", ["1: S", "1: S"]),
    ],
)  # fmt: skip
def test_a_mistake_is_marked_where_it_is_written(text: str, code: str, labels: list[str]) -> None:
    found = only(text)
    assert (found.code, marked(text, found)) == (code, labels)


@pytest.mark.parametrize(
    ("call", "code"), [("A", "missing-operand"), ("A T", "missing-operand"), ("A T 1 2", "too-many-operands")]
)
def test_a_call_with_another_number_of_operands_is_shown_the_head(call: str, code: str) -> None:
    found = only(f"{call}\nDEFINE A S G\nMOVE S\nOPEN G\n\n")
    assert (found.code, found.help) == (code, f"usage: {quoted('A S G')}")


def test_a_wrong_head_is_one_mistake_and_not_another_at_every_call() -> None:
    assert codes("DEFINE MOVE S\nPARK\n\nMOVE T") == ["macro-name-taken"]
    assert codes("DEFINE A S\nMOVE S\n\nDEFINE A\nPARK\n\nA T") == ["macro-twice"]
    assert codes("DEFINE A 5\nPARK\n\nA 5\nA") == ["wrong-operand"]


def test_two_calls_with_mistakes_are_both_told() -> None:
    assert codes("DEFINE A S\nMOVE S\n\nA Q1\nA Q2") == ["unknown-position"] * 2
    assert codes("DEFINE A N\nCLOSE .1\nSKIPE N\nPARK\n\nA 2\nA 23\nA 7") == ["error-never-raised"]


def test_what_planning_finds_is_marked_in_each_call() -> None:
    text = "DEFINE A S U\nVIA S\nMOVE U\n\nDEFINE B S\nA T S\n\nA FAR T\nA T P\nB LOW"
    program = al.compile_text(Source(name="x.al", text=text), SAMPLE)[0]
    assert program is not None
    found = plan_program(program, STANFORD, AL)[1]
    assert [marked(text, d) for d in found] == [["8: FAR"], ["10: LOW"]]


def test_a_macro_that_nothing_calls_has_its_lines_left_alone() -> None:
    text = "PARK\nDEFINE A N P\nASSIGN K N\nL: MOVE P\nSOJG K L\n\n"
    assert codes(text) == ["unused-macro"]


def test_what_grows_from_call_to_call_comes_to_an_end() -> None:
    text = "".join(f'DEFINE M{i} S\nM{i + 1} "{{S}}{{S}}{{S}}"\n\n' for i in range(18))
    assert "line-too-long" in codes(text + 'DEFINE M18 S\nWAIT "{S}"\n\nM0 "no screw"')
    circle = "DEFINE A S\nB S\n\nDEFINE B S\nA S\n\nA T"
    assert codes(circle) == ["recursive-macro"]
    assert 0 < len(codes("DEFINE A S\nMOVE S\n\n" + "".join(f"A Q{i}\n" for i in range(99)))) <= LIMIT


def test_parameters_are_ours_and_their_lines_are_read_for_more() -> None:
    found = al.extensions(Source(name="x.al", text="DEFINE A S\nLOOK S HOLD\n\nA W\nPARK"))
    assert [d.primary.span.start for d in found] == [9, 11]
