"""The command line: exit codes, and one clear error for every kind of bad input."""

import json
import os
import subprocess
import sys
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from conftest import Command
from cyclopts import App

from handeye.cli import app, scripts
from handeye.cli.commands import restore_docstring
from handeye.core.resources import demo
from handeye.planfile.plan import VERSION

MISTAKES = {
    "unknown-instruction": "MOVEX T",
    "missing-operand": "CHANGE [0 0 -1]",
    "label-twice": "L: OPEN 1\nL: OPEN 2",
    "unknown-label": "JUMP NOWHERE",
    "unreachable-position": "TRANS T [200 38 4 90 90 0]\nMOVE T",
}
"""Diagnostic code and a script that deserves it."""


def commands_of(app: App) -> Iterator[App]:
    """All commands, those of groups such as `trace` too."""
    for word in app:
        if not word.startswith("-"):
            yield from [app[word]] if app[word].default_command else commands_of(app[word])


@pytest.mark.parametrize("command", [*commands_of(app)], ids=lambda command: " ".join(command.name))
def test_help_says_what_every_argument_and_option_is_for(command: App) -> None:
    told = command.assemble_argument_collection(parse_docstring=True)
    assert command.help
    assert [argument.name for argument in told if argument.show and not argument.parameter.help] == []


@pytest.mark.parametrize("code", MISTAKES)
def test_a_wrong_script_gets_one_diagnostic_and_no_plan(command: Command, code: str) -> None:
    Path("wrong.al").write_text(MISTAKES[code], encoding="utf-8")
    exit_code, out, err = command("plan", "wrong.al")
    assert (exit_code, out, err.count("error[")) == (2, "", 1)
    assert f"error[{code}]" in err
    assert [path.name for path in Path().iterdir()] == ["wrong.al"]


@pytest.mark.parametrize("code", [code for code in MISTAKES if code != "unreachable-position"])
def test_check_finds_the_same_mistakes(command: Command, code: str) -> None:
    Path("wrong.al").write_text(MISTAKES[code], encoding="utf-8")
    exit_code, _, err = command("check", "wrong.al")
    assert (exit_code, err.count("error[")) == (2, 1)


def test_check_of_a_right_script_ends_with_zero(command: Command) -> None:
    Path("right.al").write_text("OPEN 1\n", encoding="utf-8")
    assert command("check", "right.al") == (0, "right.al: no errors\n", "")


def test_a_script_that_is_not_utf_8_is_told_by_its_byte(command: Command) -> None:
    Path("latin.al").write_bytes(b"OPEN 1\n\xff\n")
    assert command("check", "latin.al") == (2, "", "handeye: latin.al is not UTF-8 text: byte 7 is 0xff\n")


@pytest.mark.parametrize("words", [("check", "no.al"), ("plan", "no.al"), ("run", "no.json")])
def test_a_missing_file_is_named(command: Command, words: tuple[str, str]) -> None:
    exit_code, out, err = command(*words)
    assert (exit_code, out) == (2, "")
    assert err.startswith(f"handeye: {words[1]}")
    assert err.count("\n") == 1


def test_a_script_of_two_files_is_checked_in_both(command: Command) -> None:
    Path("lib").mkdir()
    Path("two.al").write_text("OPEN 1\nREQUIRE lib/one.al\n", encoding="utf-8")
    Path("lib/one.al").write_text("OPEN 2\nOPEN 9\n", encoding="utf-8")
    exit_code, out, _ = command("check", "two.al", "--json")
    (wrong,) = json.loads(out)
    assert (exit_code, wrong["file"], wrong["primary"]["line"]) == (2, "lib/one.al", 2)


def test_a_plan_of_two_files_needs_neither(command: Command) -> None:
    Path("two.al").write_text("OPEN 1\nREQUIRE one.al\n", encoding="utf-8")
    Path("one.al").write_text("OPEN 2\n", encoding="utf-8")
    assert command("plan", "two.al")[0] == 0
    Path("one.al").unlink()
    Path("two.al").unlink()
    assert command("stages", "two.plan.json")[1].splitlines()[2] == "         1  line one.al:1  OPEN 2"


SPOILED: dict[str, Callable[[str], str]] = {
    "was cut short": lambda text: text[:200],
    "has plan format version 99": lambda text: text.replace(f'"version": {VERSION}', '"version": 99'),
    "unknown field `extra`": lambda text: text.replace("{", '{"extra": 1,', 1),
    "not a plan": lambda _: "[]",
}
"""What is said of a plan file, and how to spoil one so."""


@pytest.mark.parametrize("words", SPOILED)
def test_a_spoiled_plan_is_refused_before_anything_moves(
    command: Command, planned: Callable[[str], str], words: str
) -> None:
    file = Path(planned("OPEN 1"))
    file.write_text(SPOILED[words](file.read_text(encoding="utf-8")), encoding="utf-8")
    exit_code, out, err = command("run", str(file))
    assert (exit_code, out, err.count("\n")) == (2, "", 1)
    assert words in err


@pytest.mark.parametrize("target", ["absent/job.json", "."])
def test_a_plan_that_cannot_be_written_leaves_nothing_behind(command: Command, target: str) -> None:
    Path("job.al").write_text("OPEN 1", encoding="utf-8")
    exit_code, out, err = command("plan", "job.al", "-o", target)
    assert (exit_code, out) == (2, "")
    assert "cannot be written" in err
    assert [path.name for path in Path().iterdir()] == ["job.al"]


SEED = "a seed must be a whole number from 0 to 9007199254740991 (2^53 - 1)"


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("assemble", "--seed", "-1"), f"{SEED}, not -1"),
        (("assemble", "--seed", "x"), "--seed: `x` is not a whole number"),
        (("assemble", "--camera", "film"), "--camera must be one of auto, gl, ray, not `film`"),
        (("trials", "assembly", "--seeds", "9-3"), "`9-3` is neither"),
        (("trials", "assembly", "--seeds", "9" * 5000), "is neither"),
        (("trials", "assembly", "--seeds", "١-٣"), "is neither"),
        (("trials", "assembly", "--seeds", "9" * 19), f"{SEED}, not {'9' * 19}"),
        (("trials", "assembly", "--seeds", "3,,4"), "`` is neither"),
        (("trials", "assembly", "--seeds", "0-5,3"), "--seeds names 3 twice"),
        (
            ("trials", "assembly", "--seeds", f"0-999999,{2**53 - 1}"),
            "the number of trials must be at most 1,000,000",
        ),
        *(
            ((*words, "--seed", str(2**53 - 1), "--n", "2"), f"{SEED}, not 9007199254740992")
            for words in (
                ("trials", "assembly"),
                ("trials", "dismantling"),
                ("trials", "base"),
                ("trials", "disturbed"),
                ("trials", "chaos", "--worlds", "1"),
                ("trials", "pallet"),
                ("faults",),
            )
        ),
        (("bench", "insertion", "--seed", str(2**53 - 1), "--n", "11"), f"{SEED}, not 9007199254740992"),
        (("trials", "assembly", "--seeds", "3", "--n", "2"), "--seeds replaces --n and --seed"),
        (
            ("trials", "assembly", "--n", "3", "--only", "3"),
            "there is no trial 3: this batch has trials 0 to 2",
        ),
        (("trials", "assembly", "--n", "0"), "the number of trials must be at least 1, not 0"),
        (
            ("trials", "assembly", "--cpu-limit", "0"),
            "a time limit must be more than 0 s, not 0",
        ),
        (
            ("trials", "assembly", "--cpu-limit", "inf"),
            "a time limit must be more than 0 s, not inf",
        ),
        (
            ("trials", "assembly", "--simulated-limit", "1e999"),
            "a time limit must be more than 0 s",
        ),
        (("trials", "assembly", "--n", "9" * 20), "the number of trials must be at most 1,000,000"),
        (
            ("trials", "assembly", "--seeds", f"0-{2**53 - 1}"),
            "the number of trials must be at most 1,000,000",
        ),
        (("trials", "base", "--n", "9" * 20), "the number of worlds must be at most 1,000,000"),
        (("trials", "pallet", "--n", "9" * 20), "the number of trials must be at most 1,000,000"),
        (("bench", "insertion", "--n", "9" * 20), "the number of trials must be at most 1,000,000"),
        (("faults", "--list", "--only", "rotr"), "there is no fault `rotr`; choose from `finger_switch`"),
        (("faults", "--list", "--stage", "pins"), "--list runs nothing: leave out --stage and --out"),
        (("faults", "--list", "--out", "it"), "--list runs nothing: leave out --stage and --out"),
        (("faults", "--list", "--jobs", "0"), "the number of workers must be at least 1, not 0"),
        (("frobnicate",), "there is no command `frobnicate`"),
    ],
)
def test_a_wrong_argument_ends_with_two(command: Command, words: tuple[str, ...], sentence: str) -> None:
    exit_code, _, err = command(*words)
    assert exit_code == 2
    assert sentence in err


@pytest.mark.parametrize("words", [("run",), ("stages",), ("inspect",), ("diff", "job.plan.json")])
def test_a_script_without_its_ending_is_told_from_a_plan(
    command: Command, planned: Callable[[str], str], words: tuple[str, ...]
) -> None:
    planned("OPEN 1")
    Path("job.txt").write_text("OPEN 1", encoding="utf-8")
    sentence = (
        "handeye: job.txt is not a plan; if it is a script, `handeye plan job.txt` makes a plan from it\n"
    )
    assert command(*words, "job.txt") == (2, "", sentence)


def test_a_script_stands_for_its_plan(command: Command, planned: Callable[[str], str]) -> None:
    plan = planned("OPEN 1")
    assert command("stages", "job.al") == command("stages", plan)
    assert command("diff", "job.al", plan)[0] == 0
    Path("job.al").write_text("FLY", encoding="utf-8")
    code, _, err = command("run", "job.al")
    assert (code, err.splitlines()[-1]) == (2, "handeye: job.al has 1 error; no plan was made")


@pytest.mark.parametrize(("lines", "count"), [(1, "1 error"), (3, "3 errors"), (30, "20 or more errors")])
def test_no_more_errors_are_counted_than_are_told(command: Command, lines: int, count: str) -> None:
    Path("wrong.al").write_text("FLY\n" * lines, encoding="utf-8")
    assert (
        command("plan", "wrong.al")[2].splitlines()[-1] == f"handeye: wrong.al has {count}; no plan was made"
    )


@pytest.mark.parametrize(
    ("words", "size"), [(("--size", "3000x960"), "3000 x 960"), (("--size", "1280x7"), "1280 x 7")]
)
def test_a_picture_that_cannot_be_is_told_by_the_size_that_was_typed(
    command: Command, words: tuple[str, str], size: str
) -> None:
    code, _, err = command("render", "-o", "it.png", *words)
    assert (code, err) == (
        2, f"handeye: a picture of {size} is not possible; each side must have 8 to 2048 pixels\n"
    )  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(
    ("script", "more", "code"),
    [
        ("OPEN 1", (), 0),
        ('WAIT "HELP ME"', (), 1),
        ('WAIT "HELP ME"', ("--judge",), 1),
        ("OPEN 1", ("--judge",), 3),
    ],
)
def test_the_exit_code_says_how_a_run_ended(
    command: Command, planned: Callable[[str], str], script: str, more: tuple[str, ...], code: int
) -> None:
    """0 done, 1 the operator was called, 3 the program said done and the referee disagrees."""
    assert command("run", planned(script), *more)[0] == code


@pytest.mark.slow
def test_json_is_one_object_alone_on_standard_output(command: Command, planned: Callable[[str], str]) -> None:
    exit_code, out, _ = command("run", planned('WAIT "HELP ME"'), "--json", "--seed", "3")
    result = json.loads(out)
    assert (exit_code, result["completed"], result["message"], result["seed"]) == (1, False, "HELP ME", 3)


def test_an_output_folder_that_cannot_be_made_ends_with_two(
    command: Command, planned: Callable[[str], str]
) -> None:
    Path("file").write_text("", encoding="utf-8")
    exit_code, _, err = command("run", planned("OPEN 1"), "--out", "file/folder")
    assert exit_code == 2
    assert "the folder file/folder cannot be created" in err


STRUCK = """
import signal, sys
from importlib.metadata import EntryPoint
from runpy import run_module

class Struck:
    def find_spec(self, name, path=None, target=None):
        if name == sys.argv[-1]:
            try:
                signal.raise_signal(signal.SIGINT)
            except KeyboardInterrupt:
                if sys.argv[-2] == "fails":
                    raise ImportError("initialization failed") from None

signal.signal(signal.SIGINT, signal.default_int_handler)
sys.meta_path.insert(0, Struck())
"""
"""Presses Ctrl-C in the middle of the import of the module that is the last argument, as one that takes a
KeyboardInterrupt for a mistake of its own, or that swallows it."""
ENTRY = tomllib.loads((Path(__file__).parent.parent / "pyproject.toml").read_text("utf-8"))["project"][
    "scripts"
]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("how", "start"),
    [
        ("fails", f"EntryPoint('', {ENTRY['handeye']!r}, '').load()()"),
        ("swallows", "run_module('handeye', run_name='__main__')"),
    ],
)
def test_ctrl_c_while_the_command_is_still_being_imported_ends_it_without_a_traceback(
    how: str, start: str
) -> None:
    call = [sys.executable, "-c", STRUCK + start]
    struck = {"handeye.cli.common": "", "handeye.cli.runs": "\nhandeye: interrupted\n"}
    for module, said in struck.items():
        done = subprocess.run([*call, "run", how, module], capture_output=True, text=True, check=False)
        assert (done.returncode, done.stderr) == (130, said)


@pytest.mark.slow
def test_an_opengl_that_is_not_there_is_in_nobody_s_way(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "handeye", "export", "glb", "-o", "it.glb"],
        cwd=tmp_path, env={**os.environ, "MUJOCO_GL": "nix"}, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.slow
def test_it_is_started_as_a_module_too(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "handeye", "check", "no.al"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "handeye: no.al: there is no such file\n"


QUICK = """
import sys
from handeye.cli import app

for line in sys.argv[1:]:
    app(line.split(), result_action="return_value", exit_on_error=False)
    heavy = {"mujoco", "cv2", "scipy", "mcap", "websockets", "importlib.metadata"} & {*sys.modules}
    assert not heavy, (line, heavy)
"""


@pytest.mark.slow
def test_commands_that_move_nothing_import_no_simulator_no_eye_and_no_solver(tmp_path: Path) -> None:
    (tmp_path / "job.al").write_text("OPEN 1\nMOVE P\n", encoding="utf-8")
    (tmp_path / "job.toml").write_text("[positions.P]\nat = [25, 38, 6, 90, 90, 0]\n", encoding="utf-8")
    lines = (
        "--version",
        "--help",
        "schema",
        "explain 23",
        "explain label-twice",
        "trials --help",
        "check job.al",
        f"show {demo()}",
    )
    done = subprocess.run(
        [sys.executable, "-c", QUICK, *lines], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert "job.al: no errors" in done.stdout


def test_a_docstring_that_python_leaves_out_is_found_in_the_source() -> None:
    checked = scripts.check
    told = checked.__doc__
    checked.__doc__ = None
    try:
        restore_docstring(checked)
        assert checked.__doc__ == told
    finally:
        checked.__doc__ = told


@pytest.mark.slow
@pytest.mark.parametrize("words", ["--help", "trig --help"])
def test_help_does_not_hang_on_docstrings(words: str) -> None:
    call = ["-m", "handeye", *words.split()]
    whole, without = (
        subprocess.run([sys.executable, *flag, *call], capture_output=True, text=True, check=True).stdout
        for flag in ([], ["-OO"])
    )
    assert without == whole


def test_a_script_whose_name_leaves_no_room_for_a_taught_file_is_checked(command: Command) -> None:
    name = "n" * 252 + ".al"
    Path(name[1:]).write_text("OPEN 1\n", encoding="utf-8")
    assert command("check", name[1:])[:2] == (0, f"{name[1:]}: no errors\n")
    Path(name[1:]).write_text("MOVE P\n", encoding="utf-8")
    code, _, err = command("check", name[1:])
    assert (code, "unknown-position" in err) == (2, True)


@pytest.mark.parametrize(
    "error", [MemoryError(), ValueError("Error: engine error: Could not allocate memory")]
)
def test_too_little_memory_is_told_in_a_sentence(
    command: Command, monkeypatch: pytest.MonkeyPatch, error: Exception
) -> None:
    def fail(*_: object) -> None:
        raise error

    monkeypatch.setattr(scripts, "script_at", fail)
    code, _, err = command("check", "a.al")
    assert (code, err.startswith("handeye: out of memory; ")) == (2, True)
