"""Overlays for people: what the primitives found, drawn on the picture they found it in."""

from collections.abc import Sequence
from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from handeye.ports.camera import Picture
from handeye.vision.base import GeneralLocation, SpecificLocation
from handeye.vision.gasket import GasketInspection

Image = NDArray[np.uint8]
"""Blue, green, red of every pixel, shape (height, width, 3)."""

WHITE: Final = (255, 255, 255)
RED: Final = (40, 40, 235)
YELLOW: Final = (0, 220, 240)
GREEN: Final = (90, 200, 60)
SCALE: Final = 3


def annotate(
    picture: Picture,
    *,
    general: GeneralLocation | None = None,
    specific: SpecificLocation | None = None,
    inspection: GasketInspection | None = None,
    spots: Sequence[tuple[float, float]] = (),
    scale: int = SCALE,
) -> Image:
    """The picture, enlarged, with what was found in it.

    The box of general location is white; holes have a red crosshair and a yellow box, with the line of
    centres between them; expected centres of a gasket are red crosses, found ones dots, green if it is right.
    """
    grey = np.clip(picture * 17, 0, 255).astype(np.uint8)
    large = np.repeat(np.repeat(grey, scale, axis=0), scale, axis=1)
    image: Image = np.repeat(large[:, :, None], 3, axis=2)
    if general:
        left, top, right, bottom = general.box
        cv2.rectangle(image, _at(left, top, scale), _at(right, bottom, scale), WHITE, 2)
    if specific:
        _draw_specific(image, specific, scale)
    if inspection:
        for u, v in inspection.expected:
            _cross(image, u, v, scale)
        for found in inspection.found:
            if found:
                cv2.circle(image, _at(*found, scale), 2 * scale, GREEN if inspection.ok else RED, -1)
    for u, v in spots:
        cv2.circle(image, _at(u, v, scale), 4 * scale, YELLOW, 1, cv2.LINE_AA)
    return image


def _draw_specific(image: Image, specific: SpecificLocation, scale: int) -> None:
    first, second = specific.holes
    cv2.line(image, _at(first.u, first.v, scale), _at(second.u, second.v, scale), RED, 1, cv2.LINE_AA)
    for hole in specific.holes:
        u, v, w, h = hole.u, hole.v, hole.width / 2, hole.height / 2
        cv2.rectangle(image, _at(u - w, v - h, scale), _at(u + w, v + h, scale), YELLOW, 1)
        _cross(image, u, v, scale)


def _cross(image: Image, u: float, v: float, scale: int) -> None:
    cv2.drawMarker(image, _at(u, v, scale), RED, cv2.MARKER_CROSS, 8 * scale, 2)


def _at(u: float, v: float, scale: int) -> tuple[int, int]:
    """The pixel of a picture point; the middle of a point is not its corner."""
    return round((u + 0.5) * scale), round((v + 0.5) * scale)
