"""The record that a run leaves."""

import json
from pathlib import Path
from typing import Any

import pytest
from short_runs import begin

from handeye.results.finishing import finished
from handeye.runs.advance import advance
from handeye.runs.folder import RESULT, open_new
from handeye.runs.host_seconds import Meter
from handeye.runs.runner import Runner

pytestmark = pytest.mark.slow

SHORT = """
        STAGE   "open"
        OPEN    1
        STAGE   "call"
        WAIT    "HELP"
"""


def record(folder: Path, planning: float) -> dict[str, Any]:
    """Result of a short run in a folder, as it stands there, that took so long to plan."""
    start = begin(SHORT)
    keeping, meter = open_new(folder, start), Meter(planning_cpu_s=planning)
    runner = Runner(start, observers=lambda r: [keeping.watch(r, start, again=False, meter=meter)])
    finished(runner, advance(runner), meter, judged=True, folder=keeping)
    found: dict[str, Any] = json.loads((folder / RESULT).read_bytes())
    return found


def without_host(value: object) -> object:
    """A record without what is the host's, by its name."""
    if isinstance(value, list):
        return [without_host(item) for item in value]
    if not isinstance(value, dict):
        return value
    host = ("_wall_s", "_cpu_s", "real_time_factor")
    return {name: without_host(item) for name, item in value.items() if not name.endswith(host)}


def test_two_runs_of_a_seed_leave_one_record_but_for_the_seconds_of_the_host(tmp_path: Path) -> None:
    first, second = (record(tmp_path / f"{planning}", planning) for planning in (0.5, 0.75))
    assert first != second
    assert without_host(first) == without_host(second)
