"""Where the hand truly is when the controller believes it at a position."""

from typing import Final

import numpy as np

from handeye.arm.dynamics import mass_matrix
from handeye.arm.ik import branches, solve
from handeye.arm.kinematics import forward, jacobian
from handeye.arm.robots.stanford import STANFORD
from handeye.core.pose import Array, Pose
from handeye.tasks.water_pump.prediction.poses import moved
from handeye.tasks.water_pump.prediction.worlds import Worlds
from handeye.tasks.water_pump.world.nominal import PARK

_WHOLE: Final = 2 * np.pi


class Hands:
    """The hands of many worlds; joints stand where they read, and read wrong."""

    def __init__(self, worlds: Worlds) -> None:
        self._errors = worlds.arm()
        self._longer = worlds["arm.hand_length"]

    def at(self, X_WT: Pose) -> Array:
        """True poses for one believed pose, shape (n, 4, 4)."""
        return self._true(np.broadcast_to(self._near(X_WT), self._errors.offset.shape))

    def at_each(self, X_WT: Array, planned: Pose) -> Array:
        """True poses for a believed one of each world, near a planned one that tells which way the arm bends."""
        near = self._near(planned)
        every, exists = branches(STANFORD, X_WT)
        turning = np.array([joint.kind == "revolute" for joint in STANFORD.joints])
        every = np.where(turning, near + (every - near + np.pi) % _WHOLE - np.pi, every)
        far = np.where(exists, np.abs(every - near).sum(axis=-1), np.inf)
        return self._true(np.take_along_axis(every, far.argmin(axis=-1)[:, None, None], axis=1)[:, 0])

    def gives(self, X_WT: Pose, force: float) -> float:
        """How far a hand that presses down with a force, N, stands over its set-point, m; of the arm as believed."""
        q = self._near(X_WT)
        J = jacobian(STANFORD, q)[2]
        stiffness = mass_matrix(STANFORD, q) * np.array(STANFORD.servo.frequency) ** 2
        return float(J @ np.linalg.solve(stiffness, J) * force)

    def _true(self, readings: Array) -> Array:
        X = forward(STANFORD, self._errors.positions(readings))
        return moved(X, X[:, :3, 2] * self._longer[:, None])

    @staticmethod
    def _near(X_WT: Pose) -> Array:
        q = solve(STANFORD, X_WT, PARK).q
        assert q is not None, "the pump's positions are within reach"
        return q
