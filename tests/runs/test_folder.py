"""The folder that a run leaves, and going on with it after whatever happened."""

import os
import resource
import shutil
import signal
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest
from forged_checkpoints import changed
from short_runs import GRASP, begin, history, plan_of

from handeye.core.errors import CannotWrite, InvalidInput
from handeye.planfile.store import write_plan
from handeye.program.events import AnyEvent, WentBack
from handeye.runs import folder as folders
from handeye.runs.advance import AfterStage, advance
from handeye.runs.checkpoint_file import encode
from handeye.runs.checkpoint_store import CheckpointStore
from handeye.runs.folder import REPORT, RunFolder, open_again, open_new
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.trace.eventlist import Journal, effective, read_events

pytestmark = pytest.mark.slow


def recorded(path: Path, start: Checkpoint, *, overwrite: bool = False) -> tuple[Runner, RunFolder]:
    """A run that begins, kept in a folder."""
    folder = open_new(path, start, overwrite=overwrite)
    return Runner(start, observers=lambda runner: [folder.watch(runner, start, again=False)]), folder


def gone_on(path: Path) -> Runner:
    """A run that was broken off, carried out to its end."""
    folder, start, _ = open_again(path)
    runner = Runner(start, observers=lambda runner: [folder.watch(runner, start, again=True)])
    advance(runner)
    runner.finish()
    folder.close()
    return runner


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a run that nobody broke off."""
    path = tmp_path_factory.mktemp("runs") / "whole"
    runner, folder = recorded(path, begin())
    advance(runner)
    runner.finish()
    folder.close()
    return path


@pytest.fixture(scope="module")
def broken(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a run that ended in the middle of its second stage, without a word."""
    path = tmp_path_factory.mktemp("runs")
    runner, folder = recorded(path / "run", begin())
    advance(runner, steps=5)
    shutil.copytree(path / "run", path / "broken")  # as a power cut would leave it
    folder.close()
    return path / "broken"


@pytest.fixture
def copy(broken: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(broken, tmp_path / "copy"))


def names(path: Path) -> list[str]:
    return sorted(file.name for file in path.iterdir())


def test_it_holds_plan_events_trace_and_a_checkpoint_for_each_stage(whole: Path) -> None:
    assert names(whole) == ["checkpoints", "events.jsonl", "host.json", "pictures", "plan.json", "trace.mcap"]
    assert names(whole / "checkpoints") == [
        "0000-go-to-the-pin.checkpoint",
        "0002-take-the-pin.checkpoint",
        "0006-feel-for-nothing.checkpoint",
        "0011-end.checkpoint",
        "start.checkpoint",
    ]


def test_a_run_broken_off_in_a_stage_ends_with_the_same_trace_and_events(whole: Path, copy: Path) -> None:
    gone_on(copy)
    assert (copy / "trace.mcap").read_bytes() == (whole / "trace.mcap").read_bytes()
    assert effective(read_events(copy / "events.jsonl")) == read_events(whole / "events.jsonl")


def test_what_was_undone_stays_in_the_journal(copy: Path) -> None:
    before = (copy / "events.jsonl").read_bytes()
    gone_on(copy)
    after = (copy / "events.jsonl").read_bytes()
    assert after.startswith(before)
    (back,) = [event for event in read_events(copy / "events.jsonl") if isinstance(event, WentBack)]
    assert back.why == "resumed"


def test_a_last_line_that_was_cut_short_is_dropped(whole: Path, copy: Path) -> None:
    with (copy / "events.jsonl").open("ab") as file:
        file.write(b'{"event":"StepFi')
    gone_on(copy)
    assert effective(read_events(copy / "events.jsonl")) == read_events(whole / "events.jsonl")


@pytest.mark.parametrize("lost", ["trace.mcap.part", "events.jsonl"])
def test_a_file_that_is_lost_keeps_nobody_from_going_on(whole: Path, copy: Path, lost: str) -> None:
    (copy / lost).unlink()
    assert history(gone_on(copy).events) == (whole / "events.jsonl").read_bytes()


def test_a_trace_is_lost_only_where_the_run_was_traced_before(copy: Path, tmp_path: Path) -> None:
    (copy / "trace.mcap.part").unlink()
    folder, start, _ = open_again(copy)
    Runner(start, observers=lambda runner: [folder.watch(runner, start, again=True)])
    folder.close()
    _, elsewhere = recorded(tmp_path / "elsewhere", start)
    elsewhere.close()
    assert (folder.lost > 0, elsewhere.lost) == (True, 0)


def test_a_damaged_checkpoint_is_left_out_for_the_one_before(whole: Path, copy: Path) -> None:
    newest = copy / "checkpoints" / "0002-take-the-pin.checkpoint"
    newest.write_bytes(newest.read_bytes()[:-9])
    _, start, faults = open_again(copy)
    assert start.position == 0
    assert faults == [f"{newest} is damaged or cut short: its checksum is wrong"]
    gone_on(copy)
    assert (copy / "trace.mcap").read_bytes() == (whole / "trace.mcap").read_bytes()


def test_a_checkpoint_whose_state_cannot_be_read_is_left_out_by_name(copy: Path) -> None:
    newest = copy / "checkpoints" / "0002-take-the-pin.checkpoint"
    newest.write_bytes(changed(newest.read_bytes(), events=[{"event": "NoEvent"}]))
    _, start, faults = open_again(copy)
    assert start.position == 0
    assert [fault.partition(":")[0] for fault in faults] == [f"{newest} is not a valid checkpoint"]


def test_with_nothing_but_the_start_it_begins_anew(whole: Path, copy: Path) -> None:
    for path in (copy / "checkpoints").glob("0*"):
        path.unlink()
    gone_on(copy)
    assert (copy / "trace.mcap").read_bytes() == (whole / "trace.mcap").read_bytes()


def test_a_run_that_had_ended_ends_again(whole: Path, tmp_path: Path) -> None:
    path = Path(shutil.copytree(whole, tmp_path / "copy"))
    assert gone_on(path).position == 11
    assert (path / "trace.mcap").read_bytes() == (whole / "trace.mcap").read_bytes()


def test_a_report_made_while_a_run_went_on_is_taken_away_when_it_is_closed(tmp_path: Path) -> None:
    runner, folder = recorded(tmp_path / "run", begin())
    advance(runner, steps=1)
    (tmp_path / "run" / REPORT).touch()
    advance(runner, steps=1)
    folder.close()
    assert not (tmp_path / "run" / REPORT).exists()


def test_going_back_takes_later_checkpoints_away(tmp_path: Path) -> None:
    runner, folder = recorded(tmp_path / "run", begin())
    advance(runner, steps=7)
    runner.back_to(3)
    folder.close()
    assert names(tmp_path / "run" / "checkpoints") == [
        "0000-go-to-the-pin.checkpoint",
        "0002-take-the-pin.checkpoint",
        "start.checkpoint",
    ]


def test_the_trace_of_a_run_with_detours_is_that_of_one_without(whole: Path, tmp_path: Path) -> None:
    runner, folder = recorded(tmp_path / "run", begin())
    for forward, back in ((4, 1), (7, 3), (9, 8)):
        advance(runner, steps=forward - runner.position)
        runner.back_to(back)
    advance(runner)
    runner.finish()
    folder.close()
    assert (tmp_path / "run" / "trace.mcap").read_bytes() == (whole / "trace.mcap").read_bytes()
    events = read_events(tmp_path / "run" / "events.jsonl")
    assert sum(isinstance(event, WentBack) for event in events) == 3
    assert effective(events) == read_events(whole / "events.jsonl")


def test_checkpoints_of_another_plan_are_refused(copy: Path) -> None:
    write_plan(copy / "plan.json", plan_of("OPEN 2\n"))
    before = {path: path.read_bytes() for path in copy.rglob("*") if path.is_file()}
    with pytest.raises(InvalidInput, match="belong to another plan"):
        open_again(copy)
    assert {path: path.read_bytes() for path in copy.rglob("*") if path.is_file()} == before


def test_a_folder_without_checkpoints_cannot_be_gone_on_with(tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match="holds no run"):
        open_again(tmp_path)


@pytest.mark.parametrize("start", [begin(), begin("OPEN 2\n"), begin(GRASP, seed=5)])
def test_a_run_is_not_overwritten_by_another_or_by_its_like(copy: Path, start: Checkpoint) -> None:
    before = {file: file.read_bytes() for file in copy.rglob("*.*")}
    with pytest.raises(InvalidInput, match=r"holds a run: `handeye resume .*` resumes it, --overwrite"):
        open_new(copy, start)
    assert {file: file.read_bytes() for file in copy.rglob("*.*")} == before


def test_a_folder_set_up_for_another_run_is_left_to_it(tmp_path: Path) -> None:
    open_new(tmp_path / "run", begin()).close()
    with pytest.raises(InvalidInput, match=r"belongs to another run \(seed 0"):
        open_new(tmp_path / "run", begin(GRASP, seed=5))


def test_a_folder_of_other_things_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / "holiday.png").touch()
    for overwrite in (False, True):
        with pytest.raises(InvalidInput, match=r"holds other files \(`holiday\.png`\); choose a new folder"):
            open_new(tmp_path, begin(), overwrite=overwrite)
    assert names(tmp_path) == ["holiday.png"]


def test_pictures_that_no_run_has_left_are_left_alone(tmp_path: Path) -> None:
    (tmp_path / "pictures").mkdir()
    (tmp_path / "pictures" / "holiday.png").touch()
    for overwrite in (False, True):
        with pytest.raises(InvalidInput, match=r"holds other files \(`pictures`\)"):
            open_new(tmp_path, begin(), overwrite=overwrite)
    assert names(tmp_path / "pictures") == ["holiday.png"]


def test_a_run_takes_the_place_of_another_if_it_is_told_to(copy: Path, whole: Path) -> None:
    (copy / "pictures" / "old.png").touch()
    runner, folder = recorded(copy, begin("OPEN 2\n"), overwrite=True)
    advance(runner)
    runner.finish()
    folder.close()
    assert not (copy / "pictures" / "old.png").exists()
    runner, folder = recorded(copy, begin(), overwrite=True)
    advance(runner)
    runner.finish()
    folder.close()
    assert names(copy) == names(whole)
    for name in ("events.jsonl", "trace.mcap", "plan.json"):
        assert (copy / name).read_bytes() == (whole / name).read_bytes()


def test_the_checkpoint_of_a_stage_is_found_or_the_nearest_before_it(whole: Path) -> None:
    kept = CheckpointStore(whole / "checkpoints")
    found = kept.for_stage(begin().setup, 1)
    assert found is not None
    assert (found.stage, found.position) == ("take the pin", 2)
    (whole / "checkpoints" / "0002-take-the-pin.checkpoint").rename(whole / "aside")
    nearest = kept.for_stage(begin().setup, 1)
    (whole / "aside").rename(whole / "checkpoints" / "0002-take-the-pin.checkpoint")
    assert nearest is not None
    assert nearest.stage == "go to the pin"


def test_a_journal_on_a_full_disk_says_so_and_makes_up_for_what_it_could_not_tell(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "events.jsonl"
    journal = Journal(path, begun_events(), again=False)
    before = path.read_bytes()
    limit = resource.getrlimit(resource.RLIMIT_FSIZE)
    monkeypatch.setattr(signal, "SIGXFSZ", signal.signal(signal.SIGXFSZ, signal.SIG_IGN))
    resource.setrlimit(resource.RLIMIT_FSIZE, (len(before) + 10, limit[1]))
    try:
        with pytest.raises(InvalidInput, match=r"events\.jsonl cannot be written"):
            journal.undone(1, 0.0, "back")
        assert path.read_bytes() == before
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limit)
    again = begun_events()[-1]
    journal.append(again)
    journal.close()
    *_, back, last = read_events(path)
    assert (isinstance(back, WentBack), last) == (True, again)


def begun_events() -> tuple[AnyEvent, ...]:
    """What happens first in a run."""
    return tuple(through_start().events)


@cache
def through_start() -> Runner:
    runner = Runner(begin())
    runner.step()
    return runner


def test_one_folder_takes_one_run_at_a_time(copy: Path) -> None:
    journal = Journal(copy / "events.jsonl", (), again=True)
    before = (copy / "events.jsonl").read_bytes()
    with pytest.raises(InvalidInput, match=r"another run is writing to .*events\.jsonl now"):
        gone_on(copy)
    journal.close()
    assert (copy / "events.jsonl").read_bytes() == before


def test_a_folder_that_a_run_cannot_begin_in_is_not_left_half_made(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object, **__: object) -> None:
        raise CannotWrite("no room")

    monkeypatch.setattr(folders, "Journal", fail)
    start = begin()
    folder = open_new(tmp_path / "new" / "run", start)
    with pytest.raises(CannotWrite, match=r"^no room$"):
        Runner(start, observers=lambda runner: [folder.watch(runner, start, again=False)])
    folder.discard()
    assert list(tmp_path.iterdir()) == []


def test_a_run_that_cannot_begin_leaves_the_record_of_the_one_before(whole: Path, tmp_path: Path) -> None:
    path = Path(shutil.copytree(whole, tmp_path / "copy"))
    before = {file: file.read_bytes() for file in path.rglob("*.*")}
    open_new(path, begin(), overwrite=True).discard()
    assert {file: file.read_bytes() for file in path.rglob("*.*")} == before


@pytest.mark.parametrize("name", ["checkpoints/0002-take-the-pin.checkpoint", "plan.json", "trace.mcap"])
def test_what_cannot_be_read_is_not_replaced(copy: Path, name: str) -> None:
    (copy / name).write_bytes(b"of a later version, perhaps")
    before = {file: file.read_bytes() for file in copy.rglob("*.*")}
    with pytest.raises(InvalidInput, match="holds a run"):
        open_new(copy, begin())
    assert {file: file.read_bytes() for file in copy.rglob("*.*")} == before


def test_a_record_that_nothing_tells_the_run_of_is_not_replaced(copy: Path) -> None:
    shutil.rmtree(copy / "checkpoints")
    with pytest.raises(InvalidInput, match="holds a run"):
        open_new(copy, begin())
    assert (copy / "events.jsonl").exists()


def test_states_of_a_run_somebody_took_a_hand_in_are_not_replaced(tmp_path: Path) -> None:
    runner, folder = recorded(tmp_path / "run", begin())
    advance(runner, steps=5)
    runner.experiment("saved", "C1", (0.0, 0.0, 0.001))
    folder.checkpoint(runner.checkpoint())
    folder.close()
    with pytest.raises(InvalidInput, match="with interventions by a person"):
        CheckpointStore(tmp_path / "run" / "checkpoints").claim(begin().setup)


def test_of_one_position_only_the_state_kept_last_is_left(whole: Path, tmp_path: Path) -> None:
    path = Path(shutil.copytree(whole / "checkpoints", tmp_path / "copy"))
    (path / "0002-take-the-pin.checkpoint").rename(path / "0002-as-it-was-before.checkpoint")
    kept = CheckpointStore(path)
    checkpoint = CheckpointStore(whole / "checkpoints").for_stage(begin().setup, 1)
    assert checkpoint is not None
    kept.save(checkpoint)
    assert [name for name in names(path) if name.startswith("0002")] == ["0002-take-the-pin.checkpoint"]


def test_nothing_happens_behind_a_trace_that_was_broken_off(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    runner, folder = recorded(tmp_path / "run", begin())
    advance(runner, steps=5)

    def full(*_: object) -> int:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as disk:
        disk.setattr("handeye.trace.mcap_writer.os.write", full)
        with pytest.raises(
            InvalidInput, match=r"trace\.mcap\.part cannot be written: No space left on device"
        ):
            folder.checkpoint(runner.checkpoint())
    kept, told = names(tmp_path / "run" / "checkpoints"), (tmp_path / "run" / "events.jsonl").read_bytes()
    with pytest.raises(
        InvalidInput,
        match=r"was cut short; free some disk space, then `handeye resume .*run` "
        r"continues",
    ):
        runner.step()
    folder.checkpoint(runner.checkpoint())
    assert names(tmp_path / "run" / "checkpoints") == kept
    assert (tmp_path / "run" / "events.jsonl").read_bytes() == told
    folder.close()


def test_a_stage_alone_ends_in_the_state_it_has_within_the_whole_run(whole: Path) -> None:
    kept = CheckpointStore(whole / "checkpoints")
    start, end = (kept.for_stage(begin().setup, number) for number in (1, 2))
    assert start is not None
    assert end is not None
    runner = Runner(start)
    assert advance(runner, [AfterStage(stage=1, name=runner.listing.stages[1])]).kind == "break"
    assert encode(runner.checkpoint()) == encode(end)


@pytest.mark.parametrize("make", [Path.mkdir, os.mkfifo])
def test_a_journal_that_is_no_file_is_refused_at_once(make: Callable[[Path], None], tmp_path: Path) -> None:
    make(tmp_path / "events.jsonl")
    with pytest.raises(InvalidInput, match=r"events\.jsonl cannot be written: it is not a file$"):
        Journal(tmp_path / "events.jsonl", (), again=True)
