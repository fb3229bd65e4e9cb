"""Puts the corrections, guarded motions and searches of two runs side by side."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Literal

import numpy as np
from msgspec.structs import replace

from handeye.comparison.pairing import CarriedOut, Place, Turn, TwoRuns, side_by_side
from handeye.core.record import Record
from handeye.program.diagnosis.causes import PlacesTried
from handeye.program.events import AnyEvent, ErrorRaised, GuardTripped, PartSeen, Saved, SearchAdvanced
from handeye.program.guards import GuardKind
from handeye.trace.account import ASTRAY


class Correction(Record, frozen=True, kw_only=True):
    """A correction of positions during a run: a saved difference, or a part that vision located."""

    place: Place
    kind: Literal["saved", "seen"]
    name: str
    at: tuple[float, ...]  # x, y and z of a difference, or x and y of a part; in m
    yaw: float | None = None  # Angle of a part, in rad; None for a difference, and for a general look


class Corrections(Record, frozen=True, kw_only=True):
    """The same correction in two runs. For a run that did not make the correction, the value is None."""

    a: Correction | None
    b: Correction | None

    @property
    def apart(self) -> float | None:
        """Distance between the two corrections (m), or None if one of the corrections is missing."""
        if self.a is None or self.b is None or len(self.a.at) != len(self.b.at):
            return None
        return float(np.linalg.norm(np.subtract(self.b.at, self.a.at)))

    @property
    def alike(self) -> bool:
        """True if the two corrections differ too little to be reported, or if they cannot be compared because one is
        missing.
        """
        return self.apart is None or self.apart <= ASTRAY


def corrections(runs: TwoRuns) -> tuple[Corrections, ...]:
    """Return the corrections of two runs, in the order of the script."""
    both = ({each.turn: found for each in steps for found in _found(each)} for steps in runs.carried_out)
    return tuple(Corrections(a=a, b=b) for a, b in side_by_side(*both))


def _found(each: CarriedOut) -> Iterator[Correction]:
    for event in each.done.events:
        if isinstance(event, Saved):
            yield Correction(place=each.place, kind="saved", name=event.name, at=event.difference)
        elif isinstance(event, PartSeen):
            at = event.x, event.y
            yield Correction(place=each.place, kind="seen", name=event.part, at=at, yaw=event.yaw)


class Stop(Record, frozen=True, kw_only=True):
    """The end of a guarded motion: the guard that tripped, and the value that it sensed."""

    place: Place
    guard: GuardKind | None  # The guard that ended the motion; None if no guard did
    value: float | None = None  # The value that it sensed, in N or N m; or the finger switches, as a mask


class Stops(Record, frozen=True, kw_only=True):
    """The same guarded motion in two runs. If a run did not reach the motion, its stop is None."""

    a: Stop | None
    b: Stop | None

    @property
    def alike(self) -> bool:
        """True if the same guard ended both motions, if no guard ended either motion, or if only one run reached the
        motion."""
        return len({side.guard for side in (self.a, self.b) if side is not None}) == 1


def stops(runs: TwoRuns) -> tuple[Stops, ...]:
    """Return the guarded motions of two runs, in the order of the script."""
    both = ({each.turn: _stop(each) for each in steps if each.step.guarded} for steps in runs.carried_out)
    return tuple(Stops(a=a, b=b) for a, b in side_by_side(*both))


def _stop(each: CarriedOut) -> Stop:
    for event in each.done.events:
        if isinstance(event, GuardTripped):
            return Stop(place=each.place, guard=event.guard, value=event.value)
    return Stop(place=each.place, guard=None)


class Search(Record, frozen=True, kw_only=True):
    """A search of a run."""

    place: Place  # The step that set up the search
    places: int = 1
    last: tuple[float, float] = (0.0, 0.0)  # The last place: x and y relative to the first place, in m
    exhausted: bool = False


class Searches(Record, frozen=True, kw_only=True):
    """The same search in two runs. If a run did not reach the search, its search is None."""

    a: Search | None
    b: Search | None

    @property
    def alike(self) -> bool:
        """True if both searches tried the same number of places, or if only one run reached the search."""
        sides = self.a, self.b
        return len({(side.places, side.exhausted) for side in sides if side is not None}) == 1


def searches(runs: TwoRuns) -> tuple[Searches, ...]:
    """Return the searches of two runs, in the order of the script."""
    both = (_searches(steps) for steps in runs.carried_out)
    return tuple(Searches(a=a, b=b) for a, b in side_by_side(*both))


def _searches(steps: Sequence[CarriedOut]) -> Mapping[Turn, Search]:
    """Return the searches of a run. The key of a search is the execution of the step that started it."""
    found: dict[Turn, Search] = {}
    turn: Turn | None = None
    for each in steps:
        if each.step.begins_search:
            turn = each.turn
            found[turn] = Search(place=each.place)
        elif turn is not None:
            for event in each.done.events:
                found[turn] = _gone_on(found[turn], event)
    return found


def _gone_on(search: Search, event: AnyEvent) -> Search:
    """Return the search, updated by an event."""
    match event:
        case SearchAdvanced():
            return replace(search, places=event.count + 1, last=event.offset)
        case ErrorRaised(cause=PlacesTried()):
            return replace(search, exhausted=True)
    return search
