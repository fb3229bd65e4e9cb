"""The arithmetic of a chain that the servo needs in every period, behind a port: any library may do it.

Planning, and whatever is computed for a whole motion at once, uses the formulas directly.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass

from handeye.arm import dynamics, kinematics
from handeye.arm.dynamics import Dynamics
from handeye.arm.model import ArmModel
from handeye.core.pose import Array, Pose


class ArmArithmetic(ABC):
    """Frames and dynamics of one arm at one posture, shape (n,), rad and m; all results are the caller's to keep."""

    @abstractmethod
    def forward(self, q: Array) -> Pose:
        """`X_WT`."""

    @abstractmethod
    def gravity(self, q: Array) -> Array:
        """Torques that hold the arm up at rest, shape (n,), N m and N."""

    @abstractmethod
    def at_rest(self, q: Array) -> Dynamics:
        """Mass matrix, gravity torques and Jacobian."""


@dataclass(frozen=True, slots=True)
class Formulas(ArmArithmetic):
    """The formulas of `arm.kinematics` and `arm.dynamics`: they need no library, and every other is tested by them."""

    arm: ArmModel

    def forward(self, q: Array) -> Pose:
        return kinematics.forward(self.arm, q)

    def gravity(self, q: Array) -> Array:
        return dynamics.gravity(self.arm, q)

    def at_rest(self, q: Array) -> Dynamics:
        return dynamics.at_rest(self.arm, q)
