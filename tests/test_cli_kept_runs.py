"""`assemble` and `run` keep their run in `runs`; the newest ten stay, and the newest is what other commands take."""

import json
import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import Command

from handeye.core.errors import CannotWrite
from handeye.core.files import LineFile
from handeye.core.variation import WorldSpec
from handeye.planfile.store import read_plan
from handeye.runs import unnamed_runs
from handeye.runs.folder import EVENTS, MARK, RunFolder
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.runs.unnamed_runs import MOST, UnnamedRun, newest_run

Planned = Callable[[str], str]
RUNS = Path("runs")


@pytest.fixture(autouse=True)
def kept(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("HANDEYE_RUNS", "runs")
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def start(planned: Planned) -> Checkpoint:
    return Checkpoint(
        setup=Setup(plan=read_plan(Path(planned("OPEN 1\n"))), world=WorldSpec(seed=3), camera="ray")
    )


def begun(start: Checkpoint, seconds: int) -> Path:
    """An unnamed run that has left an event list, and was written to at that time."""
    run = UnnamedRun(RUNS, start)
    run.close()
    (run.path / EVENTS).touch()
    os.utime(run.path / EVENTS, (seconds, seconds))
    return run.path


@pytest.mark.slow
def test_ten_unnamed_runs_stay_and_the_oldest_goes_first(start: Checkpoint) -> None:
    runs = [begun(start, seconds) for seconds in range(MOST + 1)]
    assert len(set(runs)) == MOST + 1
    assert [run.exists() for run in runs] == [False] + MOST * [True]
    assert newest_run() == runs[-1]
    assert (RUNS / ".gitignore").read_text() == "*\n"


@pytest.mark.slow
def test_no_run_is_removed_that_has_a_name_or_other_things_or_a_writer(start: Checkpoint) -> None:
    renamed, noted, begins, goes_on, copied = (begun(start, seconds) for seconds in range(5))
    renamed = renamed.rename(RUNS / "best")
    (noted / "notes.txt").write_text("the pin was bent")
    copied = Path(shutil.copytree(copied, RUNS / "copy"))
    writers = [LineFile(begins / MARK, "a run"), LineFile(goes_on / EVENTS, "a run")]
    for seconds in range(MOST + 5):
        begun(start, 100 + seconds)
    assert all(run.exists() for run in (renamed, noted, begins, goes_on, copied))
    for writer in writers:
        writer.close()
    os.utime(goes_on / EVENTS, (0, 0))
    begun(start, 200)
    assert not any(run.exists() for run in (begins, goes_on))
    assert all(run.exists() for run in (renamed, noted, copied))


def test_a_folder_that_a_run_was_put_into_by_name_has_a_name(start: Checkpoint) -> None:
    path = begun(start, 0)
    unnamed_runs.open_new(path, start, overwrite=True).close()
    assert not (path / MARK).exists()


def test_a_run_that_is_dropped_leaves_nothing(start: Checkpoint) -> None:
    RUNS.mkdir()
    UnnamedRun(RUNS, start).discard()
    assert list(RUNS.iterdir()) == []


@pytest.mark.parametrize(
    "words", [("show",), ("report",), ("resume",), ("video",), ("trace", "show"), ("compare",)]
)
def test_without_a_run_commands_say_how_to_make_one(command: Command, words: tuple[str, ...]) -> None:
    sentence = "handeye: there is no run in runs; give the folder of a run, or make a run: handeye assemble\n"
    assert command(*words) == (2, "", sentence)


def test_a_run_is_kept_or_not(command: Command) -> None:
    said = command("run", "insertion", "--no-keep", "--out", "it")
    assert said == (2, "", "handeye: --no-keep cannot be given with --out\n")


@pytest.mark.slow
def test_a_run_is_kept_and_the_newest_is_what_commands_take(command: Command, planned: Planned) -> None:
    plan = planned("OPEN 1\n")
    code, out, err = command("run", plan, "--camera", "ray", "--json")
    (run,) = (path for path in RUNS.iterdir() if path.is_dir())
    assert (code, f"saved in {run} (" in err) == (0, True)
    assert json.loads(out) == json.loads((run / "result.json").read_bytes())
    assert command("run", plan, "--camera", "ray", "--no-keep")[0] == 0
    assert command("show", "--json")[1:] == (out, f"using the newest run, {run}\n")
    _, out, err = command("run", plan, "--camera", "ray", "--out", "named")
    assert err.endswith("see it:     handeye report named\nall tables: handeye show named\n")
    assert command("show", "--json")[2] == f"using the newest run, {run}\n"
    for name in ("events.jsonl", "plan.json", "trace.mcap"):  # to keep a run changes none of its bytes
        assert Path("named", name).read_bytes() == (run / name).read_bytes()


@pytest.mark.slow
@pytest.mark.parametrize("method", ["watch", "tick", "event", "checkpoint"])
def test_a_disk_that_is_full_costs_a_sentence_and_not_the_run(
    command: Command, planned: Planned, monkeypatch: pytest.MonkeyPatch, method: str
) -> None:
    def full(*args: object, **more: object) -> None:
        raise CannotWrite("no space left")

    plan = planned("OPEN 1\n")
    monkeypatch.setattr(RunFolder, method, full)
    code, out, err = command("run", plan, "--camera", "ray")
    assert (code, out.splitlines()[0]) == (0, "The program finished.")
    assert err.count("the rest of the run is not saved: no space left\n") == 1
    assert "saved in" not in err


@pytest.mark.slow
def test_a_place_that_cannot_be_had_costs_a_sentence_and_not_the_run(
    command: Command, planned: Planned
) -> None:
    plan = planned("OPEN 1\n")
    RUNS.write_text("a file")
    code, out, err = command("run", plan, "--camera", "ray")
    assert (code, out.splitlines()[0]) == (0, "The program finished.")
    assert err.startswith("the run is not saved: runs cannot be written: ")
