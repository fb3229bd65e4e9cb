"""Lets a machine with axes serve as a TRIG arm. Moves are sequences of set-points; guarded moves use the finger
that senses force.
"""

from collections.abc import Iterable
from typing import Final, Literal

import numpy as np

from handeye.arm.profiles import quintic, slow_line
from handeye.core.pose import Array
from handeye.core.record import Record, Vector3
from handeye.machines.arm_machine import HandlingLimits
from handeye.ports.axes import Axes
from handeye.ports.clock import Clock
from handeye.systems.trig.language.place import Place
from handeye.systems.trig.language.trig_arm import (
    Arrival,
    Halted,
    LeftBehind,
    MissingSupport,
    Obstacle,
    Resistance,
    TrigArm,
)

APPROACH: Final = 5e-3
"""Length (m) of the last part of a set-down. This part is vertical, because a slanted path would push a stack over."""
DEEPER: Final = 2e-3
"""Distance below a place (m) within which the arm must find support when it puts an object back. The height of a
taught place has a standard deviation of .3 mm. An object may therefore have dropped by two or three times as much (.6
to .9 mm) when it was released. In addition, the arm may have grasped the object .6 to .9 mm too high.
"""
AGAIN: Final = 1.5
"""Permitted force during the reversal of a move, as a multiple of the force that the move met. The factor is the same
as for the pump. When the hand has pressed an object onto a support and then rises, the sensed force changes by about
the force that the move met.
"""
_TARE: Final = 10  # readings averaged before a guarded move


class ArmMemory(Record, frozen=True, kw_only=True):
    """What the arm remembers between two steps: the commanded place, the commanded opening (m), and whether the
    hand is closed."""

    told: Place
    opening: float
    closed: bool


class AxesArm(TrigArm):
    """A TRIG arm that consists of the six axes (X, Y, Z, roll, pitch and yaw) and the hand of a machine."""

    def __init__(self, axes: Axes, clock: Clock, limits: HandlingLimits, *, ready: bool = False) -> None:
        """Take the arm. If the arm is not `ready`, open its hand."""
        self._axes, self._clock, self._limits = axes, clock, limits
        self._goal, self._closed, self._opening = self._where(), False, limits.open
        self._met_force = 0.0
        self._speed = np.array([spec.speed for spec in axes.specs[:-1]])
        self._acceleration = np.array(limits.acceleration)
        if not ready:
            self._wait(self._limits.grasping)

    def here(self) -> Place:
        return Place(*map(float, self._goal))

    @property
    def closed(self) -> bool:
        return self._closed

    @property
    def memory(self) -> ArmMemory:
        return ArmMemory(told=self.here(), opening=self._opening, closed=self._closed)

    def remember(self, memory: ArmMemory) -> None:
        self._goal, self._opening, self._closed = np.array(memory.told), memory.opening, memory.closed

    @property
    def travel(self) -> tuple[tuple[float, float], ...]:
        return tuple((spec.lower, spec.upper) for spec in self._axes.specs[:-1])

    def go(self, goal: Place, halted: Halted) -> bool:
        self.check_travel(goal)
        way = quintic(self._goal, np.array(goal), self._speed, self._acceleration, self._axes.period)
        before = self._force()
        self._met_force = 0.0
        arrived = self._follow(way, halted, before)
        self._wait(self._limits.settling)
        self._notice(before)
        return arrived

    @property
    def met(self) -> float:
        return self._met_force

    def feel(self, goal: Place, vector: Vector3, threshold: float, halted: Halted) -> Arrival:
        self.check_travel(goal)
        self._wait(self._limits.settling)
        tare = self._tared()
        force = self._met_force = 0.0
        for q in slow_line(
            self._goal, np.array(goal), np.array(self._limits.guarded_speed), self._axes.period
        ):
            force = float(np.dot(vector, self._force() - tare))
            self._notice(tare)
            if force > threshold or halted():
                self._stand()
                return Arrival(kind="tripped" if force > threshold else "halted", force=force)
            self._put(q)
        return Arrival(kind="reached", force=force)

    def back(self, goal: Place, halted: Halted, met: float = 0.0) -> Literal["halted"] | Obstacle | None:
        self.check_travel(goal)
        tare, limit = self._tared(), max(self._limits.resistance, AGAIN * met)
        for q in quintic(self._goal, np.array(goal), self._speed, self._acceleration, self._axes.period):
            if halted():
                self._wait(self._limits.settling)
                return "halted"
            speed = (q - self._goal) / self._axes.period
            self._put(q)
            obstacle = self._obstacle(tare, speed, limit)
            if obstacle is not None:
                return obstacle
        self._wait(self._limits.settling)
        return self._obstacle(tare, np.zeros(len(self._goal)), limit)

    def set_down(self, goal: Place, halted: Halted, met: float = 0.0) -> Literal["halted"] | Obstacle | None:
        stop = self.back(self.within_travel(goal._replace(z=goal.z + APPROACH)), halted, met)
        if stop is not None:
            return stop
        tare = self._tared()
        lowest = self.within_travel(goal._replace(z=goal.z - DEEPER))
        for q in slow_line(
            self._goal, np.array(lowest), np.array(self._limits.guarded_speed), self._axes.period
        ):
            if halted():
                self._stand()
                return "halted"
            speed = (q - self._goal) / self._axes.period
            self._put(q)
            if (self._force() - tare)[2] > self._limits.carried:
                self._stand()
                return None
            obstacle = self._obstacle(tare, speed, self._limits.resistance)
            if obstacle is not None:
                return obstacle
        return MissingSupport()

    @property
    def gap(self) -> float:
        return float(self._axes.read().q[-1])

    def hand(self, closed: bool) -> None:
        self._closed = closed
        way = np.array([self._opening]), np.array([self._limits.closed if closed else self._limits.open])
        for opening in slow_line(*way, np.array([self._axes.specs[-1].speed]), self._axes.period):
            self._opening = float(opening[0])
            self._put(self._goal)
        self._wait(self._limits.grasping)

    def _obstacle(self, tare: Array, speed: Array, limit: float) -> Obstacle | None:
        """Return the obstacle in the way, if there is one. An obstacle is either a force that exceeds `tare` by more
        than `limit` (N), or an axis that lags behind. `speed` is the speed of the n axes (m/s or rad/s, shape (n,)).
        """
        found = self._resistance(tare, limit) or self._left_behind(speed)
        if found is not None:
            self._stand()
        return found

    def _stand(self) -> None:
        """Stop, and make the sensed position the commanded position."""
        self._goal = self._where()
        self._wait(self._limits.settling)

    def _where(self) -> Array:
        """Return the sensed axis positions, clipped to the travel of the axes, because readings may exceed the
        travel slightly.
        """
        lower, upper = np.transpose(self.travel)
        return np.clip(self._axes.read().q[:-1], lower, upper)

    def _resistance(self, tare: Array, limit: float) -> Resistance | None:
        force = float(np.linalg.norm(self._force() - tare))
        return Resistance(force=round(force, 6), limit=round(limit, 6)) if force > limit else None

    def _left_behind(self, speed: Array) -> LeftBehind | None:
        off = np.abs(self._goal - self._axes.read().q[:-1])
        limits = np.array(self._limits.standing) + self._limits.lag * np.abs(speed)
        axis = int(np.argmax(off / limits))
        if off[axis] <= limits[axis]:
            return None
        return LeftBehind(axis=axis, off=round(float(off[axis]), 6), limit=round(float(limits[axis]), 6))

    def _follow(self, way: Iterable[Array], halted: Halted, before: Array) -> bool:
        for q in way:
            if halted():
                return False
            self._put(q)
            self._notice(before)
        return True

    def _notice(self, before: Array) -> None:
        """Update the greatest change of the force on the finger."""
        self._met_force = max(self._met_force, float(np.linalg.norm(self._force() - before)))

    def _put(self, q: Array) -> None:
        self._goal = q
        self._axes.put(np.append(q, self._opening))
        self._clock.advance(self._axes.period)

    def _wait(self, seconds: float) -> None:
        for _ in range(round(seconds / self._axes.period)):
            self._put(self._goal)

    def _force(self) -> Array:
        """Return the force on the finger (N) along the finger's axes, which are parallel to the arm's axes
        while the hand is level.

        The gauges measure the force that the finger exerts, so this function reverses the sign.
        """
        channels = self._axes.read().channels
        return -np.array([channels[f"force_{axis}"] for axis in "xyz"])

    def _tared(self) -> Array:
        readings = []
        for _ in range(_TARE):
            self._put(self._goal)
            readings.append(self._force())
        felt: Array = np.mean(readings, axis=0)
        return felt
