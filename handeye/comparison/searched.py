"""How two runs searched: the places that each tried, search beside search."""

from collections.abc import Mapping, Sequence

from msgspec.structs import replace

from handeye.comparison.pairing import CarriedOut, Turn, TwoRuns, side_by_side
from handeye.comparison.place import Place
from handeye.core.record import Record
from handeye.program.diagnosis.causes import PlacesTried
from handeye.program.events import AnyEvent, ErrorRaised, SearchAdvanced


class Search(Record, frozen=True, kw_only=True):
    """A search of a run."""

    place: Place
    """The step that set it up."""
    places: int = 1
    """How many it tried."""
    last: tuple[float, float] = (0.0, 0.0)
    """The last of them, x and y from the first, m."""
    exhausted: bool = False
    """It ran out of places."""


class Searches(Record, frozen=True, kw_only=True):
    """The same search in two runs; None: it did not come to it."""

    a: Search | None
    b: Search | None

    @property
    def alike(self) -> bool:
        """Both tried as many places; or only one came to it."""
        sides = self.a, self.b
        return len({(side.places, side.exhausted) for side in sides if side is not None}) == 1


def searches(runs: TwoRuns) -> tuple[Searches, ...]:
    """The searches of two runs, in the order of the script."""
    both = (_searches(steps) for steps in runs.carried_out)
    return tuple(Searches(a=a, b=b) for a, b in side_by_side(*both))


def _searches(steps: Sequence[CarriedOut]) -> Mapping[Turn, Search]:
    """The searches of a run, by the turns of the steps that set them up."""
    found: dict[Turn, Search] = {}
    turn: Turn | None = None
    for each in steps:
        if any(use.kind == "search" for use in each.step.operation.writes):
            turn = each.turn
            found[turn] = Search(place=each.place)
        elif turn is not None:
            for event in each.done.events:
                found[turn] = _gone_on(found[turn], event)
    return found


def _gone_on(search: Search, event: AnyEvent) -> Search:
    """A search after an event."""
    match event:
        case SearchAdvanced():
            return replace(search, places=event.count + 1, last=event.offset)
        case ErrorRaised(cause=PlacesTried()):
            return replace(search, exhausted=True)
    return search
