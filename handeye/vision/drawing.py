"""Draws marks on a picture."""

from collections.abc import Sequence
from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from handeye.ports.camera import Picture
from handeye.vision.marks import Disc, Line, Loop, Mark, Point

Image = NDArray[np.uint8]  # blue, green, red, (height, width, 3)

SCALE: Final = 3
MAX_COORDINATE: Final = 10_000.0  # limit on coordinates of marks, in picture points


def annotate(picture: Picture, marks: Sequence[Mark], scale: int = SCALE) -> Image:
    """Enlarge a picture and draw marks into it. Raises ValueError if a mark is too far outside the picture."""
    grey = np.clip(picture * 17, 0, 255).astype(np.uint8)
    large = np.repeat(np.repeat(grey, scale, axis=0), scale, axis=1)
    image: Image = np.repeat(large[:, :, None], 3, axis=2)
    for mark in marks:
        _draw(image, mark, scale)
    return image


def _draw(image: Image, mark: Mark, scale: int) -> None:
    colour = mark.colour[::-1]
    match mark:
        case Loop():
            corners = np.array([_pixel(point, scale) for point in mark.points])
            cv2.polylines(image, [corners], True, colour, max(1, round(mark.width * scale)))
        case Line():
            one, other = (_pixel(point, scale) for point in mark.ends)
            cv2.line(image, one, other, colour, max(1, round(mark.width * scale)), cv2.LINE_AA)
        case Disc():
            cv2.circle(image, _pixel(mark.centre, scale), round(mark.diameter * scale / 2), colour, -1)


def _pixel(point: Point, scale: int) -> tuple[int, int]:
    """Return the pixel that shows the centre of a picture point in the enlarged picture."""
    u, v = point
    if not max(abs(u), abs(v)) <= MAX_COORDINATE:
        raise ValueError(f"a mark at ({u:g}, {v:g}) is too far outside the picture")
    return round((u + 0.5) * scale), round((v + 0.5) * scale)
