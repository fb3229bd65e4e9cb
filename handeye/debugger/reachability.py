"""Stop conditions that a run can still meet."""

from handeye.program.graph import reachable
from handeye.runs.snapshot import Checkpoint
from handeye.runs.stops import AnyStop, AtStage, AtSteps
from handeye.runs.system import Listing
from handeye.runs.systems import listing_of


def is_ahead(stop: AnyStop, start: Checkpoint) -> bool:
    """True if a task of a run that begins at `start` can reach a place to stop at; an error may always occur."""
    listing = listing_of(start.setup)
    wanted = _steps(stop, listing)
    if wanted is None:
        return True
    places = [0] if start.snapshot is None else [place.step for place in start.snapshot.state.places]
    return any(not wanted.isdisjoint(_ahead(listing, step)) for step in places)


def _ahead(listing: Listing, first: int) -> set[int]:
    """The steps that can follow one."""
    ways = [step.ways for step in listing.steps]
    return reachable(ways[first], ways)


def _steps(stop: AnyStop, listing: Listing) -> frozenset[int] | None:
    """The steps before which a condition stops; None: it is no place."""
    match stop:
        case AtSteps():
            return frozenset(stop.steps)
        case AtStage():
            return frozenset(i for i, step in enumerate(listing.steps) if step.stage == stop.stage)
    return None
