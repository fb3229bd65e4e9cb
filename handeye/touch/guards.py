"""Monitors: each watches one guard of a motion, and ends the motion when the guard trips."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Final, Protocol

import numpy as np

from handeye.core.pose import Array
from handeye.program import guards as g
from handeye.program.guards import GuardKind, Guards

HOLD_PERIODS: Final = 4  # servo periods that a torque must last; the spindle starts in fewer; placeholder


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Reading:
    """Sensor readings of one servo period. Vectors have shape (3,) and are given in world axes."""

    force: Array  # force that the hand exerts on the world, N
    direction: Array  # unit vector of the motion, or zero
    moment: Array = field(default_factory=lambda: np.zeros(3))  # about the tool centre point, N m
    touch: tuple[bool, bool] = (False, False)  # as `Sensed.touch`
    tool_torque: float = 0.0  # N m


@dataclass(frozen=True, slots=True, kw_only=True)
class Trip:
    """A guard that has ended a motion, with the measured value and the limit. Both are a force (N), a torque (N m), or
    a mask of finger switches.
    """

    guard: GuardKind
    value: float
    limit: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ActiveGuard:
    """An active guard. `axis` is the unit vector of the watched force or moment (shape (3,), in W), or None."""

    guard: GuardKind
    limit: float
    axis: Array | None = None


class Monitor(Protocol):
    """Watches one guard. Each motion has new monitors."""

    def active(self, direction: Array) -> tuple[ActiveGuard, ...]:
        """Return the guards that are active while the motion goes along the unit vector `direction`, shape (3,)."""
        ...

    def check(self, reading: Reading) -> Trip | None:
        """Return the guard that has tripped, or None. Call this method once in each servo period."""
        ...


@dataclass(slots=True, kw_only=True, eq=False)
class VectorMonitor:
    """Trips when the hand exerts too great a force (N) along `vector`, or too great a moment (N m) about `vector`. The
    limit is the length of `vector`, shape (3,), in world axes.
    """

    guard: GuardKind
    vector: Array
    _limit: float = field(init=False)
    _active: tuple[ActiveGuard, ...] = field(init=False)

    def __post_init__(self) -> None:
        self._limit = float(np.linalg.norm(self.vector))
        self._active = (ActiveGuard(guard=self.guard, limit=self._limit, axis=self.vector / self._limit),)

    def active(self, direction: Array) -> tuple[ActiveGuard, ...]:
        return self._active

    def check(self, reading: Reading) -> Trip | None:
        felt = reading.force if self.guard is GuardKind.FORCE else reading.moment
        value = float(felt @ self.vector) / self._limit
        return Trip(guard=self.guard, value=value, limit=self._limit) if value > self._limit else None


@dataclass(frozen=True, slots=True, kw_only=True)
class AgainstMonitor:
    """Trips when a force of more than `limit` (N) opposes the motion, in whatever direction the hand moves."""

    limit: float

    def active(self, direction: Array) -> tuple[ActiveGuard, ...]:
        return (ActiveGuard(guard=GuardKind.AGAINST, limit=self.limit, axis=direction),)

    def check(self, reading: Reading) -> Trip | None:
        value = float(reading.force @ reading.direction)
        return Trip(guard=GuardKind.AGAINST, value=value, limit=self.limit) if value > self.limit else None


@dataclass(slots=True, kw_only=True)
class TorqueMonitor:
    """Trips when the motor holds a torque (N m) in either direction for some time. The short peak of the torque when
    the motor starts does not trip the monitor.
    """

    limit: float
    _held: int = field(default=0, init=False)

    def active(self, direction: Array) -> tuple[ActiveGuard, ...]:
        return (ActiveGuard(guard=GuardKind.TORQUE, limit=self.limit),)

    def check(self, reading: Reading) -> Trip | None:
        value = abs(reading.tool_torque)
        self._held = self._held + 1 if value >= self.limit else 0
        return (
            Trip(guard=GuardKind.TORQUE, value=value, limit=self.limit)
            if self._held >= HOLD_PERIODS
            else None
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class TouchMonitor:
    """Trips when a finger touches. `mask` selects the watched switches of `Sensed.touch`: 1 selects the first, 2 the
    second, and 3 both. If both are watched, either switch trips the monitor.
    """

    mask: int

    def active(self, direction: Array) -> tuple[ActiveGuard, ...]:
        return (ActiveGuard(guard=GuardKind.TOUCH, limit=float(self.mask)),)

    def check(self, reading: Reading) -> Trip | None:
        first, second = reading.touch
        closed = first + 2 * second
        if not closed & self.mask:
            return None
        return Trip(guard=GuardKind.TOUCH, value=float(closed), limit=float(self.mask))


@dataclass(frozen=True, slots=True, kw_only=True)
class FirstOf:
    """Trips when any of its monitors trips."""

    monitors: tuple[Monitor, ...]

    def active(self, direction: Array) -> tuple[ActiveGuard, ...]:
        return tuple(guard for one in self.monitors for guard in one.active(direction))

    def check(self, reading: Reading) -> Trip | None:
        return next((trip for one in self.monitors if (trip := one.check(reading)) is not None), None)


_MONITORS: Final[dict[type[g.Guard], Callable[[Any], Monitor]]] = {
    g.Force: lambda guard: VectorMonitor(guard=GuardKind.FORCE, vector=np.array(guard.force)),
    g.Against: lambda guard: AgainstMonitor(limit=guard.force),
    g.Moment: lambda guard: VectorMonitor(guard=GuardKind.MOMENT, vector=np.array(guard.moment)),
    g.Torque: lambda guard: TorqueMonitor(limit=guard.torque),
    g.Touch: lambda guard: TouchMonitor(mask=guard.fingers),
}


def monitor(guards: Guards) -> Monitor | None:
    """Make one monitor for all guards of a motion. Returns None if there are no guards."""
    found = tuple(_MONITORS[type(guard)](guard) for guard in guards)
    return found[0] if len(found) == 1 else FirstOf(monitors=found) if found else None
