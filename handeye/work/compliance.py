"""Compliant straight motions: how measured force moves the set-point.

An admittance: speed follows force. It leaves every joint under its position servo, so that an error of the
gravity model does not make the hand drift as slack joints would.
"""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.cell.ports import TICK
from handeye.pose import Array

GAIN: Final = 0.0015
"""Speed per force, m/s/N: slow enough for the arm's 20 kg of felt inertia."""
GREATEST: Final = 0.0127
"""Greatest speed that force alone makes, m/s."""
NOISE: Final = 0.4
"""Force below which the hand does not give way, N: twice what joint friction is felt as."""
RAMP: Final = 6
"""Servo periods to reach the cruising speed."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Course:
    """A straight way and how force changes it. Vectors in W."""

    direction: Array
    """Unit vector, shape (3,)."""
    distance: float
    """m, at most."""
    speed: float
    """m/s, where nothing is pressed on."""
    force: float | None = None
    """N to press with, following what gives way; None: go at `speed`."""
    free: Array
    """1 along the axes of W in which the hand gives way, else 0, shape (3,)."""

    def patience(self, pressing: int) -> int:
        """Servo periods the motion may take: `pressing` ones, beside those of an unhindered way."""
        return pressing + math.ceil(self.distance / self.speed / TICK)

    def advance(self, wrench: Array, tick: int) -> float:
        """Speed along the way (m/s) for an external wrench on the hand, in servo period number `tick`."""
        if self.force is None:
            return self.speed * min(1.0, (tick + 1) / RAMP)
        felt = float(-wrench[:3] @ self.direction)
        return float(np.clip((self.force - felt) * GAIN, -GREATEST, GREATEST))

    def yielding(self, wrench: Array) -> Array:
        """Velocity (m/s) with which the hand gives way, shape (3,)."""
        force = self.free * wrench[:3]
        beyond = np.sign(force) * np.maximum(np.abs(force) - NOISE, 0.0)
        return np.asarray(np.clip(beyond * GAIN, -GREATEST, GREATEST))
