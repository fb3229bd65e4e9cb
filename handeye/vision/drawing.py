"""Overlays for people: marks drawn on the picture that they belong to."""

from collections.abc import Sequence
from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from handeye.ports.camera import Picture
from handeye.vision.marks import Disc, Line, Loop, Mark, Point

Image = NDArray[np.uint8]
"""Blue, green, red of every pixel, shape (height, width, 3)."""

SCALE: Final = 3
FARTHEST: Final = 10_000.0
"""Picture points from the middle of the first one within which a mark is drawn, or cut off by the picture's edge."""


def annotate(picture: Picture, marks: Sequence[Mark], scale: int = SCALE) -> Image:
    """The picture, enlarged, with marks on it.

    Raises:
        ValueError: a mark is farther from the picture than anything that was found in it.
    """
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
    """The pixel of a picture point; the middle of a point is not its corner."""
    u, v = point
    if not max(abs(u), abs(v)) <= FARTHEST:
        raise ValueError(f"a mark at ({u:g}, {v:g}) belongs to no picture")
    return round((u + 0.5) * scale), round((v + 0.5) * scale)
