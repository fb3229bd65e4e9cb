"""TRIG's commands: what they add, ask and refuse."""

import pytest
from trig_sessions import BUCKET, Typist

from handeye.core.errors import InvalidInput
from handeye.core.units import OUNCE_FORCE
from handeye.systems.trig.language.command_input import Script, hear
from handeye.systems.trig.language.command_table import COMMANDS, TABLE, TrigCommand
from handeye.systems.trig.language.graph import NONE, TOP
from handeye.systems.trig.language.place import Place

GUARDED = "MG DOWN\nZ 10 RECORD\n2\n(0 0 1)\n"


def refused(typist: Typist, line: str) -> str:
    """The sentence with which a line is refused; the program stays as it was."""
    before = [(step.id, step.name, step.position, step.threshold, step.vector) for step in typist.steps]
    cursor = typist.active
    with pytest.raises(InvalidInput) as error:
        typist.type(line)
    assert [(s.id, s.name, s.position, s.threshold, s.vector) for s in typist.steps] == before
    assert typist.active is cursor
    return str(error.value)


def test_there_are_the_37_commands_of_the_paper() -> None:
    assert len(TABLE) == len(COMMANDS) == 37


@pytest.mark.trig_row(1)
def test_a_session_begins_with_an_empty_program() -> None:
    typist = Typist()
    assert (typist.active.id, typist.active.sons, typist.steps) == (TOP, [NONE], [])


@pytest.mark.trig_row(2)
def test_a_first_move_is_taught_absolute() -> None:
    typist = Typist("M CENTER\nX 10 Y 20 Z 30 RECORD")
    assert [(step.name, step.position) for step in typist.steps] == [(None, "CENTER")]
    center = typist.session.program.positions["CENTER"]
    assert (center.relative, center.data.measures()) == (False, (10, 20, 30, 0, 0, 0))
    assert typist.active is typist.steps[0]


@pytest.mark.trig_row(3)
def test_ten_commands_of_the_paper_make_ten_steps_and_ask_twice() -> None:
    typist = Typist()
    typist.type(BUCKET)
    assert [step.position or step.type for step in typist.steps] == [
        "CENTER", "BLOCK", "grasp", "OVER-BUCKET", "ungrasp", "OTHER-BLOCK", "grasp", "BLOCK", "ungrasp", "CENTER"
    ]  # fmt: skip
    assert {step.name for step in typist.steps} == {None}
    assert BUCKET.count("Move to the predefined location? Yes.") == 2
    assert not any(position.relative for position in typist.session.program.positions.values())
    assert len(typist.session.program.positions) == 4


@pytest.mark.trig_row(4)
def test_answering_no_adds_no_step_and_moves_nothing() -> None:
    typist = Typist("M CENTER\nX 10 RECORD\nM OTHER\nX 50 RECORD\nM CENTER\nNo")
    assert (len(typist.steps), typist.at[0], typist.told) == (2, 50, ["cancelled"])


@pytest.mark.trig_row(6)
@pytest.mark.parametrize(
    ("before", "relative"),
    [
        ("", False),
        ("MA X\nX 10 RECORD\n", False),
        ("MR X\nX 10 RECORD\n", True),
        ("MR X\nX 10 RECORD\nGRASP\n", True),
        ("MR\nX 10 RECORD\nSAVPOS Q\n", True),
    ],
)
def test_a_move_that_is_not_defined_is_of_the_kind_of_the_move_above(before: str, relative: bool) -> None:
    typist = Typist(f"{before}M\nX BY 5 RECORD")
    assert typist.session.program.positions[typist.active.position or ""].relative is relative


@pytest.mark.trig_row(7)
def test_a_move_that_is_defined_is_of_its_own_kind() -> None:
    typist = Typist("MR STEP\nX BY 5 RECORD\nMA PLACE\nX 100 RECORD\nM STEP\nYes")
    assert (typist.active.position, typist.at[0]) == ("STEP", 105)


@pytest.mark.trig_row(8)
def test_a_minus_goes_the_other_way_of_a_relative_position() -> None:
    typist = Typist("MR STEP\nX BY 5 Z BY -20 RECORD\nMR -STEP\nYes\n")
    assert (typist.active.negate, typist.at) == (True, (0, 0, 300))
    typist.type("MA CENTER\nX 0 RECORD")
    assert (
        refused(typist, "M -CENTER")
        == "there is no -CENTER: CENTER is an absolute position, and only a relative position has an opposite"
    )
    assert "NEW is not defined" in refused(typist, "M -NEW")


@pytest.mark.trig_row(9)
def test_a_kind_that_does_not_fit_and_a_position_that_is_not_are_refused() -> None:
    typist = Typist("MR X\nX BY 5 RECORD\n")
    assert refused(typist, "MA X") == "X is already defined, as relative; to go there, use M"
    assert refused(typist, "CP NOPE") == "there is no position `NOPE`; known: `X`"


@pytest.mark.trig_row(10)
def test_a_threshold_is_changed_on_a_guarded_step_only() -> None:
    typist = Typist("M A\nX 5 RECORD\n")
    assert "not guarded" in refused(typist, "CT 5")
    typist.type(f"{GUARDED}CT 5")
    assert typist.active.threshold == pytest.approx(5 * OUNCE_FORCE)


@pytest.mark.trig_row(11)
def test_a_force_vector_stands_in_parentheses() -> None:
    typist = Typist(f"{GUARDED}CV (0 0 2)")
    assert typist.active.vector == (0, 0, 2)
    assert refused(typist, "CV 0 0 2") == "`0 0 2` is not a force vector; write it like (0 0 1)"


@pytest.mark.trig_row(34)
def test_the_way_between_two_places_becomes_a_relative_position() -> None:
    typist = Typist("CALPOS\nFREE\nX BY 30 RECORD\nENDCAL V")
    position = typist.session.program.positions["V"]
    assert (position.relative, position.data.measures()) == (True, (30, 0, 0, 0, 0, 0))
    assert "type CALPOS first" in refused(typist, "ENDCAL W")


@pytest.mark.trig_row(35)
def test_driving_the_arm_leaves_the_program_as_it_is() -> None:
    typist = Typist("FREE\nX 40 SAVE\nGOGRASP")
    assert (typist.steps, typist.at[0], typist.arm.closed) == ([], 40, True)
    typist.type("GOUNGRASP")
    assert (typist.steps, typist.arm.closed) == ([], False)


@pytest.mark.trig_row(36)
def test_a_guarded_way_asks_for_threshold_and_vector_and_tells_how_it_ended() -> None:
    typist = Typist("FREE\nX 0 Y 0 Z 100 RECORD\nHERE UP\nFREE\nZ 5 RECORD\nHERE DOWN\nGOPOS UP\nGOGRASP")
    typist.type("GOGPOS DOWN\n2\n(0 0 1)\nGOPOS UP\n* STACK 3 X 0 Y 0\nGOGPOS DOWN\n2\n(0 0 1)")
    assert typist.told == [
        "reached X 0 Y 0 Z 5",
        "blocks on the table: 3",
        "stopped by a force of 2.02 oz at X 0 Y 0 Z 36",
    ]


def test_here_and_sr_name_where_the_arm_is() -> None:
    typist = Typist("M A\nX 10 RECORD\nFREE\nX 25 RECORD\nHERE H\nSA S\nSR R")
    known = typist.session.program.positions
    assert known["H"].data == known["S"].data == Place(x=0.025, z=0.3)
    assert (known["R"].relative, known["R"].data.measures()[0]) == (True, 15)
    assert "no step has moved" in refused(Typist(), "SR R")


def test_a_position_is_defined_anew_only_where_somebody_says_so() -> None:
    typist = Typist("HERE A\nFREE\nX 10 RECORD\nHERE A\nNo")
    assert typist.session.program.positions["A"].data.x == 0
    typist.type("HERE A\nYes")
    assert typist.session.program.positions["A"].init.x == 0.01


def test_what_is_left_of_a_line_of_the_box_that_was_wrong_is_not_heard_later() -> None:
    typist = Typist()
    script = Script(["X 500 RECORD", "M B", "X 5 RECORD"])
    typist.session.desk = script
    with pytest.raises(InvalidInput):
        hear(typist.session, "M A")
    hear(typist.session, script.next_line() or "")
    assert [step.position for step in typist.steps] == ["B"]
    assert typist.at[0] == 5


def test_a_position_that_a_step_needs_as_it_is_stays_so() -> None:
    typist = Typist("MR B\nX BY 5 RECORD\nM -B\nYes\nSAVPOS A")
    assert (
        refused(typist, "SAVPOS B")
        == "B cannot become absolute, because a step goes to -B; D deletes the step"
    )
    assert (
        refused(typist, "HERE B") == "B cannot become absolute, because a step goes to -B; D deletes the step"
    )
    assert (
        refused(typist, "SR A")
        == "A cannot become relative, because a SAVPOS step sets it; D deletes the step"
    )


def test_the_kill_switch_records_nothing() -> None:
    typist = Typist()
    assert "kill switch" in refused(typist, "M A\nX 30 KILL")
    assert (typist.at[0], typist.session.program.positions) == (30, {})


@pytest.mark.parametrize(
    ("line", "sentence"),
    [
        ("MOVE A", "there is no command `MOVE`; HELP lists the commands"),
        ("GRAPS", "there is no command `GRAPS`; did you mean GRASP?"),
        ("GRASP A", "`GRASP` takes no further operand; remove `A`"),
        ("GOPOS", "`GOPOS [-]POS` needs the name of a position"),
        ("LOOP A", "`LOOP STEP COUNT` needs a whole number"),
        ("LOOP S1 many", "`many` is not a whole number"),
        ("LOOP S1 -1", "the count of a loop must be 0 or more, not -1"),
        ("LOOP S1 1000000000000", "`1000000000000` is more than 999999999"),
        ("L NOWHERE", "there is no step `NOWHERE`; known: `S1`"),
        ("M 1A", "`1A` is not a name: a name is a letter, followed by letters, digits, `-` or `_`"),
        (
            "M " + "A" * 10_000,
            "`AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA…` has 10000 characters; a name can have at most 40",
        ),
        ("M A n", "n and g are branches of a guarded step, but the active step is not guarded"),
        ("M A sideways", "`sideways` is not a branch; type n (normal) or g (guarded)"),
        ("CN S1 S2", "`CN STEP` takes no further operand; remove `S2`"),
        ("CT much", "`much` is not a number"),
        ("CT nan", "`nan` is not a number"),
        ("DLINK S1", "the active step does not lead to S1"),
        ("D **TOP**", "the top cannot be deleted; FLUSH erases the program"),
        (
            "RUN 0",
            "RUN 0 would do nothing; RUN 1 executes the active step, RUN -1 undoes the last executed step",
        ),
        ("W", "no file has been read or written yet; give W a name"),
        ("N -1", "N moves down and P moves up, each by 1 to 100000 steps, not by -1"),
        (
            "GOPOS B\x1b[2J",
            "`B\u241b[2J` is not a name: a name is a letter, followed by letters, digits, `-` or `_`",
        ),
        ("RECORD", "RECORD is a control of the teach box, which works only while M or FREE is waiting"),
        (
            "* DANCE",
            "`DANCE` is not an action on the table; type `* STACK 20 X 150 Y 0`, `* BUCKET X 140 Y 0`, or `* CLEAR`",
        ),
        ("M B\nUP", "`UP` is not a control of the teach box; type `X -30`, `Z BY 12`, `RECORD` or `KILL`"),
        ("M B\nX 500 RECORD", "X would be 500 mm; its range is -200 to 200 mm"),
        ("M B\nX 500 RECORD\nM C", "X would be 500 mm; its range is -200 to 200 mm"),
        ("M B\nRECORD X 3", "RECORD ends the work with the teach box; remove `X` after it"),
        (
            "M A\nperhaps",
            "TRIG asks “Move to the predefined location?”, but `perhaps` is not an answer; type Yes or No",
        ),
    ],
)
def test_a_line_that_is_wrong_is_refused_in_a_sentence_that_helps(line: str, sentence: str) -> None:
    assert refused(Typist("M A\nX 5 RECORD\nCN S1\n"), line) == sentence


@pytest.mark.parametrize("command", TABLE, ids=lambda command: command.word)
def test_every_command_has_a_line_of_help(command: TrigCommand) -> None:
    typist = Typist("HELP")
    assert any(line.startswith(f"  {command.usage} ") for line in typist.told[0].splitlines())
