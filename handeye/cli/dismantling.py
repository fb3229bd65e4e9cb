"""The command that makes the arm undo its work: dismantle."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

from cyclopts import Parameter

from handeye.cli.common import Details, Json, Out, Overwrite, TaskWords, note
from handeye.cli.programs import check_task, made_known
from handeye.cli.trace_files import RunOrCheckpoint, run_or_newest
from handeye.core.errors import CannotWrite, InvalidInput
from handeye.core.plain_text import counted

if TYPE_CHECKING:
    from handeye.runs.snapshot import Checkpoint

COUNT: Final = 20


def dismantle(
    run: RunOrCheckpoint = None,
    /,
    *,
    task: TaskWords = None,
    to: Annotated[str | None, Parameter(help="Go back only to the beginning of this stage.")] = None,
    json: Json = False,
    details: Details = False,
    out: Out = None,
    overwrite: Overwrite = False,
) -> int:
    """Make the arm undo the steps of a run: take the pump apart again.

    The arm undoes every step, from the last to the first, by moving back along its own path. If the hand meets
    more force than expected, or no longer holds the part that it held when the step was executed, the arm brakes
    and the program calls the operator. The folder of the run does not change.

    Exit code 0: every part is back where it was before the run or, with --to, all steps since the beginning of the
    given stage are undone; 1: the arm was stopped and the program called the operator; 3: the program reported every
    step undone, but the referee disagrees; 2: bad input; 130: interrupted.
    """
    from handeye.cli.job import Job, work
    from handeye.debugger.breakpoints import stage_number
    from handeye.runs.folder import CHECKPOINTS
    from handeye.runs.systems import listing_of
    from handeye.runs.undo_orders import to_be_undone

    path = run_or_newest(run)
    whole = path.parent.parent if path.parent.name == CHECKPOINTS else path
    if out is not None and whole.is_dir() and whole.resolve() in (out.resolve(), *out.resolve().parents):
        raise CannotWrite(
            f"--out {out} is in the folder of the run {path}, but the folder of a run must not change; choose "
            "another folder"
        )
    wanted = made_known(task)
    kept = _newest(path)
    check_task(wanted, kept.setup.task, path)
    stage = None if to is None else stage_number(to, listing_of(kept.setup))
    start = to_be_undone(kept, str(path), stage)
    return work(
        Job(
            start=start,
            out=out,
            overwrite=overwrite,
            json=json,
            details=details,
            referee=True,
            on_stop="abort",
        )
    )


def _newest(path: Path) -> "Checkpoint":
    """The checkpoint in a file, or the final state of the run in a folder. Raises InvalidInput if the path holds
    neither.
    """
    from handeye.runs.checkpoint_file import read_checkpoint
    from handeye.runs.folder import EVENTS, open_again
    from handeye.runs.undo_orders import caught_up, done_since
    from handeye.trace.eventlist import effective, read_events

    if not path.is_dir():
        return read_checkpoint(path)
    _, start, faults = open_again(path)
    for fault in faults:
        note(f"left out: {fault}")
    try:
        events = effective(read_events(path / EVENTS, growing=True))
    except InvalidInput as fault:
        note(f"left out: {fault}")
        return start
    more = done_since(start, events)
    if more is None:
        note(
            f"left out: {path / EVENTS}; these events and the checkpoints in {path} belong to different runs"
        )
    elif more:
        note(f"repeating {counted(more, 'step')} that came after the last checkpoint in {path}")
    return caught_up(start, events, str(path))
