"""Where a run begins, pauses and ends: the checkpoint it starts from, its stops and its breakpoints."""

from pathlib import Path
from typing import TYPE_CHECKING

from handeye.cli.common import note
from handeye.core.errors import BadArgument, CannotWrite

if TYPE_CHECKING:
    from handeye.runs.advance import AnyStop
    from handeye.runs.snapshot import Checkpoint
    from handeye.runs.system import Listing


def stops_of(listing: "Listing", *, to: str | None, until: str | None, breaks: list[str]) -> list["AnyStop"]:
    """The conditions at which a run ends. Breakpoints are not among these conditions. The function still parses the
    breakpoints, so that an invalid breakpoint is refused before anything moves.
    """
    from handeye.debugger.breakpoints import breakpoint, stage_number, step_number
    from handeye.runs.advance import AfterStage, BeforeStep

    for text in breaks:
        breakpoint(text, listing)
    stops: list[AnyStop] = []
    if to is not None:
        number = stage_number(to, listing)
        stops.append(AfterStage(stage=number, name=listing.stages[number]))
    if until is not None:
        stops.append(BeforeStep(steps=(step_number(until, listing),)))
    return stops


def check_order(listing: "Listing", first: str | None, last: str | None) -> None:
    """Raises InvalidInput if a run that begins with stage `first` cannot end with stage `last`."""
    from handeye.debugger.breakpoints import stage_number

    if first is None or last is None:
        return
    stages = listing.stages
    begin, end = stages[stage_number(first, listing)], stages[stage_number(last, listing)]
    if stages.index(end) < stages.index(begin):
        raise BadArgument(
            f"the run would begin with the stage “{begin}” and end with an earlier stage, “{end}”"
        )


def check_ahead(start: "Checkpoint", stops: list["AnyStop"], breaks: list[str]) -> None:
    """Print notes on breakpoints that a run cannot reach from its start. Raises Refused if the run cannot reach the
    place where it is to end.
    """
    from handeye.debugger.breakpoints import breakpoint, is_ahead
    from handeye.runs.advance import BeforeStep
    from handeye.runs.systems import listing_of

    for stop in stops:
        if isinstance(stop, BeforeStep) and not is_ahead(stop, start):
            raise BadArgument(f"the run never reaches step {stop.step} from the step at which the run begins")
    for text in breaks:
        if not is_ahead(breakpoint(text, listing_of(start.setup)), start):
            note(f"the run never reaches {text} from the step at which the run begins")


def checkpoint_folder(checkpoints: Path | None, out: Path | None) -> Path | None:
    """Return the folder to search for checkpoints: `checkpoints` itself, or, if `checkpoints` is the folder of a run,
    the folder of checkpoints in it. If `checkpoints` is None, the function takes the run in `out` instead. Returns
    None if both are None.
    """
    from handeye.runs.folder import CHECKPOINTS

    folder = checkpoints or out
    if folder is not None and (checkpoints is None or (folder / CHECKPOINTS).is_dir()):
        return folder / CHECKPOINTS
    return folder


def at_stage(start: "Checkpoint", name: str, kept: Path | None, out: Path | None) -> "Checkpoint":
    """The last checkpoint from which a run reaches a stage; `start` if there is no such checkpoint."""
    from handeye.debugger.breakpoints import stage_number
    from handeye.runs.checkpoint_store import CheckpointStore
    from handeye.runs.folder import EVENTS
    from handeye.runs.systems import listing_of

    if out is not None and (out / EVENTS).exists():
        raise CannotWrite(f"{out} holds a run; give it as --checkpoints, and another folder as --out")
    listing = listing_of(start.setup)
    number = stage_number(name, listing)
    wanted = listing.stages[number]
    found = None if kept is None else CheckpointStore(kept).for_stage(start.setup, number)
    if number > 0 and (found is None or found.stage != wanted):
        reached = "the beginning" if found is None else f"“{found.stage}”"
        note(
            f"no checkpoint of “{wanted}” for this plan and world: running the earlier steps, from {reached}"
        )
    return found or start
