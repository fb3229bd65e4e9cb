"""The interface for the kinematics and dynamics that the servo computes in every period. The interface can be
implemented with any numerical library.

The planner, and all other code that computes a whole motion at once, uses the formulas of `arm.kinematics` and
`arm.dynamics` directly.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass

from handeye.arm import dynamics, kinematics
from handeye.arm.dynamics import Dynamics
from handeye.arm.model import ArmModel
from handeye.core.pose import Array, Pose


class ArmArithmetic(ABC):
    """Kinematics and dynamics of one arm. Joint positions `q` have shape (n,), in rad and m. The caller may keep
    and change all results.
    """

    @abstractmethod
    def forward(self, q: Array) -> Pose:
        """Return the pose `X_WT` of the hand at joint positions `q`."""

    @abstractmethod
    def gravity(self, q: Array) -> Array:
        """Return the joint torques that hold the arm up at rest, shape (n,), in N m (in N for prismatic joints)."""

    @abstractmethod
    def at_rest(self, q: Array) -> Dynamics:
        """Return the mass matrix, gravity torques and Jacobian of the arm at rest."""

    def statics(self, q: Array) -> tuple[Array, Array]:
        """Return the gravity torques and the Jacobian, as `at_rest` does. An implementation need not compute the mass
        matrix.
        """
        there = self.at_rest(q)
        return there.bias, there.J


@dataclass(frozen=True, slots=True)
class Formulas(ArmArithmetic):
    """The formulas of `arm.kinematics` and `arm.dynamics`, which need no library besides NumPy. All other
    implementations are tested against them.
    """

    arm: ArmModel

    def forward(self, q: Array) -> Pose:
        return kinematics.forward(self.arm, q)

    def gravity(self, q: Array) -> Array:
        return dynamics.gravity(self.arm, q)

    def at_rest(self, q: Array) -> Dynamics:
        return dynamics.at_rest(self.arm, q)
