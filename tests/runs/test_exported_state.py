"""What cannot be exported is refused in one sentence: a run without a cell, a task without a scene for others."""

from pathlib import Path

import pytest
from block_task import BLOCK
from toy_system import begin_toy

from handeye.core.errors import InvalidInput
from handeye.core.variation import WorldSpec
from handeye.results.export import scene_files
from handeye.runs.advance import advance
from handeye.runs.exported_state import ExportedState, kept_state
from handeye.runs.folder import open_new
from handeye.runs.runner import Runner


def test_a_run_of_a_system_without_a_cell_has_nothing_to_show(tmp_path: Path) -> None:
    start = begin_toy()
    folder = open_new(tmp_path / "run", start)
    runner = Runner(start, observers=lambda runner: [folder.watch(runner, start, again=False)])
    advance(runner, steps=4)
    folder.close()
    with pytest.raises(InvalidInput, match=r"run has no work cell$"):
        kept_state(tmp_path / "run")


def test_a_task_that_exports_no_scene_says_so() -> None:
    world = WorldSpec(seed=0)
    truth = BLOCK.cell(world, "ray").truth
    with pytest.raises(InvalidInput, match=r"^the task `block` exports no scene$"):
        scene_files(ExportedState(task="block", world=world, moment="drawn", truth=truth))
