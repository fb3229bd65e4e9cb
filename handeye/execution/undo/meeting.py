"""The finger guard of an undo: fingers that close on their way back meet nothing before they are where they were.

Fingers close on the middle of the hand. A thing that lies beside it is met by one finger first, while the gap is still
wider than the thing. Closed on, it is pushed to the middle, or pushes the arm, and the gap is right at the end.
"""

from collections.abc import Callable
from dataclasses import dataclass

from handeye.core.pose import Array
from handeye.program.causes import MetEarly
from handeye.program.guards import GuardKind
from handeye.touch.guards import ActiveGuard, Reading, Trip
from handeye.touch.hold import too_early


@dataclass(frozen=True, slots=True, kw_only=True)
class Meeting:
    """Trips when a finger touches something too early."""

    gap: Callable[[], float]
    """Between the fingers now, m."""
    kept: float
    """As it was when the step was executed, m."""
    holding: bool
    """They held something then."""

    def active(self, direction: Array) -> tuple[ActiveGuard, ...]:
        """Its guard."""
        return (ActiveGuard(guard=GuardKind.TOUCH, limit=3.0),)

    def check(self, reading: Reading) -> Trip | None:
        """The trip, or None; its value is the mask of all fingers that touch."""
        if not any(reading.touch) or not too_early(self.gap(), self.kept):
            return None
        first, second = reading.touch
        return Trip(guard=GuardKind.TOUCH, value=float(first + 2 * second), limit=3.0)

    def cause(self, trip: Trip) -> MetEarly:
        """What a trip tells while the fingers stand where it has stopped them."""
        closed = int(trip.value)
        fingers = bool(closed & 1), bool(closed & 2)
        return MetEarly(fingers=fingers, gap=round(self.gap(), 6), kept=self.kept, holding=self.holding)
