"""A system that lives outside of handeye is found by its entry point, and does in the shell what every system does."""

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

SUPPORT = Path(__file__).parent.parent / "support"
PATHS = os.pathsep.join(map(str, (SUPPORT / "toy_package", SUPPORT)))
TWO_TASKS = """TASK LEFT
ADD A 3
AGAIN: ADD B 1
ADD A -1
JUMP A AGAIN
TELL B
TASK RIGHT
WAIT B 3
TELL B
"""
LISTED = """
import sys
from handeye.cli import app
app(["--help"], result_action="return_value")
app(["trials", "--help"], result_action="return_value")
print("toy_system" in sys.modules, "handeye.systems.trig.run" in sys.modules)
"""

SERVER = """
import io, json, sys
from handeye.cli import main
for line in sys.stdin:
    words, typed = json.loads(line)
    said, sys.argv, sys.stdin = io.TextIOWrapper(io.BytesIO(), "utf-8"), ["handeye", *words], io.StringIO(typed)
    sys.stdout = sys.stderr = said
    try:
        main()
    except SystemExit as end:
        said.flush()
        print(json.dumps([end.code, said.buffer.getvalue().decode()]), file=sys.__stdout__, flush=True)
"""  # one process for all commands: each would import the package anew

Shell = Callable[..., str]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("toy")
    (folder / "two.toy").write_text(TWO_TASKS, encoding="utf-8")
    (folder / "wrong.toy").write_text("ADD A 1\nADDD  A 1\n", encoding="utf-8")
    return folder


def begun(folder: Path, *words: str) -> "subprocess.Popen[str]":
    """A process of Python, where the toy's package is installed."""
    return subprocess.Popen(
        [sys.executable, *words], cwd=folder, text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, env={**os.environ, "PYTHONPATH": PATHS, "COLUMNS": "120"},
    )  # fmt: skip


@pytest.fixture(scope="module")
def shell(folder: Path) -> Iterator[Shell]:
    """Carries out a command, and sees with which code it ends."""
    server = begun(folder, "-c", SERVER)
    assert server.stdin is not None
    assert server.stdout is not None
    lines, answers = server.stdin, server.stdout

    def carried_out(*words: str, typed: str = "", code: int = 0) -> str:
        print(json.dumps([words, typed]), file=lines, flush=True)
        answer = answers.readline()
        assert answer.startswith("["), answer + answers.read()
        ended, said = json.loads(answer)
        assert (ended, "Traceback" in said) == (code, False), said
        return str(said)

    yield carried_out
    server.communicate()


@pytest.fixture(scope="module")
def run(shell: Shell) -> str:
    """The folder of a whole run."""
    shell("toy", "two.toy", "--out", "run")
    return "run"


def test_its_commands_are_listed_and_no_system_is_imported_for_that(folder: Path) -> None:
    said, _ = begun(folder, "-c", LISTED).communicate()
    assert "Count with registers, in one task or several." in said
    assert "Count with many seeds." in said
    assert said.endswith("False False\n")


def test_its_files_are_checked_explained_and_formatted_in_its_own_language(shell: Shell) -> None:
    assert shell("check", "two.toy") == "two.toy: no errors\n"
    assert "error[toy-line]: `ADDD` is no line of the counter machine" in shell("check", "wrong.toy", code=2)
    assert shell("explain", "toy-line").startswith("a line begins with a word")
    assert "wrong.toy is unchanged" in shell("fmt", "wrong.toy", code=2)
    refused = shell("plan", "two.toy", code=2)
    assert refused == "handeye: two.toy: the counter machine cannot run a plan of motions\n"


def test_a_run_is_shown_verified_and_reported_with_the_event_that_it_adds(
    shell: Shell, run: str, folder: Path
) -> None:
    assert "register B holds 3" in shell("trace", "show", run)
    assert "The program finished." in shell("show", run)
    assert "the same" in shell("trace", "verify", run)
    shell("report", run)
    assert "register B holds 3" in (folder / run / "report.html").read_text(encoding="utf-8")


@pytest.mark.usefixtures("run")
def test_without_a_cell_a_run_ends_with_its_result(folder: Path) -> None:
    result = json.loads((folder / "run" / "result.json").read_bytes())
    assert (result["completed"], result["assembled"], result["task"]) == (True, None, "counting")


def test_what_it_cannot_do_is_refused_by_its_name(shell: Shell, run: str) -> None:
    cannot = "the counter machine cannot"
    undone = shell("dismantle", run, code=2)
    assert undone == f"handeye: run: {cannot} undo what it did: what is counted is counted\n"
    assert f"{cannot} compare two of its runs" in shell("compare", run, run, code=2)
    assert f"{cannot} make a video of its run" in shell("video", run, code=2)


def test_it_is_stepped_at_two_places_in_its_own_words_and_refuses_an_undo(shell: Shell, run: str) -> None:
    said = shell(
        "toy", "two.toy", "--step", "--out", "left", typed="step 3\nundo\nshow tasks\nhelp\nquit\n", code=2
    )
    assert "the counter machine cannot undo what it did: what is counted is counted\n" in said
    assert "TELL B, waiting for B 3" in said
    assert "set register NAME n" in said
    assert "Units: lines and seconds." in said
    assert "undo [N|stage]" not in said
    shell("resume", "left")
    assert "the same" in shell("trace", "verify", "left")


def test_a_run_that_was_killed_is_resumed_to_the_events_of_one_that_was_not(
    shell: Shell, folder: Path
) -> None:
    (folder / "long.toy").write_text(TWO_TASKS.replace(" 3", " 500"), encoding="utf-8")
    killed, events = (
        begun(folder, "-m", "handeye", "toy", "long.toy", "--out", "killed"),
        folder / "killed/events.jsonl",
    )
    while not events.exists() or events.read_bytes().count(b"\n") < 100:
        assert killed.poll() is None
        time.sleep(0.02)
    killed.kill()
    killed.communicate()
    assert not (folder / "killed" / "result.json").exists()
    shell("resume", "killed")
    shell("toy", "long.toy", "--out", "whole")
    left, whole = (
        [
            line
            for line in (folder / name / "events.jsonl").read_bytes().splitlines()
            if b"WentBack" not in line
        ]
        for name in ("killed", "whole")
    )
    assert left[-len(whole) + 2 :] == whole[2:]


def test_it_is_swept_like_every_system(shell: Shell, folder: Path) -> None:
    said = shell("trials", "counting", "--n", "3", "--jobs", "1", "--out", "batch")
    assert "3 of 3" in said
    assert (folder / "batch" / "figures.html").exists()
    shell("trials", "counting", "--n", "3", "--jobs", "1", "--out", "batch")


@pytest.mark.parametrize(
    "entry",
    [
        "exit(7)",
        "Entry(name='bad', title=3, help='', system='', commands=None)",
        "Entry(name='trig', title='', help='', system='')",
    ],
)
def test_an_entry_that_is_not_sound_breaks_no_command(entry: str, tmp_path: Path) -> None:
    info = tmp_path / "bad-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: bad\nVersion: 1.0\n", encoding="utf-8")
    (info / "entry_points.txt").write_text("[handeye.systems]\nbad = bad:ENTRY\n", encoding="utf-8")
    (tmp_path / "bad.py").write_text(
        f"from handeye.core.entries import Entry\nENTRY = {entry}\n", encoding="utf-8"
    )
    asked = "from handeye.core.entries import entries, entry_named; print(entries()['trig'].title); entry_named('bad')"
    said = subprocess.run(
        [sys.executable, "-c", asked], capture_output=True, text=True, env={**os.environ, "PYTHONPATH": str(tmp_path)}
    )  # fmt: skip
    assert said.stdout == "TRIG\n"
    assert "BadFile: the system `bad` cannot be loaded: " in said.stderr


def test_a_plan_that_records_no_task_is_refused_and_leaves_no_folder(shell: Shell, folder: Path) -> None:
    asked = (
        "import toy_system, toy_commands; from pathlib import Path\n"
        "class Bare(toy_system.Lines): task = None\n"
        "toy_commands.compiled = lambda source: Bare(steps=toy_system.counting().steps)\n"
        "toy_commands.toy(Path('two.toy'), out=Path('bare'))"
    )
    said, _ = begun(folder, "-c", asked).communicate()
    assert said.endswith("BadFile: the plan for the counter machine does not name its task\n")
    assert not (folder / "bare").exists()
