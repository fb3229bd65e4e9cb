"""What two runs felt: how each guarded motion ended, motion beside motion."""

from collections.abc import Mapping, Sequence

from handeye.comparison.pairing import CarriedOut, Turn, TwoRuns, side_by_side
from handeye.comparison.place import Place
from handeye.core.record import Record
from handeye.program.events import GuardTripped
from handeye.program.guards import GuardKind


class Stop(Record, frozen=True, kw_only=True):
    """The end of a guarded motion."""

    place: Place
    guard: GuardKind | None
    """The guard that ended it; None: none did."""
    value: float | None = None
    """What the guard looked at then: N, N m, or finger switches as a mask."""


class Stops(Record, frozen=True, kw_only=True):
    """The same guarded motion in two runs; None: it did not come to it."""

    a: Stop | None
    b: Stop | None

    @property
    def alike(self) -> bool:
        """Both ended by the same guard, or by none; or only one came to it."""
        return len({side.guard for side in (self.a, self.b) if side is not None}) == 1


def stops(runs: TwoRuns) -> tuple[Stops, ...]:
    """The guarded motions of two runs, in the order of the script."""
    both = (_stops(steps) for steps in runs.carried_out)
    return tuple(Stops(a=a, b=b) for a, b in side_by_side(*both))


def _stops(steps: Sequence[CarriedOut]) -> Mapping[Turn, Stop]:
    return {each.turn: _stop(each) for each in steps if each.step.operation.guards}


def _stop(each: CarriedOut) -> Stop:
    for event in each.done.events:
        if isinstance(event, GuardTripped):
            return Stop(place=each.place, guard=event.guard, value=event.value)
    return Stop(place=each.place, guard=None)
