"""The force guard of every undo: what the hand feels since the undo began, whatever its direction."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.core.pose import Array
from handeye.program.guards import GuardKind
from handeye.touch.guards import ActiveGuard, Reading, Trip

ALLOWED: Final = 20.0
"""N. Measured: lifting a top off the pins is felt as 11 N at most, with a screw left in it as 36 and then 108 N."""
SHARE: Final = 1.5
"""Of the force that the step itself met."""


def allowed(met: float) -> float:
    """The force that an undo may meet, N, by what the step itself met."""
    return max(ALLOWED, SHARE * met)


@dataclass(frozen=True, slots=True, kw_only=True)
class Resistance:
    """Trips when the hand feels more than a force, N."""

    limit: float

    def active(self, direction: Array) -> tuple[ActiveGuard, ...]:
        """Its guard."""
        return (ActiveGuard(guard=GuardKind.FORCE, limit=self.limit),)

    def check(self, reading: Reading) -> Trip | None:
        """The trip, or None."""
        felt = float(np.linalg.norm(reading.force))
        return Trip(guard=GuardKind.FORCE, value=felt, limit=self.limit) if felt > self.limit else None
