"""Mistakes of meaning: every line is right by itself, and what it comes to cannot have been meant."""

import pytest
from al_support import diagnose

from handeye.al import AL, compile_text, sewn_of
from handeye.arm.robots.stanford import STANFORD
from handeye.core.source import Source
from handeye.editor.samples import SAMPLE
from handeye.planning.planner import plan_program


def codes(text: str) -> list[str]:
    return [d.code for d in diagnose(text)]


# -- tests of errors ----------------------------------------------------------------------------------


def test_a_test_that_only_skips_the_next_one_is_told() -> None:
    (told,) = diagnose("L: CLOSE .1 .2\nSKIPE 2\nSKIPE 7\nJUMP L\nPARK")
    assert told.message == "the program continues in the same way whether or not error 2 was raised"


@pytest.mark.parametrize(
    "tests",
    [
        "SKIPN 2\nJUMP L\nSKIPN 7\nJUMP L",  # one after the other
        "SKIPE 2\nSKIPN 7\nJUMP L",  # only another error leads on
        "SKIPN 2\nSKIPE 7\nJUMP L",  # told otherwise: error 7 cannot be there with error 2
        "SKIPE 2\nSKIPE 7\nMOVE T",  # error 2 does not matter, and is cleared
    ],
)
def test_tests_that_each_lead_elsewhere_are_not(tests: str) -> None:
    assert "test-of-no-effect" not in codes(f"L: CLOSE .1 .2\n{tests}\nPARK")


def test_a_test_that_is_at_fault_already_is_told_once() -> None:
    assert codes("L: CLOSE .1\nSKIPE 2\nSKIPE 23\nJUMP L\nPARK") == ["error-never-raised"]


# -- layout -------------------------------------------------------------------------------------------

BODY = (
    "        CLOSE   .1\n        SKIPN   2\n            OPEN    1\n{}            WAIT    NO PEG\n        PARK"
)


@pytest.mark.parametrize("between", ["", "\n", "; and then\n"])
def test_a_body_behind_a_skip_is_told(between: str) -> None:
    (told,) = diagnose(BODY.format(between))
    assert told.code == "skips-one-only"
    assert [label.text for label in told.secondary] == ["this line is always executed"]


@pytest.mark.parametrize(
    "text",
    [
        "        CLOSE   .1\n        SKIPN   2\n            WAIT    NO PEG\n        PARK",  # one line is right
        "        CLOSE   .1\nSKIPN   2\n        WAIT    NO PEG\n        PARK",  # the skip stands farther out
        "        CLOSE   .1\n\tSKIPN   2\n\tWAIT    NO PEG\n        PARK",  # a tab is eight blanks
        "        MOVE    P\n        SAVE    H\n        CLOSE   .1\n        SKIPN   2\n"
        "            MOVE    T\n            RESTORE H\n        PARK",  # one step, with its RESTORE
        # a STAGE is none
        '        CLOSE   .1\n        SKIPN   2\n            STAGE   "A"\n            PARK\n        PARK',
        # a way each
        "L:      CLOSE   .1\n        SKIPE   2\n            JUMP    L\n            MOVE    T\n        PARK",
        # a test in a test
        "L:      CLOSE   .1 .2\n        SKIPE   2\n          SKIPN   7\n            JUMP    L\n        PARK",
    ],
)
def test_lines_that_only_stand_unevenly_are_not(text: str) -> None:
    assert diagnose(text) == []


def test_a_label_before_the_skip_makes_no_difference() -> None:
    text = BODY.format("").replace("        CLOSE", "L:      CLOSE", 1).replace("PARK", "JUMP    L")
    assert "skips-one-only" in codes(text)


def test_a_blank_line_within_a_macro_is_told() -> None:
    (told,) = diagnose("DEFINE DOWN\nSTOP 50\n\nCHANGE Z -1\n\nMOVE T\nDOWN\nPARK")
    assert (
        told.message == "macro `DOWN` ends with `STOP`, but the motion that it modifies is outside the macro"
    )


@pytest.mark.parametrize("behind", ["; the work\nTURN T 9", "MOVE T", "OPEN 1", 'STAGE "the work"'])
def test_a_macro_of_modifiers_is_not(behind: str) -> None:
    assert diagnose(f"DEFINE GENTLY\nSTOP 50\n\n{behind}\nGENTLY\nCHANGE Z -1") == []


def test_what_stands_behind_a_macro_stands_in_the_same_file() -> None:
    torn, whole = "DEFINE DOWN\nSTOP 50\n\nCHANGE Z -1\n\n", "DEFINE GENTLY\nSTOP 50\n\n"
    files = {"lib.al": "CHANGE Z 1\n"}
    assert "macro-ends-early" in codes_of(f"REQUIRE lib.al\n{torn}MOVE T\nDOWN\nPARK", files)
    assert "macro-ends-early" not in codes_of(f"REQUIRE lib.al\nGENTLY\nCHANGE Z -1\n{whole}", files)


def codes_of(text: str, files: dict[str, str]) -> list[str]:
    """The codes of what is said of a text that requires some files."""
    return [d.code for d in compile_text(sewn_of(Source(name="x.al", text=text), files), SAMPLE)[1]]


def test_a_macro_of_a_file_that_is_required_in_the_wrong_place_is_one_mistake() -> None:
    text = "DEFINE GRAB\nCLOSE .1\nREQUIRE moves.al\n\nMOVE P\nGRAB\nSETDOWN"
    assert codes_of(text, {"moves.al": "DEFINE SETDOWN\nPARK\n\n"}) == ["require-in-macro"]


# -- differences --------------------------------------------------------------------------------------


def test_what_is_saved_only_where_nothing_leads_is_never_saved() -> None:
    assert codes("MOVE P\nSAVE G\nJUMP L\nSAVE H\nL: MOVE T\nRESTORE H\nPARK") == [
        "unreachable-code",
        "never-saved",
    ]


# -- the hand -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("grasp", ["CLOSE .1", "CENTER .1"])
def test_a_touch_of_closed_fingers_is_told(grasp: str) -> None:
    (told,) = diagnose(f"{grasp}\nTOUCH 3\nCHANGE Z -1")
    assert told.message.endswith(
        "the fingers are closed, and the part between them ends the motion immediately"
    )


@pytest.mark.parametrize("hand", ["", "CLOSE .1\nOPEN 1\n", "CLOSE .1\nSKIPE 2\nOPEN 1\n"])
def test_a_touch_of_fingers_that_may_be_open_is_not(hand: str) -> None:
    assert diagnose(f"{hand}TOUCH 3\nCHANGE Z -1") == []


# -- what the camera is to see ------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("look", "lacks"),
    [
        ("GENERAL GASKET V", "`region` and `outline`"),
        ("GENERAL BASE V\nSPECIFIC GASKET V", "two `holes`"),
        ("LOOK W HOLD\nINSPECT GASKET V W", "two `holes`"),
    ],
)
def test_a_part_of_which_too_little_is_taught_is_told_before_anything_moves(look: str, lacks: str) -> None:
    (told,) = (d for d in diagnose(f"LOOK V\n{look}") if d.severity == "error")
    assert told.code == "part-not-described"
    assert told.message.endswith(f"cannot find `GASKET` without its {lacks}")
    assert (told.help or "").endswith("parts with complete data: `BASE`")


def test_a_comparison_with_a_picture_taken_as_the_camera_saw_fit_is_told() -> None:
    (told,) = diagnose("LOOK A\nLOOK B\nINSPECT BASE A B")
    assert (told.code, told.help) == (
        "compared-without-hold",
        "`LOOK B HOLD` keeps the voltage of the earlier picture",
    )
    assert diagnose("LOOK A\nLOOK B HOLD\nINSPECT BASE A B") == []


def test_two_pictures_in_the_wrong_order_are_told_so() -> None:
    (told,) = diagnose("LOOK A\nLOOK B HOLD\nINSPECT BASE B A")
    assert (told.code, told.message) == (
        "compared-without-hold",
        "picture `B` is named as the earlier picture, but is taken with `HOLD`, after picture `A`",
    )


# -- what was meant -----------------------------------------------------------------------------------


def test_a_jump_back_over_an_unused_label_is_one_mistake() -> None:
    text = "L1: MOVE P\nSEARCH .07\nL2: MOVE T\nSTOP 9\nCHANGE Z -1\nSKIPE 23\nAOJ L1\nJUMP L1"
    told = diagnose(text)
    assert [d.code for d in told if d.code != "endless-loop"] == ["search-begun-anew"]
    (begun,) = (d for d in told if d.code == "search-begun-anew")
    assert [label.text for label in begun.secondary] == [
        "executed again in every round",
        "nothing jumps here",
    ]


def test_a_position_that_only_a_comment_goes_to_is_seen_there() -> None:
    (told,) = diagnose("TRANS ROD [24 36 3 90 90 0]\nOPEN 1 ; MOVE ROD\nPARK")
    assert (told.code, told.help) == (
        "unused-position",
        "line 2 uses the name, but only in a comment, after a `;`",
    )


@pytest.mark.parametrize("comment", ["; look for the ROD", "; OPEN ROD", '\nWAIT "; MOVE ROD"'])
def test_a_position_that_a_comment_only_speaks_of_is_not(comment: str) -> None:
    (told,) = diagnose(f"TRANS ROD [24 36 3 90 90 0]\nOPEN 1 {comment}\nPARK")
    assert (told.code, told.help) == ("unused-position", None)


def test_what_is_taught_is_not_required() -> None:
    (told,) = diagnose("REQUIRE water_pump.toml\nPARK")
    assert told.message == "`water_pump.toml` is a taught file, not a file of instructions"


def planned(text: str) -> list[str | None]:
    """What helps against what the planner finds."""
    program, found = compile_text(Source(name="x.al", text=text), SAMPLE)
    assert program is not None, found
    return [d.help for d in plan_program(program, STANFORD, AL)[1]]


def test_angles_in_radians_are_known_where_they_lead_nowhere() -> None:
    assert planned("TRANS A [26 36 5 1.5708 1.571 0]\nMOVE A") == [
        "O, A and T are in degrees, but 1.5708 looks like 90 degrees in radians"
    ]
    assert planned("TRANS A [26 36 5 3.14 2 0]\nMOVE A") == [
        "O, A and T are in degrees, but 3.14 looks like 180 degrees in radians"
    ]


def test_angles_that_are_merely_wrong_are_not_taken_for_radians() -> None:
    assert planned("TRANS A [26 36 5 0 2 0]\nMOVE A") == [
        "turn the hand: other angles O, A, T can be within the limits"
    ]


def test_of_a_position_out_of_reach_it_is_said_what_it_is_counted_from() -> None:
    (help,) = planned("TRANS RIM [44.5 29.5 3.75 90 90 0] OF BASE\nMOVE RIM")
    assert (help or "").endswith("closer to the arm; the position is relative to `BASE`")
