"""An arm for TRIG whose axes go where they are told: moves as set-points, and guarded ones that feel with a finger."""

from collections.abc import Iterable
from typing import Final

import numpy as np

from handeye.arm.profiles import quintic, slow_line
from handeye.ports.axes import Axes
from handeye.ports.clock import Clock
from handeye.pose import Array
from handeye.record import Vector3
from handeye.trig.place import Place
from handeye.trig.teachable import Arrival, Halted, Teachable

OPEN: Final = 0.048
"""m between the fingers."""
CLOSED: Final = -0.020
"""m, as told: it never gets there, and so presses with all its force."""
ACCELERATION: Final = (1.0, 1.0, 1.0, 10.0, 10.0, 10.0)
"""m/s2 and rad/s2. A stack of twenty blocks of 12 mm on 30 mm tips at 1.2 m/s2."""
GUARDED: Final = (0.015, 0.015, 0.015, 0.2, 0.2, 0.2)
"""m/s and rad/s of a guarded move."""
SETTLING: Final = 0.15
"""s that the servos are given behind a move."""
GRASPING: Final = 0.5
"""s that the hand is given."""
_TARE: Final = 10
"""Readings of the force that are averaged before a guarded move."""


class AxesArm(Teachable):
    """Six axes, X, Y, Z, roll, pitch and yaw, and a hand, behind the port of an axes machine."""

    def __init__(self, axes: Axes, clock: Clock) -> None:
        self._axes, self._clock = axes, clock
        self._goal, self._closed = axes.read().q, False
        self._speed = np.array([spec.speed for spec in axes.specs])
        self._wait(GRASPING)

    def here(self) -> Place:
        return Place(*map(float, self._goal))

    @property
    def closed(self) -> bool:
        return self._closed

    @property
    def travel(self) -> tuple[tuple[float, float], ...]:
        return tuple((spec.lower, spec.upper) for spec in self._axes.specs)

    def go(self, goal: Place, halted: Halted) -> bool:
        self.check_travel(goal)
        way = quintic(self._goal, np.array(goal), self._speed, np.array(ACCELERATION), self._axes.period)
        arrived = self._follow(way, halted)
        self._wait(SETTLING)
        return arrived

    def feel(self, goal: Place, vector: Vector3, threshold: float, halted: Halted) -> Arrival:
        self.check_travel(goal)
        self._wait(SETTLING)
        tare = self._tared()
        force = 0.0
        for q in slow_line(self._goal, np.array(goal), np.array(GUARDED), self._axes.period):
            force = float(np.dot(vector, self._force() - tare))
            if force > threshold or halted():
                break
            self._put(q)
        else:
            return Arrival(kind="reached", force=force)
        self._wait(SETTLING)
        return Arrival(kind="tripped" if force > threshold else "halted", force=force)

    def hand(self, closed: bool) -> None:
        self._closed = closed
        self._wait(GRASPING)

    def _follow(self, way: Iterable[Array], halted: Halted) -> bool:
        for q in way:
            if halted():
                return False
            self._put(q)
        return True

    def _put(self, q: Array) -> None:
        self._goal = q
        self._axes.put(q, CLOSED if self._closed else OPEN)
        self._clock.advance(self._axes.period)

    def _wait(self, seconds: float) -> None:
        for _ in range(round(seconds / self._axes.period)):
            self._put(self._goal)

    def _force(self) -> Array:
        """The force on the finger, N, along its own axes, which are those of the arm while the hand is level.

        Its gauges tell the force that the finger exerts.
        """
        channels = self._axes.read().channels
        return -np.array([channels[f"force_{axis}"] for axis in "xyz"])

    def _tared(self) -> Array:
        """The force that is felt while nothing is touched."""
        readings = []
        for _ in range(_TARE):
            self._put(self._goal)
            readings.append(self._force())
        felt: Array = np.mean(readings, axis=0)
        return felt
