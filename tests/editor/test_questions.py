"""What an editor asks about a text: hover, completion, definition, references, rename, outline."""

import json
from pathlib import Path

import pytest
from documents import TAUGHT, document, edited, pointed
from hypothesis import given
from hypothesis import strategies as st

from handeye.al import INSTRUCTIONS
from handeye.core.diagnostics import arranged
from handeye.core.errors import InvalidInput
from handeye.core.source import Source
from handeye.editor.completion import completions
from handeye.editor.document import Document
from handeye.editor.fixes import fixes
from handeye.editor.hover import SI, hover
from handeye.editor.navigation import definition, outline, references, rename
from handeye.editor.occurrences import taught_occurrences
from handeye.program.taught import load_taught

PLANS = Path(__file__).parents[2] / "plans"
PUMP = (PLANS / "water_pump.al").read_text(encoding="utf-8")


def told(marked: str) -> str:
    found = hover(*pointed(marked))
    assert found is not None
    return found.text


def proposed(marked: str) -> list[str]:
    return [proposal.text for proposal in completions(*pointed(marked))[1]]


def places(marked: str, *, made: bool = False) -> list[str]:
    """Lines a name is made on, or made or used on, as `line:column`, of the taught file as `taught:name`."""
    text, at = pointed(marked, TAUGHT)
    found = definition(text, at) if made else references(text, at)
    return [
        f"taught:{TAUGHT[f.span.start : f.span.end]}"
        if f.taught
        else ":".join(map(str, text.source.position(f.span.start)))
        for f in found
    ]


def renamed(marked: str, new: str) -> tuple[str, str]:
    text, at = pointed(marked, TAUGHT)
    edits = rename(text, at, new)
    return edited(text.text, edits), edited(TAUGHT, edits, taught=True)


# --- hover ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("op", INSTRUCTIONS)
def test_an_instruction_tells_its_usage_and_what_it_does(op: str) -> None:
    text = told(f"|{op.lower()}")
    assert f"`{INSTRUCTIONS[op].usage}`" in text
    assert INSTRUCTIONS[op].help in text


@pytest.mark.parametrize(
    ("marked", "text"),
    [
        ("OPEN |1", "gap: 1 in = 25.4 mm"),
        ("CHANGE [0 0 -1] |0.6", "distance: 0.6 in = 15.24 mm"),
        ("CHANGE [0 0 -1] 1 |.5", "speed: 0.5 in/s = 12.7 mm/s"),
        ("STOP [0 0 |-50]", "force: -50 oz = -13.9 N"),
        ("STOP |50", "force: 50 oz = 13.9 N"),
        ("TORQUE |300", "torque: 300 oz-in = 2.118 N m"),
        ("TURN T |90", "angle: 90 degrees = 1.571 rad"),
        ("TOOL |60", "speed: 60 rpm = 6.283 rad/s"),
        ("LENS |25", "mm: 25 mm = 0.9843 in"),
        ("TRANS X [1 2 3 0 |90 0]", "a: 90 degrees = 1.571 rad"),
        ("TRANS X [|1 2 3 0 90 0]", "x: 1 in = 25.4 mm"),
    ],
)
def test_a_number_is_told_in_both_systems_of_units(marked: str, text: str) -> None:
    assert told(marked) == text


def test_every_unit_of_the_language_has_another() -> None:
    units = {unit.name for i in INSTRUCTIONS.values() for o in i.operands for unit in o.units}
    assert units - {""} <= set(SI)


def test_an_error_number_tells_what_it_means() -> None:
    assert told("SKIPE |23") == "error 23: the motion ended without meeting the force of its STOP"


def test_a_position_tells_where_it_is_and_which_joints_reach_it() -> None:
    text = told("MOVE |T")
    assert text.startswith("position `T`\n\nhand at (25, 38, 4) in; O, A, T 90, 90, 0 degrees\n\njoints: ")
    assert text.count("°") == 5
    assert "boom" in text


def test_a_position_of_a_part_is_told_in_the_table_and_in_the_part() -> None:
    text = told("TRANS X [1 2 3 0 90 0] OF BASE\nMOVE |X")
    assert "hand at (26, 40, 3) in; O, A, T 0, 90, 0 degrees, as planned" in text
    assert "relative to part `BASE`: (1, 2, 3) in; O, A, T 0, 90, 0 degrees" in text


def test_a_position_out_of_reach_tells_the_joint() -> None:
    assert "out of the arm's reach: joint 3 (boom) would have to be" in told("MOVE |FAR")


def test_the_word_park_is_an_instruction_that_names_a_position() -> None:
    assert told("|PARK").startswith("`PARK`")


def test_labels_macros_and_differences_tell_where_they_are_made() -> None:
    assert told("JUMP |L\nL: OPEN 1") == "label `L`, line 2\n\n```armal\nL: OPEN 1\n```"
    assert told("|A\nDEFINE A\nOPEN 1\n\n") == "macro `A`, line 2\n\n```armal\nDEFINE A\nOPEN 1\n```"
    assert "line 1, 2" in told("SAVE H\nSAVE H\nMOVE T\nRESTORE |H")


def test_comments_and_what_is_unknown_tell_nothing() -> None:
    assert hover(*pointed("OPEN 1 ;OP|EN")) is None
    assert hover(*pointed("OPEN 1 |2")) is None
    assert hover(*pointed("JUMP |L")) is None


# --- completion ----------------------------------------------------------------------------------


def test_a_line_begins_with_an_instruction_or_a_macro() -> None:
    assert proposed("DEFINE GRASP\nPARK\n\nL: |") == [*INSTRUCTIONS, "DEFINE", "GRASP"]


@pytest.mark.parametrize(
    ("marked", "words"),
    [
        ("MOVE |", ["FAR", "LOW", "P", "PARK", "T"]),
        ("MOVE T |", ["DIRECT"]),
        ("TRANS X [0 0 0 0 0 0] |", ["OF"]),
        ("TRANS X [0 0 0 0 0 0] OF |", ["BASE", "GASKET"]),
        ("L1: PARK\nJUMP |", ["L1"]),
        ("LOOK WIDE\nGENERAL BASE |", ["WIDE"]),
        ("LOOK WIDE |", ["HOLD"]),
        ("SAVE H\nMOVE T\nRESTORE |", ["H"]),
        ("AIM |", ["FAR", "LOW", "P", "PARK", "T", "BASE", "GASKET"]),
        ("LENS |", ["25", "50"]),
        ("FORCE [0 0 -9] |", ["NIL", "X", "Y", "Z"]),
        ("OPEN |", []),
        ("OPEN 1 |", []),
        ("OPEN 1 ;|", []),
        ('STAGE "|', []),
    ],
)
def test_an_operand_is_one_of_those_its_place_takes(marked: str, words: list[str]) -> None:
    assert proposed(marked) == words


def test_an_error_number_comes_with_its_meaning() -> None:
    _, found = completions(*pointed("SKIPE |"))
    assert ("23", "the motion ended without meeting the force of its STOP") in [
        (p.text, p.detail) for p in found
    ]


def test_what_has_been_typed_of_a_word_is_replaced() -> None:
    text, at = pointed("MOVE PA|")
    span, found = completions(text, at)
    assert text.text[span.start : span.end] == "PA"
    assert "PARK" in [p.text for p in found]


# --- definition, references, rename --------------------------------------------------------------


def test_a_name_leads_to_where_it_is_made() -> None:
    assert places("JUMP |L\nL: PARK", made=True) == ["2:1"]
    assert places("MOVE |P", made=True) == ["taught:P"]
    assert places("MOVE |T", made=True) == ["taught:T"]
    assert places("AIM |BASE", made=True) == ["taught:BASE"]
    assert places("MOVE T\nRESTORE |H\nSAVE H\nSAVE H", made=True) == ["3:6", "4:6"]
    assert places("MOVE |NOWHERE", made=True) == []


def test_references_are_of_one_kind_only() -> None:
    assert places("|T: MOVE T\nJUMP T\nSAVE T") == ["1:1", "2:6"]
    assert places("T: MOVE |T\nTURN T 9") == ["1:9", "2:6", "taught:T"]
    assert places("AIM |BASE") == ["1:5", "taught:BASE", "taught:BASE", "taught:BASE"]


def test_labels_of_macros_are_their_own() -> None:
    text = "DEFINE A\nL: PARK\nJUMP {}L\n\nL: A\nJUMP {}L"
    assert places(text.format("|", "")) == ["2:1", "3:6"]
    assert places(text.format("", "|")) == ["5:1", "6:6"]


def test_a_jump_out_of_a_macro_finds_the_label_of_the_text() -> None:
    assert places("DEFINE A\nJUMP |L\n\nL: A") == ["2:6", "4:1"]


def test_rename_changes_the_script_and_what_is_taught() -> None:
    script, taught = renamed("T: MOVE |T\nJUMP T", "BORE")
    assert script == "T: MOVE BORE\nJUMP T"
    assert taught == TAUGHT.replace("[positions.T]", "[positions.BORE]")
    script, taught = renamed("GENERAL |BASE W", "CASTING")
    assert script == "GENERAL CASTING W"
    assert taught.count("CASTING") == 3


@pytest.mark.parametrize(
    ("marked", "new", "why"),
    [
        ("L: JUMP |L", "1L", "names consist of letters"),
        ("L: JUMP |L", "OPEN", "a word of the language"),
        ("MOVE |T", "P", "there is already a position `P`"),
        ("MOVE |T", "BASE", "there is already a position `BASE`"),
        ("M: L: JUMP |L", "M", "there is already a label `M`"),
        ("|PARK", "HOME", "`PARK` is a word of the language"),
        ("MOVE |PARK", "HOME", "`PARK` is a word of the language"),
        ("MOVE |LOW", "HIGH", "the definition of position `LOW` is not found in the taught file"),
        ("MOVE |T ", "of", "a word of the language"),
        ("OPEN |1", "X", "there is no name here"),
    ],
)
def test_what_cannot_be_renamed_says_why(marked: str, new: str, why: str) -> None:
    with pytest.raises(InvalidInput, match=why):
        renamed(marked, new)


def test_every_name_taught_for_the_pump_is_found_in_its_file() -> None:
    text = (PLANS / "water_pump.toml").read_text(encoding="utf-8")
    taught = load_taught(PLANS / "water_pump.toml")
    made = [o.name for o in taught_occurrences(text) if o.makes]
    assert sorted(made) == sorted([*taught.positions, *taught.parts])
    used = [o.name for o in taught_occurrences(text) if not o.makes]
    parts = [position.of for position in taught.positions.values() if position.of is not None]
    assert sorted(used) == sorted([*parts, *(at for held in taught.held.values() for at in held.positions)])


# --- outline -------------------------------------------------------------------------------------


def test_the_outline_of_the_pump_is_its_stages() -> None:
    found = outline(document(PUMP))
    stages = [each for each in found if each.kind == "stage"]
    plan = json.loads((PLANS / "water_pump.plan.json").read_text(encoding="utf-8"))
    assert [stage.name for stage in stages] == plan["program"]["stages"]
    assert [part.name for part in stages[1].parts if part.kind == "label"] == [
        "GRASP", "LA", "LB", "WALL", "ACROSS", "FELT", "MISSED", "GONE", "AFRESH", "HELD",
    ]  # fmt: skip
    assert (found[1].name, [part.name for part in found[1].parts]) == ("FETCH", ["M", "OVER", "RIM", "DS"])


def test_what_stands_before_the_first_stage_and_macros_have_their_place() -> None:
    found = outline(document('L: PARK\nDEFINE A\nOPEN 1\n\nSTAGE "one"\nSAVE H'))
    assert [(s.name, s.kind, [p.name for p in s.parts]) for s in found] == [
        ("program", "stage", ["L"]),
        ("A", "macro", []),
        ("one", "stage", ["H"]),
    ]


# --- parameters of macros ------------------------------------------------------------------------

TAKING = """\
DEFINE TAKE S G
        MOVE    S
        OPEN    G
        WAIT    "NO PIN AT {S}"
        SAVE    OFF

DEFINE BOTH U
        TAKE    U 1
        TAKE    T 1

        BOTH    P
"""


def test_a_macro_is_shown_with_its_head_and_a_parameter_with_that_line() -> None:
    assert told(TAKING.replace("TAKE    T", "|TAKE    T")).splitlines()[3] == "DEFINE TAKE S G"
    assert told(TAKING.replace("MOVE    S", "MOVE    |S")) == (
        "parameter `S`, line 1\n\n```armal\nDEFINE TAKE S G\n```"
    )
    assert told(TAKING.replace("BOTH    P", "BOTH    |P")).startswith("position `P`")


def test_a_parameter_is_found_among_operands_in_texts_and_nowhere_else() -> None:
    expected = ["1:13", "2:17", "4:29"]
    assert places(TAKING.replace("MOVE    S", "MOVE    |S")) == expected
    assert places(TAKING.replace("{S}", "{|S}")) == expected
    assert renamed(TAKING.replace("TAKE S G", "TAKE |S G"), "PLACE_OF")[0] == (
        TAKING.replace("TAKE S", "TAKE PLACE_OF")
        .replace("MOVE    S", "MOVE    PLACE_OF")
        .replace("{S}", "{PLACE_OF}")
    )


def test_an_operand_of_a_call_is_the_name_of_what_the_macro_does_with_it() -> None:
    assert renamed(TAKING.replace("BOTH    P", "BOTH    |P"), "PIN")[0] == TAKING.replace(
        "BOTH    P", "BOTH    PIN"
    )
    assert places("DEFINE A L\nJUMP L\n\nA |M\nM: PARK") == ["4:3", "5:1"]
    assert places("DEFINE A N\nLOOK N\n\nA |W\nGENERAL BASE W") == ["4:3", "5:14"]


@pytest.mark.parametrize(
    ("marked", "new"),
    [
        (TAKING.replace("TAKE S", "TAKE |S"), "G"),
        (TAKING.replace("TAKE S", "TAKE |S"), "X"),
        (TAKING.replace("TAKE S", "TAKE |S"), "park"),
        (TAKING.replace("BOTH U", "BOTH |U"), "T"),
        (TAKING.replace("TAKE    T", "TAKE    |T"), "U"),
    ],
)
def test_no_name_comes_to_stand_for_something_else_in_a_macro(marked: str, new: str) -> None:
    with pytest.raises(InvalidInput):
        renamed(marked, new)


def test_parameters_are_proposed_in_their_macro_and_what_fits_in_a_call() -> None:
    assert proposed("DEFINE A S\nMOVE |\n\nA T")[0] == "S"
    assert proposed("DEFINE A S\nMOVE S\n\nMOVE |")[0] == "FAR"
    assert proposed("DEFINE A S\nMOVE S\n\nA |") == ["FAR", "LOW", "P", "PARK", "T"]
    assert proposed("DEFINE A S\nMOVE S\n\nA T |") == []


def test_the_outline_has_macros_without_their_parameters() -> None:
    assert [(s.name, s.kind) for s in outline(document(TAKING))][:2] == [("TAKE", "macro"), ("BOTH", "macro")]


# --- whatever is typed ---------------------------------------------------------------------------


@given(data=st.data())
def test_no_text_in_the_making_is_too_broken_to_be_asked_about(data: st.DataObject) -> None:
    lines = PUMP.split("\n")
    first = data.draw(st.integers(0, len(lines) - 8))
    text = "\n".join(lines[first : first + 8])
    start = data.draw(st.integers(0, len(text)))
    end = data.draw(st.integers(start, min(start + 12, len(text))))
    typed = data.draw(st.text(st.sampled_from('[]":;., -1LAMOVETRDEFINEOF\t\n\r\0é'), max_size=12))
    text = text[:start] + typed + text[end:]
    at = data.draw(st.integers(0, len(text)))
    asked = Document(source=Source(name="x.al", text=text), taught=load_taught(PLANS / "water_pump.toml"))
    hover(asked, at)
    completions(asked, at)
    assert set(definition(asked, at)) <= set(references(asked, at))
    for diagnostic in arranged(asked.compiled[1]):
        for fix in fixes(asked, diagnostic):
            assert all(0 <= e.span.start <= e.span.end <= len(text) for e in fix.edits)
    for symbol in outline(asked):
        assert symbol.span.start <= symbol.at.start <= symbol.at.end <= symbol.span.end
