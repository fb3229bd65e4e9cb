"""One setting of the television camera, at which the arm shows its lamp to it."""

from dataclasses import dataclass

from handeye.core.record import Vector3


@dataclass(frozen=True, slots=True, kw_only=True)
class CalibrationLook:
    """A camera setting and the places the lamp is shown at; W, m."""

    lens: float
    """Focal length, m."""
    at: Vector3
    """Point the camera is aimed at."""
    sharp: Vector3
    """Where the focus is set; one for neighbouring looks, since refocusing takes three times as long as aiming."""
    places: tuple[Vector3, ...]
    hand_angle: float
    """O of the hand while it shows its lamp, rad; it points down."""
