"""The state of a work cell for export to other programs, either the initial state of a world or the state of a
run."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from handeye.cell.truth import Truth
from handeye.core.diagnostics import quoted
from handeye.core.errors import BadFile, Refused
from handeye.core.variation import WorldSpec
from handeye.runs.checkpoint_file import read_checkpoint
from handeye.runs.folder import open_again
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.runs.systems import listing_of
from handeye.tasks import DEFAULT, any_task
from handeye.tasks.interface import Task

MomentKind = Literal["drawn", "final", "unfinished"]  # before the plan, after its end, or in between


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportedState:
    """The state of a cell at one moment, with the facts that describe this moment."""

    task: str
    world: WorldSpec
    moment: MomentKind
    truth: Truth
    program: str | None = None
    steps: int = 0  # steps done
    stage: str | None = None  # the present or next stage


def initial_state(world: WorldSpec, name: str = DEFAULT) -> ExportedState:
    """Return the initial state of a world of the task called `name`, with the cell switched on."""
    return ExportedState(task=name, world=world, moment="drawn", truth=_task(name).cell(world, "ray").truth)


def kept_state(path: Path) -> tuple[ExportedState, list[str]]:
    """Return the state in a checkpoint file, or in the newest valid checkpoint of a run's folder. Also returns
    a sentence for each unreadable checkpoint.
    """
    if not path.is_dir():
        return _exhibit(path, read_checkpoint(path)), []
    _, checkpoint, faults = open_again(path)
    return _exhibit(path, checkpoint), faults


def present_state(runner: Runner) -> ExportedState:
    """Return the present state of a run. Raises Refused if the run's system has no cell."""
    if runner.system.cell is None:
        raise Refused("the run has no work cell")
    return _shown(runner.checkpoint(), runner.cell.truth)


def _exhibit(path: Path, checkpoint: Checkpoint) -> ExportedState:
    setup, snapshot = checkpoint.setup, checkpoint.snapshot
    if snapshot is None:
        raise BadFile(f"the run in {path} has not begun")
    if snapshot.cell is None:
        raise Refused(f"the run in {path} has no work cell")
    cell = _task(setup.task).cell(setup.world, "ray")
    cell.restore(snapshot.cell)
    return _shown(checkpoint, cell.truth)


def _task(name: str) -> Task:
    """Return the task called `name`. Raises Refused if the cells of the task's system cannot be exported."""
    found = any_task(name)
    if not isinstance(found, Task):
        raise Refused(f"the task {quoted(name)} exports no scene")
    return found


def _shown(checkpoint: Checkpoint, truth: Truth) -> ExportedState:
    setup = checkpoint.setup
    return ExportedState(
        task=setup.task,
        world=setup.world,
        moment="final" if checkpoint.ended else "unfinished",
        truth=truth,
        program=listing_of(setup).name,
        steps=checkpoint.position,
        stage=checkpoint.stage,
    )
