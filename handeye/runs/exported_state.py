"""A work cell at a moment that other programs are shown: a world as it is drawn, or as a kept run has left it."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from handeye.cell.truth import Truth
from handeye.core.errors import BadFile, Refused
from handeye.core.variation import WorldSpec
from handeye.runs.checkpoint_file import read_checkpoint
from handeye.runs.folder import open_again
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.runs.systems import listing_of
from handeye.tasks import DEFAULT, task

MomentKind = Literal["drawn", "final", "unfinished"]
"""Before anything happened; the plan has come to its end; it has not."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportedState:
    """A cell at a moment."""

    task: str
    world: WorldSpec
    moment: MomentKind
    truth: Truth
    program: str | None = None
    """Name of the program that was carried out."""
    steps: int = 0
    """Steps done."""
    stage: str | None = None
    """The stage under way, or the one to come."""


def initial_state(world: WorldSpec, name: str = DEFAULT) -> ExportedState:
    """A world of a task, by its name, before anything happened in it, its cell switched on.

    Raises:
        InvalidInput: it cannot be drawn here.
    """
    return ExportedState(task=name, world=world, moment="drawn", truth=task(name).cell(world, "ray").truth)


def kept_state(path: Path) -> tuple[ExportedState, list[str]]:
    """What a run has left behind, and the faults of what cannot be read of it, a sentence each.

    Args:
        path: the folder of the run, of which the newest sound checkpoint counts; or a checkpoint.

    Raises:
        InvalidInput: there is no such run, it has not begun, or its cell cannot be built here.
    """
    if not path.is_dir():
        return _exhibit(path, read_checkpoint(path)), []
    _, checkpoint, faults = open_again(path)
    return _exhibit(path, checkpoint), faults


def present_state(runner: Runner) -> ExportedState:
    """A run as it now is.

    Raises:
        InvalidInput: its system acts on no cell.
    """
    if runner.system.cell is None:
        raise Refused("the run is of a system that acts on no cell")
    return _shown(runner.checkpoint(), runner.cell.truth)


def _exhibit(path: Path, checkpoint: Checkpoint) -> ExportedState:
    setup, snapshot = checkpoint.setup, checkpoint.snapshot
    if snapshot is None:
        raise BadFile(f"the run in {path} has not begun")
    if snapshot.cell is None:
        raise Refused(f"the run in {path} is of a system that acts on no cell")
    cell = task(setup.task).cell(setup.world, "ray")
    cell.restore(snapshot.cell)
    return _shown(checkpoint, cell.truth)


def _shown(checkpoint: Checkpoint, truth: Truth) -> ExportedState:
    """The truth of a cell in the state of a checkpoint, with what is told of it."""
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
