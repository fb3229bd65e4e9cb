"""Guards: what ends a motion before its end."""

from dataclasses import dataclass, field
from typing import Final

import numpy as np

from handeye.pose import Array

HELD: Final = 4
"""Servo periods for which a torque has to last. Placeholder: the spindle is up to speed in less."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Reading:
    """What a guard looks at in a servo period."""

    force: Array
    """Force the hand exerts on the world, shape (3,), N, world axes."""
    direction: Array
    """Unit vector of the motion, shape (3,), or zero."""
    moment: Array = field(default_factory=lambda: np.zeros(3))
    """Moment the hand exerts about its tool centre point, shape (3,), N m, world axes."""
    touch: tuple[bool, bool] = (False, False)
    """The finger switches, as `Sensed` has them."""
    tool_torque: float = 0.0
    """Torque of the screwdriver's motor, N m."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Trip:
    """The guard that ended a motion, what it saw and what it allowed (N, N m, or finger switches as a mask)."""

    guard: str
    value: float
    limit: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ForceGuard:
    """Trips when the hand presses along a vector with more than the vector's length.

    A force to the side, or the other way, does not count.
    """

    force: Array
    """Shape (3,), N, world axes; not zero."""

    def check(self, reading: Reading) -> Trip | None:
        """The trip, or None."""
        return _along("force", reading.force, self.force)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MomentGuard:
    """Trips when the hand turns something about a vector with more than the vector's length."""

    moment: Array
    """Shape (3,), N m, world axes; not zero."""

    def check(self, reading: Reading) -> Trip | None:
        """The trip, or None."""
        return _along("moment", reading.moment, self.moment)


def _along(guard: str, felt: Array, vector: Array) -> Trip | None:
    limit = float(np.linalg.norm(vector))
    value = float(felt @ vector) / limit
    return Trip(guard=guard, value=value, limit=limit) if value > limit else None


@dataclass(frozen=True, slots=True, kw_only=True)
class AgainstGuard:
    """Trips when the motion, whichever way it goes, is opposed with more than a force."""

    limit: float
    """N"""

    def check(self, reading: Reading) -> Trip | None:
        """The trip, or None."""
        value = float(reading.force @ reading.direction)
        return Trip(guard="against", value=value, limit=self.limit) if value > self.limit else None


@dataclass(slots=True, kw_only=True)
class TorqueGuard:
    """Trips when the screwdriver's motor holds a torque, in either sense of turning.

    A motor that starts, or takes up a screw, shows a current for an instant that is not yet a tight screw.
    """

    limit: float
    """N m"""
    _held: int = field(default=0, init=False)

    def check(self, reading: Reading) -> Trip | None:
        """The trip, or None; to be asked once a servo period."""
        value = abs(reading.tool_torque)
        self._held = self._held + 1 if value >= self.limit else 0
        return Trip(guard="torque", value=value, limit=self.limit) if self._held >= HELD else None


@dataclass(frozen=True, slots=True, kw_only=True)
class TouchGuard:
    """Trips when a finger touches something."""

    mask: int
    """1: the first finger of `Sensed.touch`, 2: the second, 3: either."""

    def check(self, reading: Reading) -> Trip | None:
        """The trip, or None; its value is the mask of all fingers that touch."""
        first, second = reading.touch
        closed = first + 2 * second
        return (
            Trip(guard="touch", value=float(closed), limit=float(self.mask)) if closed & self.mask else None
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class AnyGuard:
    """Trips when any of its guards does."""

    guards: tuple["Guard", ...]

    def check(self, reading: Reading) -> Trip | None:
        """The trip of the first that trips, or None."""
        return next((trip for guard in self.guards if (trip := guard.check(reading)) is not None), None)


Guard = ForceGuard | MomentGuard | AgainstGuard | TorqueGuard | TouchGuard | AnyGuard
