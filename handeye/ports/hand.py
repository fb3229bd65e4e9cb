"""A hand with two fingers that open and close together under a servo of its own."""

from abc import ABC, abstractmethod
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class HandReading:
    """Readings of a hand."""

    gap: float
    """Opening between the finger tips by the hand's potentiometer, m."""
    touch: tuple[bool, bool]
    """The microswitch inside each finger: (finger on the +y side of the hand frame, finger on the -y side)."""


class HandPort(ABC):
    """Motor and sensors of a hand."""

    @abstractmethod
    def read(self) -> HandReading:
        """Readings of the present moment. Reading twice without letting time pass gives the same values."""

    @abstractmethod
    def drive(self, gap: float, grip: float) -> None:
        """Set where the fingers are to go (gap, m) and the most force each may press with (grip, N).

        Raises InvalidInput if one of them is not a finite number.
        """
