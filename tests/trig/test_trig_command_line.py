"""`handeye trig`: programs run, shown and typed from the command line."""

import json
from pathlib import Path

import pytest
from conftest import Command
from trig_sessions import PLANS

PALLETISE = str(PLANS / "palletise.trig")


def test_a_script_is_typed_run_and_run_back(command: Command) -> None:
    assert command("trig", "run", PALLETISE, "--back") == (
        0,
        "227 steps done; the program has ended\n227 steps undone; there is nothing to undo before this\n",
        "",
    )


def test_a_run_is_told_as_json(command: Command) -> None:
    code, out, err = command("trig", "run", PALLETISE, "--json")
    told = json.loads(out)
    assert (code, told["forward"], told["back"]) == (0, {"steps": 227, "end": "none", "obstacle": None}, None)
    assert (told["cursor"], told["arm"][:3], len(told["blocks"])) == ("FINISH", [0, 150, 200], 20)
    assert err == "227 steps done; the program has ended\n"


def test_both_displays_of_a_program_are_shown(command: Command) -> None:
    code, out, _ = command("trig", "show", PALLETISE, "--width", "80")
    assert (code, out.count("GET-BLOCK"), "─@─^" in out or "[@]^" in out) == (0, 3, True)
    assert command("trig", "show", PALLETISE, "--width", "5")[0] == 2


def test_a_program_that_was_written_is_run(command: Command) -> None:
    typed = "M A\nX 20 RECORD\nM B\nX 40 RECORD\nEX both\n"
    assert command("trig", typed=typed) == (0, "written to both.trig.json\n", "")
    code, out, _ = command("trig", "run", "both.trig.json", "--back")
    assert (code, out.splitlines()[0]) == (0, "2 steps done; the program has ended")


def test_what_is_piped_in_is_heard_and_what_is_refused_is_told(command: Command) -> None:
    code, out, _ = command("trig", typed="M A\nX 20 RECORD\nGRAPS\nGRASP\nW it\n")
    assert (code, out) == (
        2,
        "line 3: there is no command `GRAPS`; did you mean GRASP?\nwritten to it.trig.json\n",
    )
    assert len(json.loads(Path("it.trig.json").read_bytes())["nodes"]) == 3


def test_a_script_that_is_wrong_is_told_by_its_line(command: Command) -> None:
    Path("bad.trig").write_text("; a remark\n>M A\n  X 10 RECORD\n>LOOP B 2\n", encoding="utf-8")
    assert command("trig", "run", "bad.trig") == (
        2,
        "",
        "handeye: bad.trig, line 4: there is no step `B`; CN names the active step\n",
    )
    assert command("trig", "run", "none.trig")[0] == 2


def test_a_run_that_the_arm_cannot_do_is_stopped(command: Command) -> None:
    Path("far.trig").write_text("MR A\nX BY 90 RECORD\nCN A\nLOOP A 5\n", encoding="utf-8")
    code, _, err = command("trig", "run", "far.trig")
    assert (code, err) == (1, "handeye: X would be 270 mm; the arm goes from -200 to 200\n")


@pytest.mark.parametrize("words", [("trig", "--arm", "puma"), ("trig", "run"), ("trig", "show", "a", "b")])
def test_wrong_words_are_told(command: Command, words: tuple[str, ...]) -> None:
    code, _, err = command(*words)
    assert (code, err.startswith("handeye: ")) == (2, True)
