"""Compliant straight motions: how measured force moves the set-point.

An admittance: speed follows force. It leaves every joint under its position servo, so that an error of the
gravity model does not make the hand drift as slack joints would.
"""

import math
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from handeye.pose import Array
from handeye.units import DEGREE, OUNCE_INCH

GAIN: Final = 0.0015
"""Speed per force, m/s/N: slow enough for the arm's 20 kg of felt inertia."""
GREATEST: Final = 0.0127
"""Greatest speed that force alone makes, m/s."""
NOISE: Final = 0.4
"""Force below which the hand does not give way, N: twice what joint friction is felt as."""
TURN_GAIN: Final = 0.1
"""Rate of turning per moment, rad/s/(N m): slow for a wrist that gives some 160 N m a radian under its servo."""
TURN_GREATEST: Final = 0.1
"""Greatest rate that a moment alone makes, rad/s."""
TURN_NOISE: Final = 20 * OUNCE_INCH
"""Moment below which the hand does not give way, N m: joint friction is felt as up to 17 ounce-inches."""
TURN_MOST: Final = 15 * DEGREE
"""The hand is turned no farther than this, rad: what leans on it more has hit it."""
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
    free: Array = field(default_factory=lambda: np.zeros(3))
    """1 along the axes of W in which the hand gives way, else 0, shape (3,)."""
    moment: Array = field(default_factory=lambda: np.zeros(3))
    """N m to exert about the tool centre point, turning until it does, shape (3,)."""
    spin: Array = field(default_factory=lambda: np.zeros(3))
    """1 about the axes of W about which the hand gives way, else 0, shape (3,)."""

    def patience(self, pressing: int, period: float) -> int:
        """Servo periods (s) the motion may take: `pressing` ones, beside those of an unhindered way."""
        return pressing + math.ceil(self.distance / self.speed / period)

    def advance(self, wrench: Array, tick: int) -> float:
        """Speed along the way (m/s) for an external wrench on the hand, in servo period number `tick`."""
        if self.force is None:
            return self.speed * min(1.0, (tick + 1) / RAMP)
        felt = float(-wrench[:3] @ self.direction)
        return float(np.clip((self.force - felt) * GAIN, -GREATEST, GREATEST))

    def yielding(self, wrench: Array) -> Array:
        """Velocity (m/s) with which the hand gives way, shape (3,)."""
        return np.clip(_beyond(self.free * wrench[:3], NOISE) * GAIN, -GREATEST, GREATEST)

    def turned(self, turn: Array, wrench: Array, period: float) -> Array:
        """Rotation vector (rad) of the hand one servo period (s) after `turn`, shape (3,)."""
        felt = wrench[3:]
        missing = _beyond(self.spin * felt, TURN_NOISE)
        wanted = float(np.linalg.norm(self.moment))
        if wanted:
            axis = self.moment / wanted
            missing += axis * (wanted + float((felt - missing) @ axis))
        turn = turn + np.clip(missing * TURN_GAIN, -TURN_GREATEST, TURN_GREATEST) * period
        return turn * (TURN_MOST / max(float(np.linalg.norm(turn)), TURN_MOST))


def _beyond(felt: Array, noise: float) -> Array:
    """The force that is felt, less the noise."""
    return np.asarray(np.sign(felt) * np.maximum(np.abs(felt) - noise, 0.0))
