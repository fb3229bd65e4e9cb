"""The honesty wall: everything the working phase can sense of the cell, and everything it can do to it.

No body pose, contact list or true force crosses this wall. Lengths in metres, angles in radians, forces in
newtons, time in seconds. World frame W: table corner, z up.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from handeye.pose import Array

TICK = 1 / 60
"""Servo period, s: the cell advances by exactly this at every tick."""

FIRST_LENS = 0.050
"""m, of the lens that is in place when the cell is switched on: as the last look of a run leaves it."""

Picture = NDArray[np.uint8]
"""A digitised television picture: 256 rows by 333 columns of intensities 0..15."""


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


class TvCamera(ABC):
    """The television camera on its pan/tilt mount with a two-lens turret.

    `lens`, `aim` and `focus` start a slow mechanical action; they return the time it takes, and the executor
    lets that much time pass (brakes on) before it takes a picture.
    """

    @abstractmethod
    def lens(self, focal_length: float) -> float:
        """Turn the turret to the lens of that focal length (m, .025 or .050); seconds it takes (0: already there).

        Raises:
            InvalidInput: no such lens.
        """

    @abstractmethod
    def aim(self, pan: float, tilt: float) -> float:
        """Slew to these potentiometer readings (rad); seconds it takes."""

    @abstractmethod
    def focus(self, distance: float) -> float:
        """Set the focus for a distance (m); seconds it takes."""

    @abstractmethod
    def pots(self) -> tuple[float, float]:
        """Pan and tilt as the potentiometers read them now (rad), noise included."""

    @abstractmethod
    def digitise(self, *, hold_target: bool = False) -> tuple[Picture, float]:
        """Take a picture; the picture and the seconds it takes.

        Args:
            hold_target: keep the vidicon target voltage (gain) of the previous picture, as a difference of
                two pictures needs, instead of adjusting it to this one.
        """

    @property
    @abstractmethod
    def renderer(self) -> str:
        """How pictures are made, for reports (`OpenGL (EGL)`, `ray casting`, ...)."""


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
