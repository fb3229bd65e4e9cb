"""Where a compiled program leads: error tests, jumps, searches and macros, without an arm.

How the executor follows it, the tests of `tests/execution` show.
"""

import pytest
from al_support import LISTING, codes, compiled, diagnose, walk

from handeye.program.flow_operations import Search

DOWN = "CHANGE [0 0 -1] 0.6"


def test_skip_of_the_last_instruction_ends_the_program() -> None:
    assert walk(compiled("PARK\nSKIPN 23\nOPEN 1"), {}) == ["PARK", "SKIPN 23"]
    assert walk(compiled("PARK\nSKIPE 23\nOPEN 1"), {"PARK": [23]}) == ["PARK", "SKIPE 23"]


def test_skip_counts_a_move_and_its_restores_as_one() -> None:
    text = "SAVE H\nPARK\nSKIPN 1\nMOVE T\nRESTORE H\nOPEN 1"
    assert walk(compiled(text), {})[-2:] == ["SKIPN 1", "OPEN 1"]


def test_pin_goes_in_at_the_first_place_when_the_hole_is_there() -> None:
    trace = walk(compiled(LISTING), {DOWN: [23, None]})
    assert [t for t in trace if t[:3] == "AOJ"] == []
    assert trace[-4:] == ["SAVE  H", "OPEN  .5", "CLOSE 0.1", "OPEN  1"]


def test_search_goes_on_when_the_pin_strikes_the_base() -> None:
    trace = walk(compiled(LISTING), {DOWN: [None, 23, None]})
    assert [t for t in trace if t[:3] == "AOJ"] == ["AOJ   L1"]
    assert "SAVE  H" in trace


def test_search_goes_on_when_the_pin_misses_everything() -> None:
    trace = walk(compiled(LISTING), {DOWN: [23, 23, 23, None]})
    assert trace.count("MOVE  T") == 3
    assert trace.count("SAVE  H") == 1


@pytest.mark.parametrize(
    ("text", "places"),
    [("", 49), ("ALONG 90", 9), ("STEPS 4", 81), ("STEPS 1", 9), ("ALONG 90 STEPS 2", 5)],
)
def test_search_extends_as_far_as_it_says(text: str, places: int) -> None:
    search = compiled(f"SEARCH .07 {text}\nL: MOVE T\nAOJ L").steps[0].operation
    assert isinstance(search, Search)
    assert search.limit == places


def test_jump_to_a_label_behind_everything_ends_the_program() -> None:
    assert walk(compiled("JUMP END\nPARK\nEND:"), {}) == ["JUMP END"]


def test_label_on_a_line_of_its_own_belongs_to_the_next_instruction() -> None:
    assert walk(compiled("JUMP A\nPARK\nA:\n; here\nOPEN 1"), {}) == ["JUMP A", "OPEN 1"]


def test_label_on_a_definition_belongs_to_what_follows_the_macro() -> None:
    assert walk(compiled("JUMP L\nL: DEFINE A\nPARK\n\nOPEN 1\nA"), {}) == ["JUMP L", "OPEN 1", "PARK"]


def test_label_before_a_modifier_leads_to_its_motion() -> None:
    assert walk(compiled("JUMP A\nPARK\nA: STOP 5\nMOVE T"), {}) == ["JUMP A", "MOVE T"]


def test_macro_is_replaced_by_its_instructions() -> None:
    program = compiled("DEFINE GRASP\nMOVE P\nCLOSE .1\n\nGRASP\nPARK\ngrasp")
    assert walk(program, {}) == ["MOVE P", "CLOSE .1", "PARK", "MOVE P", "CLOSE .1"]


@pytest.mark.row(43)
def test_macro_without_a_blank_line_is_reported() -> None:
    assert codes("PARK\nDEFINE GRASP\nMOVE P\nCLOSE .1\n") == ["unterminated-macro"]
    assert codes("GRASP\nDEFINE GRASP\nMOVE P\nCLOSE .1\n\n") == []


@pytest.mark.parametrize(
    ("define", "message", "help"),
    [
        (
            "DEFINE GRASP CLOSE .1",
            "`CLOSE` is an instruction, so it cannot be a parameter",
            "write the instructions of a macro on the lines below",
        ),
        ("DEFINE GRASP Y", "`Y` is an axis of the table, so it cannot be a parameter", None),
        ("DEFINE GRASP nil", "`nil` is a word of the language, so it cannot be a parameter", None),
        (
            "DEFINE GRASP S 50",
            "a parameter must be a name, not `50`",
            "give numbers and vectors in the calls of the macro",
        ),
    ],
)
def test_what_cannot_be_a_parameter_is_told_once(define: str, message: str, help: str | None) -> None:
    (diagnostic,) = diagnose(f"{define}\nMOVE P\n\nGRASP 1")
    assert len(diagnose(f"{define} U\nMOVE P\n\nGRASP 1 2")) == 1
    assert (diagnostic.message, diagnostic.help) == (message, help)


def test_macro_inside_a_macro_is_reported_as_a_missing_blank_line() -> None:
    (diagnostic,) = diagnose("DEFINE A\nPARK\nDEFINE B\nPARK\n\nA\nB")
    assert (diagnostic.code, diagnostic.primary.text) == (
        "unterminated-macro",
        "`DEFINE B` comes before the end of the macro",
    )


def test_labels_of_a_macro_are_its_own_in_each_call() -> None:
    text = "DEFINE TWICE\nL: OPEN 1\nSKIPN 2\nJUMP L\n\nTWICE\nTWICE"
    trace = walk(compiled(text), {"OPEN 1": [2, None, 2, None]})
    assert [t for t in trace if t == "OPEN 1"] == ["OPEN 1"] * 4


def test_skip_counts_a_macro_as_one_instruction() -> None:
    text = "DEFINE A\nOPEN 1\nOPEN 2\n\nPARK\nSKIPN 2\nA\nOPEN 3"
    assert walk(compiled(text), {}) == ["PARK", "SKIPN 2", "OPEN 3"]


def test_skip_at_the_end_of_a_macro_skips_what_follows_the_call() -> None:
    text = "DEFINE A\nPARK\nSKIPN 2\n\nA\nOPEN 1\nOPEN 2"
    assert walk(compiled(text), {}) == ["PARK", "SKIPN 2", "OPEN 2"]


def test_macros_that_multiply_are_stopped() -> None:
    text = "".join(f"DEFINE M{i}\n" + f"M{i + 1}\n" * 10 + "\n" for i in range(9)) + "DEFINE M9\nPARK\n\nM0"
    assert codes(text) == ["program-too-long"]
