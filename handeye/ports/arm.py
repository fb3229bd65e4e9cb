"""An arm whose servo is closed in the computer: potentiometers and tachometers, torques and brakes."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

from handeye.core.pose import Array


@dataclass(frozen=True, slots=True, kw_only=True)
class ArmReading:
    """Readings of an arm of n joints."""

    q: Array
    """Joint positions by the potentiometers, shape (n,), rad or m, calibration error included."""
    qd: Array
    """Joint rates by the tachometers, shape (n,)."""
    braked: bool
    """Brakes set, drives off."""


class ArmPort(ABC):
    """Motors, brakes and sensors of an arm.

    A watchdog guards it: an arm that is not driven anew before the clock has advanced by a servo period has its
    drives cut and its brakes set, and stays so until the program sets the brakes itself. Where the clock advances by
    more than that at once, they are cut from the beginning. The hand is not cut: it keeps hold of what it has.
    """

    @abstractmethod
    def read(self) -> ArmReading:
        """Readings of the present moment. Reading twice without letting time pass gives the same values."""

    @abstractmethod
    def drive(self, torque: Array | None) -> None:
        """Put out joint torques, shape (n,), N m or N, held for a servo period; None: drives off, brakes set.

        Raises InvalidInput if there are more or fewer torques than joints, or one is not a finite number.
        """
