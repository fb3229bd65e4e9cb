"""Aligning two pictures of one view: a vidicon does not put every picture in quite the same place.

An addition of ours: in the differences of the paper a slight shift of the picture leaves something of every edge.
"""

from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from handeye.core.pose import Array
from handeye.ports.camera import Picture

FARTHEST: Final = 4
"""Points along the lines and across that a picture is looked for."""
CHANGED: Final = 3.0
"""Levels: of two points that differ by more no more is said than that something has changed."""
AREA: Final = 11
QUIET: Final = 1.2
"""Points a side of a square, and the mean difference in it, levels, up to which nothing in it has changed."""
CLEAR: Final = 15
"""Points a side of a square that keeps clear of what has changed, and of its shadow's soft edge."""
BLUR: Final = 1.0
"""Sigma, points, against noise. Also makes edges wide enough for a shift to be read from their slope."""
STEPS: Final = 5
MARGIN: Final = FARTHEST + 2
"""Points at the border that are left out: what is there in one picture may not be in the other."""

Levels = NDArray[np.float32]
"""Intensities between those of a picture, shape (256, 333)."""
Points = NDArray[np.bool_]
"""Which points of a picture, shape (256, 333)."""


def aligned(picture: Picture, to: Picture) -> Levels:
    """A picture moved so that what has not changed lies as in the other; its border is drawn out."""
    return moved(picture.astype(np.float32), -shift(to, picture))


def shift(first: Picture, second: Picture, where: Points | None = None) -> Array:
    """How far (columns, rows), shape (2,), the second of two pictures of one view lies from the first.

    First by whole points, by the agreement of most; then, from the slopes of what agrees, by parts of a point.

    Args:
        where: points of the first picture by which it is told; by default all.
    """
    a, b = smooth(first), smooth(second)
    counts = np.ones(first.shape, dtype=np.bool_) if where is None else where
    reach = range(-FARTHEST, FARTHEST + 1)
    rough = min(((u, v) for v in reach for u in reach), key=lambda uv: _disagreement(a, b, counts, *uv))
    found = np.array(rough, dtype=float)
    for _ in range(STEPS):
        found = found + _step(a, moved(b, -found), counts)
    return found


def changed(a: Levels, b: Levels) -> Points:
    """Points around which two smoothed pictures differ by more than noise makes them differ."""
    return np.asarray(cv2.blur(np.abs(b - a), (AREA, AREA)) > QUIET)


def smooth(picture: Picture) -> Levels:
    """The picture with most of its noise gone."""
    return cv2.GaussianBlur(picture.astype(np.float32), (0, 0), BLUR).astype(np.float32)


def _disagreement(a: Levels, b: Levels, counts: Points, u: int, v: int) -> float:
    """Mean difference when the second is moved back by whole points, with no more said by what has changed.

    Of every other point on every other line: the blur has spread each over its neighbours.
    """
    rows, columns = a.shape
    here = a[MARGIN : rows - MARGIN : 2, MARGIN : columns - MARGIN : 2]
    there = b[MARGIN + v : rows - MARGIN + v : 2, MARGIN + u : columns - MARGIN + u : 2]
    these = counts[MARGIN : rows - MARGIN : 2, MARGIN : columns - MARGIN : 2]
    return float(np.minimum(np.abs(there - here), CHANGED)[these].mean())


def _step(a: Levels, b: Levels, counts: Points) -> Array:
    """By how much the second still lies off, from the slopes of both where they agree, shape (2,)."""
    mean = (a + b) / 2
    inside = np.s_[MARGIN:-MARGIN, MARGIN:-MARGIN]
    near = cv2.dilate(changed(a, b).astype(np.uint8), np.ones((CLEAR, CLEAR), np.uint8))
    same = ((near == 0) & counts)[inside]
    slope = np.stack([np.gradient(mean, axis=axis)[inside][same] for axis in (1, 0)])
    off = (a - b)[inside][same]
    step, *_ = np.linalg.lstsq(slope @ slope.T, slope @ off, rcond=None)  # none, if nothing is the same
    return np.asarray(step, dtype=float)


def moved(picture: Levels, by: Array) -> Levels:
    """The picture with everything in it (columns, rows) farther."""
    matrix = np.array([[1.0, 0.0, by[0]], [0.0, 1.0, by[1]]])
    rows, columns = picture.shape
    return np.asarray(
        cv2.warpAffine(
            picture, matrix, (columns, rows), flags=cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE
        )
    )
