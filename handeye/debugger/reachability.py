"""Stop conditions that a run can still come to."""

from handeye.program.graph import reachable
from handeye.runs.snapshot import Checkpoint
from handeye.runs.stops import AnyStop, AtStage, AtSteps
from handeye.runs.system import Listing
from handeye.runs.systems import listing_of


def is_ahead(stop: AnyStop, start: Checkpoint) -> bool:
    """A run that begins at `start` can come to a place to stop at; an error may always come."""
    listing = listing_of(start.setup)
    wanted = _steps(stop, listing)
    if wanted is None:
        return True
    at = 0 if start.snapshot is None else start.snapshot.state.at
    return at is not None and not wanted.isdisjoint(_ahead(listing, at))


def _ahead(listing: Listing, first: int) -> set[int]:
    """The steps that can come after one."""
    ways = [step.ways for step in listing.steps]
    return reachable(ways[first], ways)


def _steps(stop: AnyStop, listing: Listing) -> frozenset[int] | None:
    """The steps that a place to stop at is before; None: it is no place."""
    match stop:
        case AtSteps():
            return frozenset(stop.steps)
        case AtStage():
            return frozenset(i for i, step in enumerate(listing.steps) if step.stage == stop.stage)
    return None
