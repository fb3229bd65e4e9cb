"""A recorded run is carried out again and compared."""

from pathlib import Path

import pytest
from short_runs import begin

from handeye.runs.advance import advance
from handeye.runs.folder import open_new
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.runs.verify import difference
from handeye.trace.reading import Trace, read_trace

pytestmark = pytest.mark.slow


def recorded(path: Path, *, secretly: bool, start: Checkpoint | None = None) -> Trace:
    """The trace of a run, in which somebody may have changed something without a word."""
    start = start or begin()
    folder = open_new(path, start)
    runner = Runner(start, observers=lambda runner: [folder.watch(runner, start, again=False)])
    advance(runner, steps=5)
    if secretly:
        runner.context.drive.state.load = 0.5
    advance(runner)
    runner.finish()
    folder.close()
    return read_trace(path / "trace.mcap")


def test_a_run_that_nobody_touched_comes_out_the_same(tmp_path: Path) -> None:
    assert difference(recorded(tmp_path / "run", secretly=False), tmp_path / "again") is None


def test_a_run_that_was_tampered_with_does_not_and_it_says_where(tmp_path: Path) -> None:
    found = difference(recorded(tmp_path / "run", secretly=True), tmp_path / "again")
    assert found is not None
    assert "CHANGE  [0 0 1] 1.5" in found


@pytest.fixture(scope="module")
def half_way() -> Checkpoint:
    runner = Runner(begin())
    advance(runner, steps=3)
    return runner.checkpoint()


def test_a_run_that_was_taken_up_at_a_checkpoint_comes_out_the_same_from_there(
    tmp_path: Path, half_way: Checkpoint
) -> None:
    trace = recorded(tmp_path / "run", secretly=False, start=half_way)
    assert trace.unseen == len(half_way.events)
    assert difference(trace, tmp_path / "again") is None


def test_what_was_tampered_with_behind_the_checkpoint_is_found(tmp_path: Path, half_way: Checkpoint) -> None:
    found = difference(recorded(tmp_path / "run", secretly=True, start=half_way), tmp_path / "again")
    assert found is not None
