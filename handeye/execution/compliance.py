"""Compliant straight motions, in which the measured force moves the set-point.

This is admittance control: the speed of the set-point depends on the force. The position servo of every joint stays
on. If joints were slack instead, an error of the gravity model would make the hand drift.
"""

import math
from dataclasses import dataclass, field

import numpy as np

from handeye.arm.model import ComplianceModel
from handeye.core.pose import Array
from handeye.core.small_arrays import limited


@dataclass(frozen=True, slots=True, kw_only=True)
class Course:
    """A straight path, and how the hand responds to force while it moves along this path. Vectors are in W."""

    compliance: ComplianceModel
    direction: Array  # unit vector, (3,)
    distance: float  # m, at most
    speed: float  # m/s, if not pressing
    force: float | None = None  # force to press with, in N; None to move at `speed`
    free: Array = field(default_factory=lambda: np.zeros(3))
    """1 for each axis of W along which the hand yields to force, and 0 for the others, shape (3,)."""
    moment: Array = field(default_factory=lambda: np.zeros(3))
    """Moment (N m, shape (3,)) that the turning hand exerts about the tool centre point."""
    spin: Array = field(default_factory=lambda: np.zeros(3))
    """1 for each axis of W about which the hand yields to moment, and 0 for the others, shape (3,)."""
    friction: Array = field(default_factory=lambda: np.zeros(6))
    """Effect of the joint friction on the sensed wrench, shape (6,): first the force (N) along each axis of W, then
    the moment (N m) about each axis. The compliance does not react to smaller forces and moments.
    """

    def patience(self, pressing: int, period: float) -> int:
        """Return the greatest number of servo periods for the motion: the periods of an unhindered motion,
        plus `pressing` further periods.
        """
        return pressing + math.ceil(self.distance / self.speed / period)

    def advance(self, wrench: Array, tick: int) -> float:
        """Return the speed along the path (m/s) under an external wrench, in the servo period numbered `tick`."""
        if self.force is None:
            return self.speed * min(1.0, (tick + 1) / self.compliance.ramp)
        felt, k = float(-wrench[:3] @ self.direction), self.compliance
        return min(max((self.force - felt) * k.gain, -k.speed), k.speed)

    def yielding(self, wrench: Array) -> Array:
        """Return the velocity (m/s) with which the hand yields to a wrench, shape (3,)."""
        k = self.compliance
        return limited(_beyond(self.free * wrench[:3], self.friction[:3]) * k.gain, k.speed)

    def turned(self, turn: Array, wrench: Array, period: float) -> Array:
        """Return the rotation vector of the hand (rad, shape (3,)) at the end of a servo period (s). `turn` is the
        rotation vector at the beginning of the period.
        """
        felt, k = wrench[3:], self.compliance
        missing = _beyond(self.spin * felt, self.friction[3:])
        wanted = float(np.linalg.norm(self.moment))
        if wanted:
            axis = self.moment / wanted
            missing += axis * (wanted + float((felt - missing) @ axis))
        turn = turn + limited(missing * k.turn_gain, k.turn_speed) * period
        return turn * (k.turn_limit / max(float(np.linalg.norm(turn)), k.turn_limit))


def _beyond(felt: Array, deadband: Array) -> Array:
    """Reduce a force or moment by a dead band on each axis."""
    return np.asarray(np.sign(felt) * np.maximum(np.abs(felt) - deadband, 0.0))
