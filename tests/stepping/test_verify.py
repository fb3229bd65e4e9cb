"""A recorded run is carried out again and compared."""

from pathlib import Path

import pytest
from short_runs import begin

from handeye.stepping.advance import advance
from handeye.stepping.folder import open_new
from handeye.stepping.runner import Runner
from handeye.stepping.verify import difference
from handeye.trace.reading import Trace, read_trace

pytestmark = pytest.mark.slow


def recorded(path: Path, *, secretly: bool) -> Trace:
    """The trace of a run, in which somebody may have changed something without a word."""
    start = begin()
    folder = open_new(path, start)
    runner = Runner(start, observers=lambda runner: [folder.watch(runner, start, again=False)])
    advance(runner, steps=5)
    if secretly:
        runner.run.drive.load = 0.5
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
