"""Orders the arm to undo the work of a stored run: determines how many steps to undo, and the checkpoint at which the
arm begins to undo them.
"""

from collections.abc import Sequence

from msgspec.structs import replace

from handeye.core.diagnostics import quoted
from handeye.core.entries import require
from handeye.core.errors import Refused
from handeye.core.mutable_records import copied
from handeye.execution.state import ReversalOrder
from handeye.program.events import AnyEvent, StepFinished, StepStarted, UndoEnded, UndoOrdered
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.runs.system import ExecutedStep, Listing
from handeye.runs.systems import listing_of, system_of


def stage_began(executed: Sequence[ExecutedStep], listing: Listing, stage: int) -> int:
    """Return the number of steps that had been executed when the stage with this index last began. Raises
    Refused if none of the stage's steps are left to undo.
    """
    steps = listing.steps
    found = [n for n, done in enumerate(executed) if done.enters and steps[done.step].stage == stage]
    if not found:
        raise Refused(f"the stage {quoted(listing.stages[stage])} has nothing to undo")
    return found[-1]


def to_be_undone(checkpoint: Checkpoint, name: str, stage: int | None = None) -> Checkpoint:
    """Add an order to a checkpoint: the arm undoes steps of the run, and then the run ends. The arm undoes the steps
    since the beginning of stage `stage`, or all steps if `stage` is None. Messages call the run `name`.
    """
    require(checkpoint.setup.system, "undo", name)
    snapshot, kind, plan = checkpoint.snapshot, system_of(checkpoint.setup), checkpoint.setup.plan
    if snapshot is None:
        raise Refused(f"{name} has not run any program: there is nothing to undo")
    state = copied(snapshot.state)
    executed = kind.executed(plan, state)
    _check_whole(checkpoint, executed, name)
    undoing = ReversalOrder(
        left=0 if stage is None else stage_began(executed, listing_of(checkpoint.setup), stage), halts=True
    )
    kind.order(plan, state, undoing)
    time = checkpoint.events[-1].time
    events = (*checkpoint.events, UndoOrdered(time=time, left=undoing.left, halts=True))
    setup = replace(checkpoint.setup, judged=True)
    return replace(
        checkpoint, setup=setup, snapshot=replace(snapshot, state=state, happened=len(events)), events=events
    )


def _check_whole(checkpoint: Checkpoint, done: Sequence[ExecutedStep], name: str) -> None:
    """Raise Refused if the arm cannot undo the whole run: the run has no steps, is already undone, or has no record of
    how to undo its first steps.
    """
    first = next((event for event in checkpoint.events if isinstance(event, StepStarted)), None)
    if first is None:
        raise Refused(f"{name} has no steps: there is nothing to undo")
    if not done and any(isinstance(event, UndoEnded) for event in checkpoint.events):
        raise Refused(f"{name} is already undone")
    if not done or done[0].step != first.step:
        raise Refused(f"{name} has no record of how to undo its first steps")


def done_since(checkpoint: Checkpoint, events: Sequence[AnyEvent]) -> int | None:
    """Count the steps that a run finished after a checkpoint. `events` are all events of the run. Returns None if the
    events belong to another run than the checkpoint.
    """
    begun = len(checkpoint.events)
    if tuple(events[:begun]) != checkpoint.events:
        return None
    return sum(isinstance(event, StepFinished) for event in events[begun:])


def caught_up(checkpoint: Checkpoint, events: Sequence[AnyEvent], name: str) -> Checkpoint:
    """Repeat the steps since the checkpoint, and return a checkpoint of the run after its last finished step.

    A repeated run takes the same course, byte for byte. Raises BadFile if the repeated run takes a different course.
    """
    if not done_since(checkpoint, events):
        return checkpoint
    last = max(number for number, event in enumerate(events) if isinstance(event, StepFinished))
    happened = events[: last + 1]
    runner = Runner(checkpoint)
    runner.repeat(happened)
    if runner.events[: len(happened)] != list(happened):
        raise Refused(
            f"the steps of {name} after its newest checkpoint give a different result when they are repeated here; "
            f"`handeye resume {name}` continues from the newest checkpoint"
        )
    return runner.checkpoint()
