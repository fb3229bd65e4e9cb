"""What the folder of a run tells of it, whatever has become of the run, and of the folder."""

import re
import shutil
from collections.abc import Callable, Iterator
from math import inf, isnan, nan
from pathlib import Path

import msgspec
import pytest
from toy_system import begin_toy

from handeye.core.errors import InvalidInput
from handeye.core.variation import WorldSpec
from handeye.results.finishing import finished
from handeye.results.kept_run import has_ended, kept_run
from handeye.results.result import Check, to_json
from handeye.runs.advance import advance
from handeye.runs.folder import EVENTS, HOST, PLAN, RESULT, open_again, open_new
from handeye.runs.host_seconds import HostSeconds, Meter
from handeye.runs.runner import Runner


@pytest.fixture
def run(tmp_path: Path) -> Path:
    return tmp_path / "run"


@pytest.fixture
def begun(run: Path) -> Iterator[Runner]:
    """A run of the counter machine that has moved, in a folder that nobody has closed yet."""
    start = begin_toy()
    folder = open_new(run, start)
    runner = Runner(start, observers=lambda r: [folder.watch(r, start, again=False)])
    advance(runner, steps=4)
    yield runner
    folder.close()


def content(path: Path) -> dict[str, bytes]:
    """All files below a folder."""
    return {str(file): file.read_bytes() for file in path.rglob("*") if file.is_file()}


@pytest.fixture
def broken(run: Path, begun: Runner) -> Path:
    assert begun.position == 4
    return run


@pytest.fixture
def ended(run: Path, begun: Runner) -> Path:
    """The folder of a run that has ended, and left its result."""
    advance(begun)
    begun.answer("proceed")
    result = finished(begun, advance(begun), Meter(), judged=False)
    (run / RESULT).write_bytes(to_json(result))
    return run


def test_a_run_that_was_broken_off_tells_how_far_it_has_come(broken: Path) -> None:
    kept = kept_run(broken)
    assert [(stage.name, stage.status) for stage in kept.result.stages] == [
        ("count", "under way"), ("ask", "not reached")
    ]  # fmt: skip
    assert (kept.result.paused, kept.result.completed, kept.result.stopped_at) == (True, False, "count")
    assert (kept.result.message, kept.left, kept.faults) == ("running or interrupted at 4.0 s", False, ())


def test_a_run_that_waits_for_the_operator_says_what_it_was_told(run: Path, begun: Runner) -> None:
    advance(begun)
    assert kept_run(run).result.message == "the operator is wanted"


def test_to_look_at_a_run_changes_nothing(broken: Path) -> None:
    before = content(broken)
    kept_run(broken)
    assert content(broken) == before


def test_the_result_of_a_run_that_has_ended_is_its_record(ended: Path) -> None:
    assert to_json(kept_run(ended).result) == (ended / RESULT).read_bytes()


@pytest.mark.parametrize(("judged", "over"), [(False, True), (True, False)])
def test_a_run_is_over_when_all_that_was_asked_of_it_is_recorded(
    ended: Path, judged: bool, over: bool
) -> None:
    assert has_ended(ended, open_again(ended)[1], judged=judged) is over


@pytest.mark.parametrize(("goes_on", "stands"), [(False, True), (True, False)])
def test_a_result_stands_until_its_run_goes_on(
    tmp_path: Path, ended: Path, goes_on: bool, stands: bool
) -> None:
    copy = Path(shutil.copytree(ended, tmp_path / "copy"))
    folder, newest, _ = open_again(copy)
    runner = Runner(newest, observers=lambda r: [folder.watch(r, newest, again=True)])
    if goes_on:
        runner.rollback()
    folder.close()
    assert (copy / RESULT).exists() is stands


OTHERS = {"program": "another", "task": "another", "world": WorldSpec(seed=0, level="high"), "seed": 77}


@pytest.mark.parametrize("name", OTHERS)
def test_the_result_of_another_run_is_left_out_and_told_of(ended: Path, name: str) -> None:
    other = msgspec.structs.replace(kept_run(ended).result, **{name: OTHERS[name]})
    (ended / RESULT).write_bytes(to_json(other))
    kept = kept_run(ended)
    assert [fault.partition(",")[0] for fault in kept.faults] == [f"{ended / RESULT} belongs to another run"]
    assert (getattr(kept.result, name) != OTHERS[name], kept.left) == (True, False)
    assert not has_ended(ended, open_again(ended)[1], judged=False)


def test_a_run_whose_result_cannot_be_written_does_not_go_on(broken: Path, tmp_path: Path) -> None:
    copy = Path(shutil.copytree(broken, tmp_path / "copy"))
    (copy / RESULT).mkdir()
    folder, newest, _ = open_again(copy)
    with pytest.raises(InvalidInput, match=r"^.*result\.json cannot be written: it is a folder$"):
        Runner(newest, observers=lambda r: [folder.watch(r, newest, again=True)])
    assert (copy / EVENTS).read_bytes() == (broken / EVENTS).read_bytes()


@pytest.mark.parametrize("written", [None, b"hello"])
def test_a_run_whose_result_is_lost_is_not_over(ended: Path, written: bytes | None) -> None:
    (ended / RESULT).unlink()
    if written is not None:
        (ended / RESULT).write_bytes(written)
    assert not has_ended(ended, open_again(ended)[1], judged=False)


def test_a_line_that_is_just_being_written_is_left_out(broken: Path) -> None:
    whole = kept_run(broken)
    with (broken / EVENTS).open("ab") as file:
        file.write(b'{"event":"StepFi')
    assert kept_run(broken) == whole


def test_seconds_that_cannot_be_read_are_left_out_by_name(broken: Path) -> None:
    (broken / HOST).write_bytes(b"{")
    kept = kept_run(broken)
    assert [fault.partition(":")[0] for fault in kept.faults] == [f"{broken / HOST} is not a timing record"]
    assert kept.result.timing.run_wall_s == HostSeconds().run_wall_s


Damage = Callable[[Path], object]
DAMAGE: dict[str, tuple[str, Damage]] = {
    "no files": ("cannot be shown: its plan.json is missing", lambda run: [(run / n).unlink() for n in (EVENTS, PLAN)]),
    "no events": ("has not begun", lambda run: (run / EVENTS).unlink()),
    "empty events": ("has not begun", lambda run: (run / EVENTS).write_bytes(b"")),
    "no plan": ("there is no such file", lambda run: (run / PLAN).unlink()),
    "another plan": ("is not the plan of this run", lambda run: (run / PLAN).write_bytes(
        (run / PLAN).read_bytes().replace(b"ADD A ", b"ADD B "))),
    "a damaged plan": ("is not sound", lambda run: (run / PLAN).write_bytes(b"[")),
    "other events": ("is not an event", lambda run: (run / EVENTS).write_bytes(b"{}\n")),
    "deep events": ("is not an event", lambda run: (run / EVENTS).write_bytes(b"[" * 90_000 + b"\n")),
    "no start": ("does not begin with the start of a run", lambda run: (run / EVENTS).write_bytes(
        (run / EVENTS).read_bytes().partition(b"\n")[2])),
    "other stages": ("stages that are not in the plan next to it", lambda run: (run / EVENTS).write_bytes(
        (run / EVENTS).read_bytes().replace(b'"stage":"count"', b'"stage":"moon"'))),
    "a damaged result": ("is not the result of a run", lambda run: (run / RESULT).write_bytes(b"{}")),
    "no result at all": ("is not the result of a run", lambda run: (run / RESULT).write_bytes(b"[" * 90_000)),
    "a stage of no status": ("Invalid enum value 'lost'", lambda run: (run / RESULT).write_bytes(
        re.sub(rb'"status": "[a-z ]+"', b'"status": "lost"', to_json(kept_run(run).result)))),
    "a folder": ("is a directory, not a file", lambda run: (run / RESULT).mkdir()),
}  # fmt: skip


@pytest.mark.parametrize("damage", DAMAGE)
def test_a_folder_that_tells_nothing_is_refused_with_one_sentence(broken: Path, damage: str) -> None:
    said, harm = DAMAGE[damage]
    harm(broken)
    with pytest.raises(InvalidInput, match=rf"^[^\n]*{said}[^\n]*$"):
        kept_run(broken)


def test_a_finding_that_is_not_finite_is_shown_and_its_run_is_over(ended: Path) -> None:
    words = {"subject": "gap", "relation": "at most", "unit": "mm", "sentence": "gap"}
    found = {"gap": Check(ok=False, value=nan, limit=inf, **words)}
    result = msgspec.structs.replace(kept_run(ended).result, assembled=False, referee=found)
    (ended / RESULT).write_bytes(to_json(result))
    kept = kept_run(ended).result.referee["gap"]
    assert (kept.ok, isnan(kept.value), isnan(kept.limit)) == (False, True, True)
    assert has_ended(ended, open_again(ended)[1], judged=True)
