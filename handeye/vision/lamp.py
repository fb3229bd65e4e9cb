"""Finds the lamp on the hand: the bright spot in one of two pictures."""

from typing import Final

import cv2
import numpy as np

from handeye.ports.camera import Picture
from handeye.vision.alignment import aligned

LEVEL: Final = 3.0
"""Least mean difference over 3 x 3 points: six times its noise."""
RADIUS: Final = 10
"""Points about the peak that count to its centre: the lamp seen near, with the 50 mm lens."""


def find_spot(dark_picture: Picture, lit_picture: Picture) -> tuple[float, float] | None:
    """Centre (u, v) of the spot that only the lit picture has; None unless there is exactly one."""
    difference = lit_picture.astype(np.float32) - aligned(dark_picture, to=lit_picture)
    smooth = cv2.blur(difference, (3, 3))
    v, u = np.unravel_index(int(np.argmax(smooth)), smooth.shape)
    if smooth[v, u] < LEVEL:
        return None
    rows, columns = np.mgrid[0 : smooth.shape[0], 0 : smooth.shape[1]]
    near = np.hypot(rows - v, columns - u) <= RADIUS
    if (smooth[~near] > max(LEVEL, 0.7 * float(smooth[v, u]))).any():
        return None
    weight = np.where(near, np.clip(smooth - 0.3 * smooth[v, u], 0, None), 0)
    total = float(weight.sum())
    return float((weight * columns).sum()) / total, float((weight * rows).sum()) / total
