"""The pump's cell as designed: the position of its camera, and the views in which the arm shows its lamp to the
camera.
"""

from collections.abc import Iterator
from typing import Final

from handeye.core.record import Vector3
from handeye.core.units import DEGREE, INCH
from handeye.ports.camera import CLOSE_UP, LENSES, WIDE
from handeye.vision.calibration import CalibrationLook
from handeye.vision.camera_model import CameraModel, LensModel

DRAWING: Final = CameraModel(
    mount=(34 * INCH, 68 * INCH, 54 * INCH),
    lenses=tuple(LensModel(focal_length=focal, forward=2 * INCH, up=1 * INCH) for focal in LENSES),
)
"""The camera as designed: on a tripod 14 in beyond the far edge of the table, opposite the arm.

The position is chosen so that no part of the arm hides the base; the offset of the lenses is a placeholder.
"""
_HAND_ANGLE: Final = 135 * DEGREE


_ALL: Final = (0, 1, 2, 3, 4, 5)
_TRIANGLE: Final = (0, 2, 4)  # three of the places in a grid of two rows of three


def _looks(
    chosen: tuple[int, ...], lens: float, x: float, y: float, dx: float, dy: float, heights: tuple[float, ...]
) -> Iterator[CalibrationLook]:
    """Yield one view for each chosen place on a grid centred at (x, y). In each view, the arm shows the lamp at two
    places: one on the left and one on the right, at different heights. All lengths are in inches.

    The camera is aimed again for each view, because each reading of its pan and tilt has a different error. Two lamp
    places in one view determine the roll of the camera. The lamp is shown at different heights, because views of a
    lamp at only one height could not distinguish height from depth.
    """
    for k in chosen:
        cx, cy = x + dx * (k % 3 - 1), y + dy * (k // 3 - 0.5)
        low, high = heights[k % len(heights)], heights[(k + 2) % len(heights)]
        places = ((cx - dx / 2, cy - dy / 4, low), (cx + dx / 2, cy + dy / 4, high))
        at, sharp = (cx, cy, (low + high) / 2), (x, y, sum(heights) / len(heights))
        yield CalibrationLook(
            lens=lens, at=_metres(at), sharp=_metres(sharp), places=tuple(map(_metres, places)),
            hand_angle=_HAND_ANGLE,
        )  # fmt: skip


def _metres(inches: Vector3) -> Vector3:
    x, y, z = inches
    return x * INCH, y * INCH, z * INCH


LOOKS: Final = (
    *_looks(_ALL, WIDE, 42.5, 29.0, 5.0, 6.0, (7.5, 10.0, 12.5)),
    *_looks(_ALL, CLOSE_UP, 42.5, 29.0, 3.5, 4.0, (8.0, 12.0, 7.5, 10.0)),
    *_looks(_TRIANGLE, CLOSE_UP, 28.0, 35.0, 3.0, 4.0, (6.0, 9.0, 7.5)),
)
"""Views of the lamp over the belt, through both lenses; and views of the lamp between the belt and the standard
position, through the close-up lens only. Between belt and standard position, half as many views suffice, because the
views over the belt give most of the information.

The fingers reach 3.5 in below the lamp, and must stay clear of the base on the belt, which is 2.75 in high.
"""
