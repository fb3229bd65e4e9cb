"""The command that has the arm undo what it did: dismantle."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import App, Parameter

from handeye.cli.common import Json, Out, note
from handeye.cli.runs import Overwrite

if TYPE_CHECKING:
    from handeye.runs.snapshot import Checkpoint


def register(app: App) -> None:
    """Add the command to the command line."""
    app.command(dismantle)


def dismantle(
    path: Path,
    /,
    *,
    to: Annotated[
        str | None, Parameter(help="Go back to the beginning of this stage, and no farther.")
    ] = None,
    json: Json = False,
    out: Out = None,
    overwrite: Overwrite = False,
) -> int:
    """Have the arm undo what it did in a run: take the pump apart again.

    Every step is undone by the arm, the last one first: by the way it has gone, with what the hand holds, under
    guards. Where the hand meets more force than it should, or holds something else than then, the brakes are set and
    the operator is called. The folder of the run stays as it is.

    Exit code 0: everything is back where the run found it, or undone as far as was asked for; 1: a guard
    stopped it; 3: it is undone, and the referee disagrees; 2: bad input; 130: interrupted.

    Parameters
    ----------
    path
        The folder of a run, or a checkpoint of it.
    """
    from handeye.cli.job import Job, work
    from handeye.debugger.breakpoints import stage_number
    from handeye.runs.systems import listing_of
    from handeye.runs.undo_orders import to_be_undone

    kept = _newest(path)
    stage = None if to is None else stage_number(to, listing_of(kept.setup))
    start = to_be_undone(kept, str(path), stage)
    return work(Job(start=start, out=out, overwrite=overwrite, json=json, referee=True, on_stop="abort"))


def _newest(path: Path) -> "Checkpoint":
    """The checkpoint in a file, or the newest sound one of a run's folder; what is left out is told.

    Raises:
        InvalidInput: there is none.
    """
    from handeye.runs.checkpoint_file import read_checkpoint
    from handeye.runs.folder import open_again

    if not path.is_dir():
        return read_checkpoint(path)
    _, start, faults = open_again(path)
    for fault in faults:
        note(f"left out: {fault}")
    return start
