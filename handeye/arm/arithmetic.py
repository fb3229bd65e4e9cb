"""The kinematics and dynamics that the servo needs in every period, as an interface that any numerical library can
implement.

Planning, and everything computed for a whole motion at once, uses the formulas of `arm.kinematics` and
`arm.dynamics` directly.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass

from handeye.arm import dynamics, kinematics
from handeye.arm.dynamics import Dynamics
from handeye.arm.model import ArmModel
from handeye.core.pose import Array, Pose


class ArmArithmetic(ABC):
    """Frames and dynamics of one arm at one configuration, shape (n,), rad and m; the caller may keep and change
    all results.
    """

    @abstractmethod
    def forward(self, q: Array) -> Pose:
        """Forward kinematics: the pose `X_WT` of the hand."""

    @abstractmethod
    def gravity(self, q: Array) -> Array:
        """Joint torques that hold the arm up at rest, shape (n,), N m, or N for prismatic joints."""

    @abstractmethod
    def at_rest(self, q: Array) -> Dynamics:
        """Mass matrix, gravity torques and Jacobian."""


@dataclass(frozen=True, slots=True)
class Formulas(ArmArithmetic):
    """The formulas of `arm.kinematics` and `arm.dynamics`; they need no library besides NumPy, and all other
    implementations are tested against them.
    """

    arm: ArmModel

    def forward(self, q: Array) -> Pose:
        return kinematics.forward(self.arm, q)

    def gravity(self, q: Array) -> Array:
        return dynamics.gravity(self.arm, q)

    def at_rest(self, q: Array) -> Dynamics:
        return dynamics.at_rest(self.arm, q)
