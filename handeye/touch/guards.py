"""Guards at work: each monitor watches for what a guard names, and ends the motion when it is met."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Final, Protocol

import numpy as np

from handeye.core.pose import Array
from handeye.program import guards as g
from handeye.program.guards import GuardKind, Guards

HELD: Final = 4
"""Servo periods for which a torque has to last. Placeholder: the spindle is up to speed in less."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Reading:
    """Forces and switches that a monitor looks at in a servo period."""

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

    guard: GuardKind
    value: float
    limit: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ActiveGuard:
    """A guard that watches in a servo period, and what it allows."""

    guard: GuardKind
    limit: float
    """As `Trip.limit`."""
    axis: Array | None = None
    """Unit vector along which it looks at the force of the hand, or about which at its moment, shape (3,), world
    axes; None: it looks at neither."""


class Monitor(Protocol):
    """Watches for a guard; made anew for each motion."""

    def active(self, direction: Array) -> tuple[ActiveGuard, ...]:
        """The guards it watches for while the motion goes along a unit vector, shape (3,)."""
        ...

    def check(self, reading: Reading) -> Trip | None:
        """The trip, or None; to be asked once a servo period."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ForceMonitor:
    """Trips when the hand presses along a vector with more than the vector's length.

    A force to the side, or the other way, does not count.
    """

    force: Array
    """Shape (3,), N, world axes; not zero."""

    def active(self, direction: Array) -> tuple[ActiveGuard, ...]:
        """Its guard."""
        return (_active(GuardKind.FORCE, self.force),)

    def check(self, reading: Reading) -> Trip | None:
        """The trip, or None."""
        return _along(GuardKind.FORCE, reading.force, self.force)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MomentMonitor:
    """Trips when the hand turns something about a vector with more than the vector's length."""

    moment: Array
    """Shape (3,), N m, world axes; not zero."""

    def active(self, direction: Array) -> tuple[ActiveGuard, ...]:
        """Its guard."""
        return (_active(GuardKind.MOMENT, self.moment),)

    def check(self, reading: Reading) -> Trip | None:
        """The trip, or None."""
        return _along(GuardKind.MOMENT, reading.moment, self.moment)


def _active(guard: GuardKind, vector: Array) -> ActiveGuard:
    limit = float(np.linalg.norm(vector))
    return ActiveGuard(guard=guard, limit=limit, axis=vector / limit)


def _along(guard: GuardKind, felt: Array, vector: Array) -> Trip | None:
    limit = float(np.linalg.norm(vector))
    value = float(felt @ vector) / limit
    return Trip(guard=guard, value=value, limit=limit) if value > limit else None


@dataclass(frozen=True, slots=True, kw_only=True)
class AgainstMonitor:
    """Trips when the motion, whichever way it goes, is opposed with more than a force."""

    limit: float
    """N"""

    def active(self, direction: Array) -> tuple[ActiveGuard, ...]:
        """Its guard."""
        return (ActiveGuard(guard=GuardKind.AGAINST, limit=self.limit, axis=direction),)

    def check(self, reading: Reading) -> Trip | None:
        """The trip, or None."""
        value = float(reading.force @ reading.direction)
        return Trip(guard=GuardKind.AGAINST, value=value, limit=self.limit) if value > self.limit else None


@dataclass(slots=True, kw_only=True)
class TorqueMonitor:
    """Trips when the screwdriver's motor holds a torque, in either sense of turning.

    A motor that starts, or takes up a screw, shows a current for an instant that is not yet a tight screw.
    """

    limit: float
    """N m"""
    _held: int = field(default=0, init=False)

    def active(self, direction: Array) -> tuple[ActiveGuard, ...]:
        """Its guard."""
        return (ActiveGuard(guard=GuardKind.TORQUE, limit=self.limit),)

    def check(self, reading: Reading) -> Trip | None:
        """The trip, or None."""
        value = abs(reading.tool_torque)
        self._held = self._held + 1 if value >= self.limit else 0
        return Trip(guard=GuardKind.TORQUE, value=value, limit=self.limit) if self._held >= HELD else None


@dataclass(frozen=True, slots=True, kw_only=True)
class TouchMonitor:
    """Trips when a finger touches something."""

    mask: int
    """1: the first finger of `Sensed.touch`, 2: the second, 3: either."""

    def active(self, direction: Array) -> tuple[ActiveGuard, ...]:
        """Its guard."""
        return (ActiveGuard(guard=GuardKind.TOUCH, limit=float(self.mask)),)

    def check(self, reading: Reading) -> Trip | None:
        """The trip, or None; its value is the mask of all fingers that touch."""
        first, second = reading.touch
        closed = first + 2 * second
        if not closed & self.mask:
            return None
        return Trip(guard=GuardKind.TOUCH, value=float(closed), limit=float(self.mask))


@dataclass(frozen=True, slots=True, kw_only=True)
class FirstOf:
    """Trips when any of its monitors does."""

    monitors: tuple[Monitor, ...]

    def active(self, direction: Array) -> tuple[ActiveGuard, ...]:
        """All guards of its monitors."""
        return tuple(guard for one in self.monitors for guard in one.active(direction))

    def check(self, reading: Reading) -> Trip | None:
        """The trip of the first that trips, or None."""
        return next((trip for one in self.monitors if (trip := one.check(reading)) is not None), None)


_MONITORS: Final[dict[type[g.Guard], Callable[[Any], Monitor]]] = {
    g.Force: lambda guard: ForceMonitor(force=np.array(guard.force)),
    g.Against: lambda guard: AgainstMonitor(limit=guard.force),
    g.Moment: lambda guard: MomentMonitor(moment=np.array(guard.moment)),
    g.Torque: lambda guard: TorqueMonitor(limit=guard.torque),
    g.Touch: lambda guard: TouchMonitor(mask=guard.fingers),
}


def monitor(guards: Guards) -> Monitor | None:
    """The monitor of all of some guards; None if there are none."""
    found = tuple(_MONITORS[type(guard)](guard) for guard in guards)
    return found[0] if len(found) == 1 else FirstOf(monitors=found) if found else None
