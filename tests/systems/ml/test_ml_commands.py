"""The commands `handeye ml run`, `check`, `try`, `words` and `assemble`, and the terminal with piped lines."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from ml_bench import FOLLOWER, PLANS

from handeye.core.errors import InvalidInput
from handeye.systems.ml.cli.senses import sensed
from handeye.systems.ml.machine.surroundings import Stimulus

Command = Callable[..., tuple[int, str, str]]
GUARDED = "10 SENSOR 8 -1 1000\n20 DMOTOR 3 2000\n30 BRANCH 40 60 8\n40 PRINT 8\n50 STOP\n60 PRINT 0"


@pytest.fixture
def handeye(command: Command) -> Command:
    """Executes a command, some words of which may be paths."""
    return lambda *words: command(*map(str, words))


@pytest.fixture
def program(tmp_path: Path) -> Path:
    path = tmp_path / "guarded.ml"
    path.write_text(GUARDED, encoding="utf-8")
    return path


def test_a_program_runs_to_its_end_and_prints(handeye: Command, program: Path) -> None:
    code, out, _ = handeye("ml", "run", program, "--no-keep")
    assert code == 0
    assert out.splitlines()[0] == "0"


@pytest.mark.ml_row(54)
@pytest.mark.parametrize(
    ("sense", "code", "printed"), [("8=1200@3:500", 0, "8"), ("door=1@3:500", 1, "door")]
)
def test_a_sensor_or_an_interlock_is_sensed_at_a_place(
    handeye: Command, program: Path, sense: str, code: int, printed: str
) -> None:
    ended, out, err = handeye("ml", "run", program, "--no-keep", "--sense", sense)
    assert ended == code
    assert printed in out + err


def test_a_program_runs_on_the_simulated_arm_in_a_world(handeye: Command, program: Path) -> None:
    """The strain gauges of the arm have other errors in another world."""
    text = "5 SENSOR 1 -1 1\n10 DMOTOR 3 2000\n20 GETPOS 1 3\n30 GETSEN 2 4\n40 PRINT &1 &2"
    program.write_text(text, encoding="utf-8")
    strains = set()
    for seed in ("0", "1"):
        code, out, _ = handeye("ml", "run", program, "--arm", "rectilinear", "--seed", seed, "--no-keep")
        y, strain = map(int, out.splitlines()[0].split())
        assert (code, abs(y - 2000) <= 6) == (0, True)
        strains.add(strain)
    assert len(strains) == 2


def test_the_result_has_the_fields_of_an_assembly_and_figures_of_its_own(
    handeye: Command, program: Path
) -> None:
    code, out, err = handeye("ml", "run", program, "--no-keep", "--json")
    result = json.loads(out)
    assert code == 0
    assert (result["completed"], result["program"], result["seed"]) == (True, "guarded.ml", 0)
    assert result["figures"]["statements"] == 4
    assert "0" in err.splitlines()


def test_an_error_stops_the_program_with_exit_code_1(handeye: Command, program: Path) -> None:
    program.write_text("10 LOAD 1 6\n20 MOTOR &1 100", encoding="utf-8")
    code, out, err = handeye("ml", "run", program, "--no-keep")
    assert code == 1
    assert "M09: the right arm has no motor 6 (statement 20)" in out + err


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("--sense", "8"), "--sense takes SENSOR=READING"),
        (("--sense", "dor=1"), "did you mean `door`?"),
        (("--sense", "14=1"), "choose from 1, 2, 3"),
        (("--sense", "8=1@6:0"), "there is no motor 6"),
        (("--first", "11"), "has no statement 11"),
        (("--left", "11"), "has no statement 11"),
        (("--seed", "3"), "--seed applies only to `--arm rectilinear`"),
        (("--arm", "rectilinear", "--sense", "8=1200"), "--sense applies only to `--arm none`"),
        (("--arm", "purbrick"), "--arm"),
    ],
)
def test_what_cannot_be_run_is_refused_in_a_sentence(
    handeye: Command, program: Path, words: tuple[str, ...], told: str
) -> None:
    code, out, err = handeye("ml", "run", program, "--no-keep", *words)
    assert code == 2
    assert told in out + err
    assert "Traceback" not in out + err


def test_mistakes_are_shown_and_nothing_runs(handeye: Command, program: Path) -> None:
    program.write_text("10 MOOVE 5", encoding="utf-8")
    for words in (("ml", "run"), ("ml", "check"), ("check",)):
        code, out, err = handeye(*words, program)
        assert code == 2
        assert "did you mean `MOVE`?" in out + err


def test_the_follower_is_checked_with_a_warning(handeye: Command) -> None:
    code, out, err = handeye("ml", "check", FOLLOWER, "--json")
    assert code == 0
    assert [each["code"] for each in json.loads(out)] == ["unguarded-motion"], err


def test_a_symbolic_program_is_assembled_into_a_file(handeye: Command, tmp_path: Path) -> None:
    written = tmp_path / "follower.ml"
    assert handeye("ml", "assemble", PLANS / "curve_follower.sym", "-o", written)[0] == 0
    assert handeye("ml", "check", written)[0] == 0
    assert handeye("ml", "assemble", PLANS / "curve_follower.sym", "-o", written)[0] == 2
    code, out, _ = handeye("ml", "assemble", PLANS / "curve_follower.sym")
    assert code == 0
    assert out == written.read_text(encoding="utf-8")


def test_both_arms_run_at_once(handeye: Command, program: Path) -> None:
    program.write_text(
        "10 DMOTOR 3 1000\n20 PRINT 1\n30 STOP\n100 DMOTOR 9 12000\n110 PRINT 2", encoding="utf-8"
    )
    code, out, _ = handeye("ml", "run", program, "--left", "100", "--no-keep")
    assert code == 0
    assert out.splitlines()[:2] == ["1", "2"]


def test_words_are_explained_and_unknown_ones_refused(handeye: Command) -> None:
    assert "GOPOINT n [x]" in handeye("ml", "words")[1]
    assert "Move one motor to a position." in handeye("ml", "words", "motor")[1]
    assert handeye("ml", "words", "MOTR")[0] == 2


def test_readings_are_read_as_they_are_written() -> None:
    assert sensed("8=1200") == Stimulus(channel="range", value=1200 * 1e-4)
    assert sensed("1=1@3:-500") == Stimulus(channel="wand", value=1, motor=3, beyond=-500, side="below")
    assert sensed("panic=1@1.5s") == Stimulus(channel="panic", value=1, since=150)
    for wrong in ("8=1@", "8=1@5", "=3", "8=99999", "8=1@3:99999", "8=1@.s", "8=1e3", "٨=1"):
        with pytest.raises(InvalidInput):
            sensed(wrong)
