"""A camera setting at which the arm shows its lamp."""

from dataclasses import dataclass

from handeye.core.record import Vector3


@dataclass(frozen=True, slots=True, kw_only=True)
class CalibrationLook:
    """A camera setting, and the places the lamp is shown at; W, m."""

    lens: float  # focal length, m
    at: Vector3  # aim
    sharp: Vector3
    """Point in focus, shared by neighbouring looks, since refocusing takes three times as long as aiming."""
    places: tuple[Vector3, ...]
    hand_angle: float  # angle O of the hand, pointing down, rad
