"""Executes fault-free runs, one per world, and stores closely spaced checkpoints of each run. Trials start from
these checkpoints."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Final

import msgspec

from handeye.core.errors import Refused
from handeye.core.faults import Fault
from handeye.core.files import write_whole
from handeye.core.plain_text import counted
from handeye.core.variation import WorldSpec
from handeye.program.events import RunStarted
from handeye.runs.checkpoint_store import CheckpointStore
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.runs.systems import listing_of
from handeye.tasks import task
from handeye.trials.workers import in_processes

EVERY: Final = 3  # Steps from one checkpoint to the next
NEAR_END: Final = 36  # If a program has only one stage, no schedule begins within this many steps of its end
_WHOLE: Final = "whole"  # A file that says that the run reached its end


@dataclass(frozen=True, slots=True, kw_only=True)
class SoundRun:
    """A run without faults, with its stored states."""

    world: WorldSpec
    store: CheckpointStore
    starts: tuple[int, ...]  # Numbers of steps done at which a schedule can begin
    stages: tuple[int, ...]  # Stage, numbered from 1, in which each of these lies

    def at(self, position: int) -> Checkpoint:
        """Return the last stored state that the run reached after at most `position` steps. Raises InvalidInput if
        there is no such state.
        """
        found = self.store.at_or_before(position)
        if found is None or found.snapshot is None:
            raise Refused(
                f"a schedule cannot begin after {counted(position, 'step')}: no state of the run was stored by then"
            )
        return found

    def before(self, stage: int) -> Checkpoint:
        """Return the stored state before the first step of a stage. The first stage has the number 1. Raises
        InvalidInput if there is no such state.
        """
        begun = [start for start, number in zip(self.starts, self.stages, strict=True) if number == stage]
        if not begun:
            raise Refused(f"the program has no stage {stage}")
        return self.at(begun[0])


def sound_runs(
    of: Setup, folder: Path, worlds: Sequence[WorldSpec], jobs: int, every: int | None = EVERY
) -> Iterator[SoundRun]:
    """Yield the fault-free runs of the given worlds, in the order in which they are ready. Runs that the folder does
    not contain yet are executed now. For `every` see `sound_run`.
    """
    yield from in_processes(partial(sound_run, folder, of, every=every), worlds, jobs)


def sound_run(folder: Path, of: Setup, world: WorldSpec, every: int | None = EVERY) -> SoundRun:
    """Return the fault-free run of a world. If the folder does not contain this run, the run is executed now. Raises
    InvalidInput if the folder belongs to another setup.

    Args:
        every: steps from one checkpoint to the next. The state between two stages is always stored; if `every` is
            None, no other states are stored.
    """
    store = CheckpointStore(folder / f"{world.seed}-{world.level}")
    setup = msgspec.structs.replace(of, world=world)
    store.check(setup)
    if not (store.folder / _WHOLE).exists():
        store.folder.mkdir(parents=True, exist_ok=True)
        runner = Runner(Checkpoint(setup=setup))
        while not runner.ended:
            if runner.between_stages or (every is not None and runner.position % every == 0):
                store.save(runner.checkpoint())
            runner.step()
        write_whole(store.folder / _WHOLE, b"")
    begun = sorted(_begun(store, listing_of(setup).stages))
    return SoundRun(
        world=world,
        store=store,
        starts=tuple(position for position, _ in begun),
        stages=tuple(number for _, number in begun),
    )


def _begun(store: CheckpointStore, stages: Sequence[str]) -> Iterator[tuple[int, int]]:
    """Yield the points of the run at which a schedule can begin. Each point is given by the number of steps done
    before it, and by the number of its stage.

    If the program has only one stage, no schedule begins near the end of the program, because a resumed run may have
    to undo the work of the stage.
    """
    heads = [head for _, head in store.heads()]
    last = max(head.position for head in heads) - (NEAR_END if len(stages) < 2 else 0)
    for head in heads:
        if head.stage in stages and head.position <= last:
            yield head.position, stages.index(head.stage) + 1


def with_faults(start: Checkpoint, faults: Sequence[Fault]) -> Checkpoint:
    """Add faults to the world of a fault-free run. The faults begin after the state in `start`. Raises InvalidInput if
    the faults are impossible.
    """
    if not faults:
        return start
    snapshot, world = start.snapshot, msgspec.structs.replace(start.setup.world, faults=tuple(faults))
    assert snapshot is not None
    assert snapshot.cell is not None
    fresh = task(start.setup.task).cell(world, "ray").capture()
    cell = msgspec.structs.replace(
        snapshot.cell,
        mechanisms={**fresh.mechanisms, **snapshot.cell.mechanisms},
        figures={**fresh.figures, **snapshot.cell.figures},
    )
    return Checkpoint(
        setup=msgspec.structs.replace(start.setup, world=world),
        snapshot=msgspec.structs.replace(snapshot, cell=cell),
        events=tuple(
            msgspec.structs.replace(event, world=world) if isinstance(event, RunStarted) else event
            for event in start.events
        ),
    )
