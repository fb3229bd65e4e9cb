"""The guards of every reversal: force felt in any direction since it began, and contact of closing fingers.

Fingers close on the middle of the hand. An object beside it is met by one finger first, while the gap is still too
wide. Closed on, it would be pushed to the middle, or push the arm, and the final gap would look right.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.core.pose import Array
from handeye.program.diagnosis.causes import MetEarly
from handeye.program.guards import GuardKind
from handeye.touch.guards import ActiveGuard, Reading, Trip
from handeye.touch.hold import too_early

ALLOWED: Final = 20.0
"""N. Measured: lifting a top off the pins is felt as 11 at most, with a screw left in it as 36 and then 108."""
SHARE: Final = 1.5  # of the force that the step itself met


def allowed(met: float) -> float:
    """Force that a reversal may meet, N, given what the step itself met."""
    return max(ALLOWED, SHARE * met)


@dataclass(frozen=True, slots=True, kw_only=True)
class Resistance:
    """Trips when the hand feels more than `limit`, N."""

    limit: float

    def active(self, direction: Array) -> tuple[ActiveGuard, ...]:
        return (ActiveGuard(guard=GuardKind.FORCE, limit=self.limit),)

    def check(self, reading: Reading) -> Trip | None:
        felt = float(np.linalg.norm(reading.force))
        return Trip(guard=GuardKind.FORCE, value=felt, limit=self.limit) if felt > self.limit else None


@dataclass(frozen=True, slots=True, kw_only=True)
class EarlyContact:
    """Trips when a finger touches too early."""

    gap: Callable[[], float]  # present gap, m
    kept: float  # gap when the step was executed, m
    holding: bool  # something was held then

    def active(self, direction: Array) -> tuple[ActiveGuard, ...]:
        return (ActiveGuard(guard=GuardKind.TOUCH, limit=3.0),)

    def check(self, reading: Reading) -> Trip | None:
        if not any(reading.touch) or not too_early(self.gap(), self.kept):
            return None
        first, second = reading.touch
        return Trip(guard=GuardKind.TOUCH, value=float(first + 2 * second), limit=3.0)

    def cause(self, trip: Trip) -> MetEarly:
        """The cause for a trip, while the fingers stand where it stopped them."""
        closed = int(trip.value)
        fingers = bool(closed & 1), bool(closed & 2)
        return MetEarly(fingers=fingers, gap=round(self.gap(), 6), kept=self.kept, holding=self.holding)
