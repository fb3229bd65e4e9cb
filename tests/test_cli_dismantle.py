"""`handeye dismantle` makes the arm undo a run, and tells what came of it."""

import json
import shutil
from pathlib import Path

import pytest
from conftest import Command
from report_pages import tree
from short_runs import begin

from handeye.cli import programs
from handeye.core.resources import plans
from handeye.judge.finding import at_most
from handeye.runs.checkpoint_file import decode, encode, read_checkpoint
from handeye.runs.folder import open_new
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.tasks.water_pump.task import WaterPump

pytestmark = pytest.mark.slow

TAKE = """
        STAGE   "take the pin"
        OPEN    1
        MOVE    P1
        CENTER  .1
        CLOSE   0.1
        STAGE   "draw it out"
        CHANGE  [0 0 1] 1.5
"""
DROP = f"{TAKE}        OPEN    1\n"


def kept(path: Path, script: str) -> Path:
    """The folder of a run that has ended."""
    start = begin(script)
    folder = open_new(path, start)
    runner = Runner(start, observers=lambda runner: [folder.watch(runner, start, again=False)])
    while not runner.ended:
        if runner.between_stages:
            folder.checkpoint(runner.checkpoint())
        runner.step()
    folder.checkpoint(runner.checkpoint())
    folder.close()
    return path


@pytest.fixture(scope="module")
def taken(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return kept(tmp_path_factory.mktemp("taken") / "run", TAKE)


@pytest.fixture(scope="module")
def dropped(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return kept(tmp_path_factory.mktemp("dropped") / "run", DROP)


def files(folder: Path) -> dict[str, bytes]:
    return {str(file): file.read_bytes() for file in folder.rglob("*") if file.is_file()}


def test_what_a_run_did_is_undone_and_its_folder_stays_as_it_was(command: Command, taken: Path) -> None:
    before = files(taken)
    code, out, err = command("dismantle", str(taken), "--out", "apart")
    assert code == 0, out + err
    assert "The pump is taken apart." in out
    assert "lost or damaged" not in err
    assert files(taken) == before
    assert command("dismantle", "apart")[0::2] == (2, "handeye: apart is already undone\n")
    again = command("resume", "apart")
    assert (again[0], "taken apart" in again[1]) == (0, True)


def test_as_json_the_referee_tells_how_far_each_part_is_from_where_it_was(
    command: Command, taken: Path
) -> None:
    code, out, _ = command("dismantle", str(taken), "--json")
    told = json.loads(out)
    assert (code, told["apart"], told["assembled"], told["completed"]) == (0, True, None, True)
    assert told["message"] == "the arm has undone all the steps that it was asked to undo"
    assert told["referee"]["pins"]["value"] < 0.5
    assert {stage["status"] for stage in told["stages"]} == {"undone"}


def test_it_goes_back_to_the_beginning_of_a_stage(command: Command, taken: Path) -> None:
    code, out, _ = command("dismantle", str(taken), "--to", "draw", "--json")
    told = json.loads(out)
    assert (code, told["apart"], told["referee"]) == (0, None, {})
    assert [stage["status"] for stage in told["stages"]] == ["done", "undone"]


def test_the_page_of_a_run_that_was_undone_so_far_says_so(command: Command, taken: Path) -> None:
    assert command("dismantle", str(taken), "--to", "draw", "--out", "apart")[0] == 0
    assert command("report", "apart")[0] == 0
    page = tree(Path("apart/report.html").read_text(encoding="utf-8"))
    assert page.all("h1")[0].text == "The undo is complete."


def test_a_guard_stops_it_with_exit_code_1_and_says_why(command: Command, dropped: Path) -> None:
    code, out, _ = command("dismantle", str(dropped))
    assert code == 1
    assert "the gap is" in " ".join(out.split())


@pytest.mark.parametrize("inner", ["", "apart", "checkpoints/apart"])
def test_it_is_not_kept_in_the_folder_of_the_run(command: Command, taken: Path, inner: str) -> None:
    before = files(taken)
    out = str(taken / inner)
    code, _, err = command("dismantle", str(taken), "--out", out, "--overwrite")
    assert (code, err) == (
        2,
        f"handeye: --out {out} is in the folder of the run {taken}, but the folder of a run must not change; "
        "choose another folder\n",
    )
    assert files(taken) == before


def test_what_a_killed_run_did_since_its_last_checkpoint_is_undone_too(command: Command, taken: Path) -> None:
    shutil.copytree(taken, "killed")
    last = max(Path("killed/checkpoints").glob("0*.checkpoint"))
    last.unlink()
    events = Path("killed/events.jsonl")
    events.write_bytes(events.read_bytes()[:-5])
    code, out, err = command("dismantle", "killed", "--json")
    assert "repeating 1 step that came after the last checkpoint in killed" in err
    assert (code, json.loads(out)["apart"]) == (0, True)
    undone = [stage["status"] for stage in json.loads(out)["stages"]]
    assert undone == ["undone", "undone"]


def test_what_is_not_carried_out_again_as_it_was_is_not_undone(command: Command, taken: Path) -> None:
    shutil.copytree(taken, "other")
    max(Path("other/checkpoints").glob("0*.checkpoint")).unlink()
    events = Path("other/events.jsonl")
    told = events.read_text("utf-8")
    last = told.rindex('"gap":0.0') + len('"gap":0.')
    events.write_text(f"{told[:last]}9{told[last + 1 :]}", encoding="utf-8")
    code, _, err = command("dismantle", "other")
    assert code == 2
    assert (
        "the steps of other after its newest checkpoint give a different result when they are repeated here"
        in err
    )


def test_an_event_list_that_is_not_of_the_run_is_left_out(command: Command, taken: Path) -> None:
    shutil.copytree(taken, "other")
    events = Path("other/events.jsonl")
    events.write_text(events.read_text("utf-8").replace('"gap":0.0', '"gap":0.9'), encoding="utf-8")
    code, _, err = command("dismantle", "other")
    assert code == 0
    assert (
        "left out: other/events.jsonl; these events and the checkpoints in other belong to different runs"
        in err
    )


def test_it_is_resumed_where_it_was_broken_off(command: Command, taken: Path) -> None:
    command("dismantle", str(taken), "--out", "apart")
    whole = Path("apart/events.jsonl").read_bytes()
    last = max(Path("apart/checkpoints").glob("0*.checkpoint"))
    last.unlink()
    for left in ("result.json", "trace.mcap"):
        Path("apart", left).unlink()
    code, out, _ = command("resume", "apart")
    assert (code, "The pump is taken apart." in out) == (0, True)
    again = [line for line in Path("apart/events.jsonl").read_bytes().splitlines() if b"WentBack" not in line]
    assert again[-1] == whole.splitlines()[-1]


def test_a_run_of_an_older_handeye_is_refused_in_a_sentence(command: Command, taken: Path) -> None:
    newest = read_checkpoint(max((taken / "checkpoints").glob("0*.checkpoint")))
    assert newest.snapshot is not None
    newest.snapshot.state.done.clear()  # type: ignore[attr-defined] # a state of the executor
    Path("old.checkpoint").write_bytes(encode(newest))
    code, _, err = command("dismantle", "old.checkpoint")
    assert code == 2
    assert err == ("handeye: old.checkpoint has no record of how to undo its first steps\n")


def test_a_folder_without_a_run_is_refused(command: Command) -> None:
    Path("empty").mkdir()
    code, _, err = command("dismantle", "empty")
    assert (code, err) == (2, "handeye: empty holds no run\n")


def test_a_run_that_has_not_begun_leaves_nothing_to_undo(command: Command) -> None:
    Path("new.checkpoint").write_bytes(encode(Checkpoint(setup=begin(TAKE).setup)))
    code, _, err = command("dismantle", "new.checkpoint")
    assert code == 2
    assert err == "handeye: new.checkpoint has not run any program: there is nothing to undo\n"


def test_a_way_that_was_tampered_with_stops_the_arm(command: Command, taken: Path) -> None:
    from msgspec.structs import replace

    newest = decode(max((taken / "checkpoints").glob("0*.checkpoint")).read_bytes(), "run")
    assert newest.snapshot is not None
    done = newest.snapshot.state.done  # type: ignore[attr-defined] # a state of the executor
    done[-1] = replace(done[-1], way=b"no way")
    Path("bad.checkpoint").write_bytes(encode(newest))
    code, out, _ = command("dismantle", "bad.checkpoint")
    assert code == 1
    assert "the record for undoing this step cannot be used" in " ".join(out.split())


# -- built, unbuilt, and built again ------------------------------------------------------------------


@pytest.fixture
def short_pump(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """`handeye assemble` draws a pin out of its holder, and its referee finds that right."""
    script = tmp_path / "short.al"
    script.write_text(TAKE, encoding="utf-8")
    (tmp_path / "short.toml").write_bytes((plans() / "water_pump.toml").read_bytes())
    monkeypatch.setattr(programs, "default_script", lambda _: script)
    monkeypatch.setattr(WaterPump, "judge", lambda self, truth: {"pin": at_most(0.0, 1.0, "mm", "pin")})


@pytest.mark.usefixtures("short_pump")
def test_what_was_built_is_taken_apart_and_built_again_in_one_run(command: Command) -> None:
    code, out, err = command(
        "assemble", "--then", "dismantle", "--then", "assemble", "--out", "thrice", "--json"
    )
    told = json.loads(out)
    assert (code, told["assembled"], told.get("apart")) == (0, True, None)
    assert [line for line in err.splitlines() if line.startswith("The pump")] == [
        "The pump is assembled.",
        "The pump is taken apart.",
    ]
    assert command("trace", "verify", "thrice")[0] == 0


@pytest.mark.usefixtures("short_pump")
def test_a_run_may_end_taken_apart(command: Command) -> None:
    code, out, _ = command("assemble", "--then", "dismantle")
    assert (code, "The pump is taken apart." in out) == (0, True)


@pytest.mark.usefixtures("short_pump")
def test_the_first_part_that_fails_gives_the_exit_code(
    command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(WaterPump, "judge_apart", lambda self, truth: {"pin": at_most(2.0, 1.0, "mm", "pin")})
    code, out, _ = command("assemble", "--then", "dismantle", "--then", "assemble", "--json")
    assert (code, json.loads(out)["apart"]) == (3, False)


@pytest.mark.parametrize("parts", [["assemble"], ["dismantle", "dismantle"]])
def test_what_stands_is_dismantled_first(command: Command, parts: list[str]) -> None:
    code, _, err = command("assemble", *(word for part in parts for word in ("--then", part)))
    assert code == 2
    assert "in turn, beginning with dismantle" in err
