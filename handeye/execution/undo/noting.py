"""Noting what a step leaves for undoing it."""

from dataclasses import dataclass

from handeye.execution.context import ExecutionContext
from handeye.execution.undo.done import Done
from handeye.execution.undo.memory import changed, memory
from handeye.execution.undo.way import packed


@dataclass(frozen=True, slots=True, kw_only=True)
class Before:
    """How a step finds what it changes."""

    gap: float
    fingers: float
    grasping: bool
    load: float
    tool: float
    memory: dict[str, bytes]


def before(run: ExecutionContext) -> Before:
    """Begin to note; to be called before a step."""
    state, drive = run.state, run.drive.state
    run.drive.track.begin(drive.q, drive.gap)
    return Before(
        gap=round(run.drive.sensed.gap, 6),
        fingers=drive.gap,
        grasping=state.grasping,
        load=drive.load,
        tool=drive.tool,
        memory=memory(state),
    )


def noted(run: ExecutionContext, found: Before, *, step: int, enters: bool) -> Done:
    """What a step leaves that was just done.

    Args:
        enters: its stage began with it.
    """
    drive, state = run.drive, run.state
    way = drive.track.way(drive.state.q, drive.state.gap)
    operation = run.plan.program.steps[step].operation
    guards = run.watching(operation.guards) if state.pending is None else ()
    return Done(
        step=step,
        way=b"" if way is None else packed(way),
        gap=(found.gap, round(drive.sensed.gap, 6)),
        fingers=found.fingers,
        grasping=found.grasping,
        load=found.load,
        tool=found.tool,
        force=round(drive.track.force, 3),
        ended=guards[0].kind if guards else None,
        remembered=changed(found.memory, memory(state)),
        enters=enters,
    )
