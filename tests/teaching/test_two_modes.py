"""The two modes of 1973: what is typed is collected and checked; DO carries it out, or one function at once."""

import re
from pathlib import Path

import pytest
from repl_sessions import Console, workplace

from handeye.core.source import Source
from handeye.program.events import StepFinished
from handeye.teaching import workplace as workplaces
from handeye.teaching.repl import COMMANDS
from handeye.teaching.workplace import Workplace

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def place() -> Workplace:
    return workplace()


@pytest.fixture
def console(place: Workplace, tmp_path: Path) -> Console:
    """A new console in the cell as the one before has left it."""
    return Console(place, tmp_path)


@pytest.fixture
def plannings(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Texts that the planning phase was entered with."""
    found: list[str] = []
    planned = workplaces.planned

    def counted(source: Source, *rest: object, **named: object) -> object:
        found.append(source.text)
        return planned(source, *rest, **named)

    monkeypatch.setattr(workplaces, "planned", counted)
    return found


# -- rows 41 and 42 of the reference ----------------------------------------------------------------------


@pytest.mark.row(41, drawn=1)
def test_row_41_open_3_park_do_makes_a_plan_of_two_functions_and_carries_both_out_in_order(
    console: Console,
) -> None:
    console.type("OPEN 3", "PARK")
    assert console.gap < 1
    console.type("DO")
    runner = console.repl.workplace.runner
    assert console.steps == ["OPEN 3", "PARK"]
    assert [event.step for event in runner.events if isinstance(event, StepFinished)] == [0, 1]
    assert console.gap == pytest.approx(3, abs=0.05)


@pytest.mark.row(42, drawn=1)
def test_row_42_do_open_3_then_do_park_plans_twice_does_the_same_and_leaves_what_is_collected(
    tmp_path: Path, plannings: list[str]
) -> None:
    together, apart = Console(workplace(), tmp_path), Console(workplace(), tmp_path)
    together.type("OPEN 3", "PARK", "DO")
    apart.type("OPEN 1")
    plannings.clear()
    apart.type("DO OPEN 3", "DO PARK")
    assert [text.split("\n")[0] for text in plannings] == ["OPEN 3", "PARK"]
    assert apart.repl.functions == ["OPEN 1"]
    ends = [s.repl.workplace.run.drive.state.q for s in (together, apart)]
    assert ends[0] == pytest.approx(ends[1], abs=1e-3)
    assert together.gap == pytest.approx(apart.gap, abs=0.01)


# -- planning mode ----------------------------------------------------------------------------------------


def test_a_wrong_function_is_told_as_it_is_typed_and_is_not_collected(console: Console) -> None:
    said = console.read("OPEN 1", "OPEN 9")
    assert said.startswith("error[number-out-of-range]: `9` is too large for the gap of `OPEN`\n")
    assert console.repl.functions == ["OPEN 1"]


@pytest.mark.parametrize("line", ["STOP [0 0 -30]", "JUMP LATER", "DEFINE GET"])
def test_what_a_later_line_can_put_right_is_not_told_yet(console: Console, line: str) -> None:
    assert console.read(line) == ""
    assert console.repl.functions == [line]


def test_what_no_line_has_put_right_is_told_when_it_is_to_be_carried_out(console: Console) -> None:
    assert "there is no label `LATER`" in console.read("JUMP LATER", "DO")


def test_a_place_out_of_reach_is_told_as_it_is_typed(console: Console) -> None:
    assert "error[unreachable-position]" in console.read("TRANS FAR [200 0 3 0 90 0]", "MOVE FAR")
    assert len(console.repl.functions) == 1


def test_list_drop_and_clear_tell_and_change_what_is_collected(console: Console) -> None:
    assert console.read("OPEN 1", "PARK", "LIST") == "  1  OPEN 1\n  2  PARK"
    assert console.read("DROP") == "removed: PARK"
    assert console.read("LIST") == "  1  OPEN 1"
    console.type("CLEAR")
    assert console.read("LIST") == "nothing is collected"


def test_what_is_collected_is_written_as_a_script_that_do_carries_out_by_its_name(
    console: Console, tmp_path: Path
) -> None:
    console.type("OPEN 2", f"WRITE {tmp_path / 'wide'}", "CLEAR", "DO wide")
    assert (tmp_path / "wide.al").read_text() == "OPEN 2\n"
    assert console.gap == pytest.approx(2, abs=0.05)
    assert "already exists" in console.read(f"WRITE {tmp_path / 'wide'}")


# -- doing ------------------------------------------------------------------------------------------------


@pytest.mark.row(43, drawn=1)
def test_a_macro_is_carried_out_by_its_name(console: Console) -> None:
    console.type("DEFINE WIDE", "OPEN 3.5", "", "PARK", "DO WIDE")
    assert console.steps == ["OPEN 3.5"]
    assert console.gap == pytest.approx(3.5, abs=0.05)


def test_what_a_line_requires_is_read_from_the_folder_of_the_session(
    console: Console, tmp_path: Path
) -> None:
    (tmp_path / "hand.al").write_text("DEFINE WIDE\nOPEN 3.2\n\n")
    assert not console.type("REQUIRE hand.al", "WIDE", "DO").refused
    assert console.gap == pytest.approx(3.2, abs=0.05)
    assert "cannot be read" in console.read("REQUIRE foot.al")


def test_positions_and_vectors_collected_hold_for_a_function_done_alone(console: Console) -> None:
    console.type("TRANS HIGH [25 30 12 90 90 0]", "VECT UP [0 0 1]")
    assert not console.type("DO MOVE HIGH", "DO CHANGE UP 1").refused
    assert console.repl.workplace.run.drive.hand()[2, 3] / 0.0254 == pytest.approx(13, abs=0.05)


def test_a_function_is_planned_from_where_the_arm_stands(console: Console) -> None:
    console.type("DO MOVE T1", "DO CHANGE Z 2")
    assert "in below the table" in console.read("DO CHANGE Z -9")


def test_a_function_that_leads_into_a_fixture_is_not_carried_out(console: Console) -> None:
    console.type("TRANS INTO [24 40.9 .2 90 90 0]")
    said = console.read("DO MOVE INTO")
    assert said.startswith("error[hand-through-fixture]: the hand would go 0.30 in into `FAR_BLOCK` at INTO")


def test_a_position_defined_here_is_known_to_the_functions_after_it(console: Console) -> None:
    console.type("DO PARK", "DO CHANGE Z 1", "DO HERE UP", "DO PARK")
    assert re.search(r"hand at \((19\.99|20\.0\d), ", console.read("DO MOVE UP"))
    assert console.repl.workplace.known.positions["UP"].at[2] / 0.0254 == pytest.approx(9, abs=0.05)


def test_a_difference_saved_by_one_function_is_restored_in_a_later_one(console: Console) -> None:
    console.type("DO MOVE T1", "DO CHANGE X .5", "DO SAVE H")
    assert console.type("MOVE T1", "RESTORE H").diagnostics == ()
    console.type("DO")
    offset = console.repl.workplace.run.drive.hand()[0, 3] / 0.0254 - (25 + 1.02846)
    assert offset == pytest.approx(0.5, abs=0.06)


def test_back_undoes_the_last_do(console: Console) -> None:
    console.type("DO OPEN 1", "DO OPEN 4", "BACK")
    assert console.gap == pytest.approx(1, abs=0.05)


def test_proceed_goes_on_behind_what_called_the_operator(console: Console) -> None:
    said = console.read("OPEN 1", "WAIT look here", "OPEN 2", "DO")
    assert said.endswith(
        "2 WAIT look here                 brakes set, operator called: look here\n"
        "PROCEED, RETRY or SKIP continues the stopped program; a new instruction abandons the program"
    )
    console.type("PROCEED")
    assert console.gap == pytest.approx(2, abs=0.05)


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("DO", "nothing is collected; type instructions, or `DO OPEN 3` to run one instruction immediately"),
        ("DO PRK", "there is no instruction, macro or program `PRK`; did you mean `PARK`?"),
        ("LIST all", "`LIST` takes no operand; remove `all`"),
        ("PROCEED", "`proceed` answers a call to the operator, but no call is waiting for an answer"),
        ("WRITE", "give `WRITE` the name of a new file, such as `WRITE lid.al`"),
        ("WRITE .", ". is a directory, not a file"),
        ("DO LOOK VIEW", "the camera is not calibrated; to take pictures, start the command with --look"),
        ("HELP OPNE", "there is no instruction `OPNE`; did you mean `OPEN`?"),
        ("DROP", "nothing is collected"),
    ],
)
def test_what_cannot_be_done_is_said_in_a_sentence(console: Console, line: str, said: str) -> None:
    answer = console.type(line)
    assert (answer.refused, answer.said.error) == (True, said)


def test_nothing_can_be_undone_before_anything_is_done(tmp_path: Path) -> None:
    assert Console(workplace(), tmp_path).type("BACK").said.error == "there is nothing to undo"


def test_help_names_every_command(console: Console) -> None:
    said = console.read("HELP")
    assert [name for name in COMMANDS if f"\n  {name}" not in said] == []


def test_a_macro_with_a_parameter_is_carried_out_with_its_operand(console: Console) -> None:
    console.type("DEFINE WIDE G", "OPEN G", "", "WIDE 2", "DO WIDE 3.5")
    assert console.steps == ["OPEN 3.5"]
    assert "`9` is too large for the gap of `OPEN`" in console.read("WIDE 9")
    assert console.repl.functions[-1] == "WIDE 2"
    assert "the G of `WIDE` is missing" in console.read("DO WIDE")
