"""The whole cell as one interface: what is sensed in a servo period, and what is put out for it."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

from handeye.ports.camera import TvCamera
from handeye.pose import Array


@dataclass(frozen=True, slots=True, kw_only=True)
class Sensed:
    """What the interface reads in one servo period."""

    time: float
    q: Array
    """Joint positions by the potentiometers, shape (6,), rad and (joint 3) m, calibration error included."""
    qd: Array
    """Joint rates by the tachometers, shape (6,)."""
    gap: float
    """Opening between the finger tips by the hand potentiometer, m."""
    touch: tuple[bool, bool]
    """The microswitch inside each finger: (finger on the +y side of the hand frame, finger on the -y side)."""
    tool_torque: float
    """Torque of the screwdriver's own motor by its current, N m, positive when it drives a screw in."""
    braked: bool
    """Brakes set, drives off."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Drive:
    """What the interface puts out for one servo period; held constant over it."""

    torque: Array
    """Joint torques, shape (6,), N m and (joint 3) N. Ignored while `brakes`."""
    brakes: bool
    gap: float
    """Finger gap set-point, m."""
    grip: float
    """Most force each finger may press with, N."""
    tool: float
    """Screwdriver spindle speed set-point, rad/s, positive drives a right-hand screw in; 0 is off."""
    lamp: bool = False
    """The small lamp on the hand, which the camera is calibrated by."""


class Workcell(ABC):
    """Drives, sensors, hand, screwdriver, camera and clock of a cell."""

    camera: TvCamera

    @abstractmethod
    def sense(self) -> Sensed:
        """Read the interface at the present tick. Reading twice in one tick gives the same values."""

    @abstractmethod
    def tick(self, drive: Drive) -> None:
        """Put `drive` out and let one servo period pass.

        The servo of the arm may miss its period; the cell then cuts drives and sets brakes (see `late`).
        """

    @abstractmethod
    def late(self) -> None:
        """Let one servo period pass without an answer of the computer: the watchdog cuts drives, sets brakes."""
