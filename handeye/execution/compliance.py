"""Compliant straight motions: how measured force moves the set-point.

An admittance: speed follows force. It leaves every joint under its position servo, so that an error of the
gravity model does not make the hand drift as slack joints would.
"""

import math
from dataclasses import dataclass, field

import numpy as np

from handeye.arm.model import ComplianceModel
from handeye.core.pose import Array


@dataclass(frozen=True, slots=True, kw_only=True)
class Course:
    """A straight way and how force changes it. Vectors in W."""

    compliance: ComplianceModel
    """Figures of the arm that goes it."""
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
    friction: Array = field(default_factory=lambda: np.zeros(6))
    """The most that friction of the joints is felt as along and about each axis of W, N and N m, shape (6,): the dead
    band of giving way."""

    def patience(self, pressing: int, period: float) -> int:
        """Servo periods (s) the motion may take: `pressing` ones, beside those of an unhindered way."""
        return pressing + math.ceil(self.distance / self.speed / period)

    def advance(self, wrench: Array, tick: int) -> float:
        """Speed along the way (m/s) for an external wrench on the hand, in servo period number `tick`."""
        if self.force is None:
            return self.speed * min(1.0, (tick + 1) / self.compliance.ramp)
        felt, k = float(-wrench[:3] @ self.direction), self.compliance
        return float(np.clip((self.force - felt) * k.gain, -k.speed, k.speed))

    def yielding(self, wrench: Array) -> Array:
        """Velocity (m/s) with which the hand gives way, shape (3,)."""
        k = self.compliance
        return np.clip(_beyond(self.free * wrench[:3], self.friction[:3]) * k.gain, -k.speed, k.speed)

    def turned(self, turn: Array, wrench: Array, period: float) -> Array:
        """Rotation vector (rad) of the hand one servo period (s) after `turn`, shape (3,)."""
        felt, k = wrench[3:], self.compliance
        missing = _beyond(self.spin * felt, self.friction[3:])
        wanted = float(np.linalg.norm(self.moment))
        if wanted:
            axis = self.moment / wanted
            missing += axis * (wanted + float((felt - missing) @ axis))
        turn = turn + np.clip(missing * k.turn_gain, -k.turn_speed, k.turn_speed) * period
        return turn * (k.turn_limit / max(float(np.linalg.norm(turn)), k.turn_limit))


def _beyond(felt: Array, deadband: Array) -> Array:
    """The force or moment that is felt, less a dead band of each axis."""
    return np.asarray(np.sign(felt) * np.maximum(np.abs(felt) - deadband, 0.0))
