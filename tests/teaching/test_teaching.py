"""Teaching: the arm is moved by word or by hand, and where it is gets a name in the file."""

import json
from pathlib import Path

import numpy as np
import pytest
from conftest import Command
from repl_sessions import TAUGHT, workplace

from handeye.core.pose import rotation, rotation_z
from handeye.core.resources import plans
from handeye.core.source import Source
from handeye.core.units import DEGREE, INCH
from handeye.program.taught import load_taught
from handeye.runs.snapshot import Checkpoint
from handeye.teaching.answers import text
from handeye.teaching.teach_commands import TEACH_COMMANDS, TeachSession
from handeye.teaching.teacher import Teacher
from handeye.teaching.workplace import Workplace

FILE = (plans() / "water_pump.toml").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def parked() -> Checkpoint:
    """The cell of world 0, its arm parked and its hand open."""
    place = workplace()
    opening = place.plan(Source(name="open", text="OPEN 1\n")).plan
    assert opening is not None
    place.carry_out(opening)
    return place.checkpoint()


@pytest.fixture
def pupil(parked: Checkpoint, tmp_path: Path) -> TeachSession:
    """A parked arm, and a file as the water pump's."""
    file = tmp_path / "job.toml"
    file.write_text(FILE, encoding="utf-8")
    place = Workplace.at(parked, TAUGHT, halt=lambda: False)
    return TeachSession(Teacher(workplace=place, file=file, saved=FILE))


def say(pupil: TeachSession, *lines: str) -> str:
    """Say lines; the text of the last answer."""
    return [text(pupil.hear(line)) for line in lines][-1]


def hand(pupil: TeachSession) -> np.ndarray:
    """Where the hand is by its sensors, in."""
    return pupil.teacher.workplace.run.drive.hand()[:3, 3] / INCH


SHORT = 0.03
"""How far the boom may stop from where it is to be, in: a step of its potentiometer (.009), half of it before and half
after, and what friction, which nobody has measured here, leaves of its servo: 2.1 N over 4.7 N/mm (.018)."""


# -- moving ---------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_joint_moves_by_so_much_with_a_sign_and_to_there_without(pupil: TeachSession) -> None:
    joints = pupil.teacher.workplace.run.drive
    before = joints.sensed.q.copy()
    say(pupil, "j3 +1")
    drive = pupil.teacher.workplace.run.drive
    assert (drive.sensed.q - before)[2] / INCH == pytest.approx(1, abs=SHORT)
    say(pupil, "j3 18")
    assert drive.sensed.q[2] / INCH == pytest.approx(18, abs=SHORT)


def test_the_hand_moves_along_an_axis_of_the_table(pupil: TeachSession) -> None:
    before = hand(pupil)
    say(pupil, "table x +.5")
    assert hand(pupil) - before == pytest.approx((0.5, 0, 0), abs=0.05)


def test_the_hand_moves_along_an_axis_of_its_own(pupil: TeachSession) -> None:
    before = hand(pupil)
    say(pupil, "hand z -1")  # it points down, so back is up
    assert hand(pupil) - before == pytest.approx((0, 0, 1), abs=0.05)


def test_the_hand_is_turned_on_the_spot_about_an_axis_of_the_table(pupil: TeachSession) -> None:
    before = pupil.teacher.workplace.run.drive.hand()
    say(pupil, "table turn z 20")
    after = pupil.teacher.workplace.run.drive.hand()
    assert (after[:3, 3] - before[:3, 3]) / INCH == pytest.approx((0, 0, 0), abs=0.05)
    np.testing.assert_allclose(after[:3, :3], rotation_z(20 * DEGREE) @ before[:3, :3], atol=0.01)


def test_the_hand_is_turned_about_an_axis_of_its_own(pupil: TeachSession) -> None:
    before = pupil.teacher.workplace.run.drive.hand()
    say(pupil, "hand turn y 10")
    after = pupil.teacher.workplace.run.drive.hand()
    turned = rotation(10 * DEGREE * before[:3, 1]) @ before[:3, :3]
    np.testing.assert_allclose(after[:3, :3], turned, atol=0.01)


def test_an_arm_that_floats_stays_where_it_is_until_somebody_pushes_it(pupil: TeachSession) -> None:
    before = hand(pupil)
    say(pupil, "float")
    assert np.linalg.norm(hand(pupil) - before) < 0.1
    afloat = hand(pupil)
    assert say(pupil, "push x 5 1").endswith(
        "the arm was pushed from outside; no program can contain this motion"
    )
    assert (hand(pupil) - afloat)[0] > 0.3


def test_an_arm_that_is_held_cannot_be_pushed(pupil: TeachSession) -> None:
    say(pupil, "float", "table z +.1")
    said = "the arm cannot be pushed while its brakes are set; `float` releases the brakes"
    assert say(pupil, "push x 5 1") == said


def test_what_the_joints_cannot_do_is_said_and_nothing_moves(pupil: TeachSession) -> None:
    before = hand(pupil)
    assert "joint 3 (boom)" in say(pupil, "j3 90")
    assert hand(pupil) == pytest.approx(before, abs=0.01)


# -- naming ---------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_where_the_hand_is_gets_a_name_that_can_be_gone_to_and_is_saved_without_touching_the_rest(
    pupil: TeachSession,
) -> None:
    said = say(pupil, "move S1", "here SPARE", "table z +2", "move SPARE", "save")
    assert said.startswith("SPARE written to ")
    assert hand(pupil) == pytest.approx((6, 39, 6.37), abs=0.05)
    after = pupil.teacher.file.read_text(encoding="utf-8")
    (line,) = [line for line in after.splitlines() if line not in FILE.splitlines()]
    assert line.startswith("SPARE = { at = [")
    assert after.replace(line + "\n", "") == FILE
    assert "SPARE" in load_taught(pupil.teacher.file).positions


def test_a_name_that_is_taken_is_not_taught_anew_without_again(pupil: TeachSession) -> None:
    assert say(pupil, "here T1") == "T1 is already taught; `here T1 again` replaces it"
    assert pupil.teacher.unsaved == []
    assert say(pupil, "here T1 again").endswith(" of PUMP")  # as it was taught
    assert pupil.teacher.unsaved == ["T1"]


@pytest.mark.slow
def test_a_place_named_of_a_part_is_relative_to_it(pupil: TeachSession) -> None:
    say(pupil, "move H0", "here H6 of PUMP")
    known = pupil.teacher.workplace.taught.positions
    assert np.subtract(known["H6"].at[:3], known["H0"].at[:3]) / INCH == pytest.approx((0, 0, 0), abs=0.05)


def test_undo_takes_back_names_and_motions_one_by_one(pupil: TeachSession) -> None:
    before = hand(pupil)
    say(pupil, "table x +1", "here NEW")
    assert say(pupil, "undo") == "the last name is undone"
    assert "NEW" not in pupil.teacher.workplace.taught.positions
    assert say(pupil, "undo") == "the last motion is undone"
    assert hand(pupil) == pytest.approx(before, abs=0.02)


def test_nobody_quits_unsaved_without_being_told(pupil: TeachSession) -> None:
    assert (
        say(pupil, "here NEW", "quit")
        == "not saved: NEW; `save` saves them, and a second `quit` leaves without "
        "saving"
    )
    assert not pupil.over
    say(pupil, "quit")
    assert pupil.over


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("fly", "there is no command `fly`; `help` lists the commands"),
        ("tabel x 1", "there is no command `tabel`; did you mean `table`?"),
        ("table x", "write the command as in `table x +.5` or `table turn z 10`"),
        ("table w 1", "`w` is not an axis; the axes are x, y and z"),
        ("table x inf", "`inf` is not a number"),
        (
            "here 1A",
            "`1A` is not a name: a name consists of letters, digits and _, and does not start with a digit",
        ),
        ("here A of LID", "there is no part `LID`; the parts are BASE, PUMP"),
        ("push x 900 1", "a push can be at most 200 oz, not `900`"),
        ("push x 5 900", "a push can last at most 60 s, not `900`"),
    ],
)
def test_what_is_said_wrong_is_told_in_a_sentence(pupil: TeachSession, line: str, said: str) -> None:
    assert say(pupil, line) == said


def test_help_names_everything_that_can_be_said(pupil: TeachSession) -> None:
    said = say(pupil, "help")
    assert [name for name in TEACH_COMMANDS if f"  {name}" not in said] == []


# -- the command ----------------------------------------------------------------------------------------


def test_teach_makes_the_file_beside_a_script_from_standard_input(command: Command) -> None:
    code, out, _ = command("teach", "job.al", "--json", typed="table z +1\nhere UP\nsave\n")
    assert code == 0
    assert [json.loads(line)["typed"] for line in out.splitlines()] == ["table z +1", "here UP", "save"]
    assert load_taught("job.toml").positions["UP"].at[2] / INCH == pytest.approx(9, abs=0.1)


def test_what_is_left_unsaved_is_told_and_the_file_is_not_touched(command: Command) -> None:
    code, _, err = command("teach", "job.toml", typed="here UP\n")
    assert (code, err) == (2, "not saved: UP\n")
    assert not Path("job.toml").exists()


def test_a_file_that_is_no_taught_file_is_refused_before_anything_moves(command: Command) -> None:
    Path("job.toml").write_text("[positions\n")
    code, _, err = command("teach", "job.toml", typed="save\n")
    assert code == 2
    assert err.startswith("handeye: job.toml is not TOML: ")


def test_a_file_that_somebody_else_has_changed_meanwhile_is_left_alone(pupil: TeachSession) -> None:
    pupil.teacher.file.write_text(FILE + "# mine\n", encoding="utf-8")
    assert say(pupil, "here NEW", "save").endswith(
        "has changed since it was read, so nothing was written; `list` shows what to add"
    )
    assert pupil.teacher.file.read_text(encoding="utf-8") == FILE + "# mine\n"


def test_what_somebody_names_leaves_fixtures_known(pupil: TeachSession) -> None:
    say(pupil, "here NEW")
    assert pupil.teacher.workplace.known.fixtures == TAUGHT.fixtures
