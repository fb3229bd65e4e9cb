"""Every command says what it has to say wherever it goes: any encoding, any width, a full disk, nobody there."""

import io
import os
import re
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import chdir
from functools import partial
from pathlib import Path
from typing import TextIO

import pytest
from cyclopts import App

from handeye import cli
from handeye.cli import STAND_INS
from handeye.cli.common import notes, screen
from handeye.results.page import _MARK
from handeye.tasks.water_pump.task import WaterPump

SCRIPT = """        STAGE   "insert the aligning pins"
        OPEN    1
        STAGE   "take out the aligning pins"
        OPEN    2
"""
CHEAP = {
    "assemble": "assemble --set ✓",
    "faults": "faults --only ✓",
    "run": "run job.plan.json --stage pins",
    "resume": "resume ✓",
    "do": "do PARK --set ✓",
    "repl": "repl --set ✓",
    "teach": "teach ✓.toml --set ✓",
    "check": "check wrong.al",
    "plan": "plan job.al",
    "stages": "stages job.plan.json",
    "fmt": "fmt --check job.al",
    "explain": "explain unit-written",
    "lsp": "lsp --help",
    "inspect": "inspect job.plan.json",
    "diff": "diff job.plan.json job.plan.json",
    "schema": "schema",
    "show": "show run",
    "report": "report ✓",
    "video": "video ✓",
    "view": "view ✓",
    "dismantle": "dismantle ✓",
    "trig": "trig ✓.trig.json",
    "sigma": "sigma ✓.mal",
    "ml": "ml ✓.ml",
    "docs": "docs ✓",
    "demo": "demo -o ✓",
    "compare": "compare ✓ ✓",
    "trace show": "trace show run",
    "trace stats": "trace stats run",
    "trace photograph": "trace photograph run --at 9e9 -o ✓.png",
    "trace plot": "trace plot ✓ -o ✓.jpg",
    "trace export csv": "trace export csv ✓ -o ✓",
    "trace export parquet": "trace export parquet ✓ -o ✓",
    "trace verify": "trace verify run/events.jsonl",
    "trace thin": "trace thin ✓ -o ✓.mcap",
    "world": "world --set part_mass=5%",
    "render": "render -o ✓.jpg",
    "export mjcf": "export mjcf ✓ -o ✓",
    "export glb": "export glb ✓ -o ✓.jpg",
    "export urdf": "export urdf -o ✓.jpg",
    "export lerobot": "export lerobot ✓ -o ✓",
    "trials assembly": "trials assembly --seeds ✓",
    "trials dismantling": "trials dismantling --set ✓",
    "trials disturbed": "trials disturbed --seed ✓",
    "trials pallet": "trials pallet --n ✓",
    "trials compare": "trials compare ✓ ✓",
    "trials base": "trials base --n ✓",
    "trials chess": "trials chess --n ✓",
    "trials handover": "trials handover --n ✓",
    "trials insert": "trials insert --n ✓",
    "trials prco": "trials prco --n ✓",
    "trials follow": "trials follow --n ✓",
    "trials line": "trials line --n ✓",
    "trials blocks": "trials blocks --n ✓",
    "trials train": "trials train --n ✓",
    "trials typewriter": "trials typewriter --n ✓",
    "trials support": "trials support --n ✓",
    "trials orient": "trials orient --n ✓",
    "trials bin": "trials bin --n ✓",
    "trials gasket": "trials gasket --n 1 --set ✓",
    "trials mutants": "trials mutants --most ✓",
    "trials record": "trials record ✓ --n 0",
    "trials rare": "trials rare --n ✓",
    "trials worst": "trials worst --rounds ✓",
    "exercise": "exercise ✓",
    "bench agents": "bench agents ✓ --command true",
    "env list": "env list",
    "env evaluate": "env evaluate ✓",
    "mcp": "mcp --folder ✓ --bad",
    "relay": "relay check ✓.relay",
    "trials chaos": "trials chaos --schedule ✓",
    "trials relay": "trials relay ✓.relay",
    "trials stages": "trials stages --stage ✓",
    "cache": "cache",
    "bench timing": "bench timing --set ✓",
    "bench insertion": "bench insertion ✓",
}
"""A line for each command that costs next to nothing: what would build a cell says only what is wrong with the line."""
ENCODINGS = ["utf-8", "cp1252", "latin-1", "ascii"]


def names_of(app: App, *group: str) -> Iterator[str]:
    """The commands of the app, those of groups too."""
    for word in app:
        if not word.startswith("-"):
            below = app[word]
            yield from [" ".join((*group, word))] if below.default_command else names_of(below, *group, word)


class Terminal(io.TextIOWrapper):
    """A file that is taken for a terminal."""

    def isatty(self) -> bool:
        return True


Start = Callable[..., int]


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a script, one that is wrong, a plan, and a run."""
    folder = tmp_path_factory.mktemp("streams")
    (folder / "job.al").write_text(SCRIPT, encoding="utf-8")
    (folder / "wrong.al").write_text("OPEN 1.5 in\n→ ✓\n", encoding="utf-8")
    with chdir(folder), pytest.MonkeyPatch.context() as patch:
        patch.setattr(WaterPump, "photographs", ())  # no line here shows them
        start = partial(cli.app, result_action="return_value", exit_on_error=False)
        assert start(["plan", "job.al"]) == start(["run", "job.plan.json", "--out", "run"]) == 0
    return folder


@pytest.fixture
def started(place: Path, monkeypatch: pytest.MonkeyPatch) -> Start:
    """Runs a line with these for standard output and standard error; the exit code."""

    def start(line: str, out: TextIO, err: TextIO) -> int:
        monkeypatch.chdir(place)
        monkeypatch.setattr(cli, "app", partial(cli.app, line.split()))
        with open(os.devnull, encoding="utf-8") as nothing, out, err:
            for name, stream in (("stdin", nothing), ("stdout", out), ("stderr", err)):
                monkeypatch.setattr(sys, name, stream)
            with pytest.raises(SystemExit) as end:
                cli.main()
            monkeypatch.undo()
        for console in (screen, notes):
            console._buffer.clear()  # what a full disk refused, and the next command would write
        assert isinstance(end.value.code, int)
        return end.value.code

    return start


def told(started: Start, line: str, folder: Path, encoding: str = "utf-8") -> tuple[int, str, str]:
    """Exit code, standard output and standard error of a line, where both are files of an encoding."""
    out, err = (folder / name for name in ("out", "err"))
    code = started(line, out.open("w", encoding=encoding), err.open("w", encoding=encoding))
    return code, out.read_text(encoding), err.read_text(encoding)


Told = tuple[int, str, str]


@pytest.fixture(scope="module")
def plainly() -> dict[str, Told]:
    """What lines say into files of UTF-8, as far as a test has asked."""
    return {}


@pytest.fixture
def plain(started: Start, tmp_path: Path, plainly: dict[str, Told]) -> Callable[[str], Told]:
    """What a line says into files of UTF-8: it is the same each time."""

    def say(line: str) -> Told:
        if line not in plainly:
            plainly[line] = told(started, line, tmp_path)
        return plainly[line]

    return say


def shown(started: Start, line: str, folder: Path, columns: int, monkeypatch: pytest.MonkeyPatch) -> str:
    """What a line shows on a terminal of so many columns, without its colours."""
    for console in (screen, notes):
        monkeypatch.setattr(console, "_width", columns)
    file = folder / "terminal"
    out, err = (Terminal(file.open("ab", 0), encoding="utf-8", write_through=True) for _ in range(2))
    started(line, out, err)
    return re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", file.read_text(encoding="utf-8"))


def nobody() -> TextIO:
    """A pipe whose reader has gone."""
    reader, writer = os.pipe()
    os.close(reader)
    return open(writer, "w", encoding="utf-8")


def full() -> TextIO:
    """A file on a full disk."""
    return open("/dev/full", "w", encoding="utf-8")


def test_every_command_has_a_line_here() -> None:
    assert {*CHEAP} == {*names_of(cli.app)}


@pytest.mark.parametrize("line", CHEAP.values())
def test_no_encoding_is_too_poor(
    started: Start, tmp_path: Path, line: str, plain: Callable[[str], Told]
) -> None:
    code, out, err = plain(line)
    for encoding in ENCODINGS[1:]:
        poor = told(started, line, tmp_path, encoding)
        assert (poor[0], len(poor[1].split()), len(poor[2].split())) == (
            code,
            len(out.split()),
            len(err.split()),
        )
        assert "Traceback" not in poor[2]


@pytest.mark.parametrize("line", CHEAP.values())
def test_a_reader_that_has_gone_is_told_by_the_code_alone(
    started: Start, tmp_path: Path, line: str, plain: Callable[[str], Told]
) -> None:
    code, out, _ = plain(line)
    err = tmp_path / "err"
    assert started(line, nobody(), err.open("w", encoding="utf-8")) == (141 if out else code)
    assert "Traceback" not in err.read_text(encoding="utf-8")
    assert started(line, nobody(), nobody()) in (code, 141)


@pytest.mark.parametrize("line", CHEAP.values())
def test_a_full_disk_is_told_in_a_sentence(
    started: Start, tmp_path: Path, line: str, plain: Callable[[str], Told]
) -> None:
    code, out, _ = plain(line)
    err = tmp_path / "err"
    assert started(line, full(), err.open("w", encoding="utf-8")) == (2 if out else code)
    lines = err.read_text(encoding="utf-8").splitlines()
    assert not out or lines[-1] == "handeye: standard output: No space left on device"
    assert started(line, full(), full()) in (code, 2)


@pytest.mark.parametrize("line", CHEAP.values())
def test_a_narrow_terminal_breaks_no_word(
    started: Start, tmp_path: Path, line: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    wide, narrow = (shown(started, line, tmp_path, columns, monkeypatch) for columns in (200, 40))
    assert {*re.findall(r"[A-Za-z]{3,}", wide)} <= {*re.findall(r"[A-Za-z]{3,}", narrow)}


@pytest.mark.parametrize("command", sorted({*CHEAP} - {"check", "schema"}))
def test_a_narrow_terminal_gets_no_line_that_it_would_break_itself(
    started: Start, tmp_path: Path, command: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """But for code frames and JSON, which mean something only as they are."""
    lines = shown(started, CHEAP[command], tmp_path, 40, monkeypatch).splitlines()
    assert [line for line in lines if len(line) > 40 and len(line.split()) > 1] == []


@pytest.mark.slow
def test_a_run_shows_its_stages_whole_in_forty_columns_and_in_ascii(
    started: Start, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    narrow = shown(started, "run job.plan.json --on-stop abort --details", tmp_path, 40, monkeypatch)
    assert {"insert", "take", "aligning", "pins"} <= {*narrow.split()}
    out = told(started, "run job.plan.json --details", tmp_path, "ascii")[1]
    assert "+  insert the aligning pins" in out


def test_a_plan_is_not_written_over_a_device(started: Start, tmp_path: Path) -> None:
    code, _, err = told(started, "plan job.al -o /dev/full", tmp_path)
    assert (code, err) == (2, "handeye: /dev/full cannot be written: it is not a file\n")


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_trials_that_are_interrupted_end_at_once_with_one_line_and_leave_no_process(
    tmp_path: Path, number: signal.Signals, request: pytest.FixtureRequest
) -> None:
    """As at a terminal, every process of the group hears Ctrl-C; being told to end, only the first.

    Tests that a shell began in the background ignore Ctrl-C, and so would what they begin. Standard error ends when
    the last process that has it ends.
    """
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    request.addfinalizer(lambda: signal.signal(signal.SIGINT, before))
    line = [sys.executable, "-m", "handeye", "trials", "follow", "--n", "4"]
    with subprocess.Popen(line, stderr=subprocess.PIPE, cwd=tmp_path, start_new_session=True) as trials:
        while not Path(f"/proc/{trials.pid}/task/{trials.pid}/children").read_text().split():
            assert trials.poll() is None
        (os.killpg if number == signal.SIGINT else os.kill)(trials.pid, number)
        assert trials.stderr is not None
        assert trials.stderr.read() == b"\nhandeye: interrupted\n"
    assert trials.returncode == 130


def test_the_mark_of_every_stage_has_a_stand_in() -> None:
    assert {mark for mark, _ in _MARK.values()} <= STAND_INS.keys()
