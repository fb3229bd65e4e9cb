"""Aligns two pictures that have the same view, and finds a lamp that is lit in only one of them.

A vidicon displaces each picture slightly. If two pictures are not aligned, their difference shows a trace of every
edge, as in the picture differences of the paper. Alignment is our addition.
"""

from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from handeye.core.pose import Array
from handeye.ports.camera import Picture

MAX_SHIFT: Final = 4  # points, both along and across the lines
CHANGED: Final = 3.0
"""If a point differs between the two pictures by this number of grey levels, it counts as fully changed. Greater
differences are replaced by this value.
"""
AREA: Final = 11  # side of a square, points
QUIET: Final = 1.2  # levels; a square with a smaller mean difference has not changed
CLEAR: Final = 15  # side, points, of a square that must be free of changes and of soft shadow edges
BLUR: Final = 1.0  # sigma, points: against noise, and to give edges a slope that shows a shift
STEPS: Final = 5
MARGIN: Final = MAX_SHIFT + 2  # points at the border, which one picture may lack

Levels = NDArray[np.float32]  # interpolated intensities, (256, 333)
Points = NDArray[np.bool_]  # mask, (256, 333)


def aligned(picture: Picture, to: Picture) -> Levels:
    """Shift a picture so that its unchanged parts coincide with those of another picture, `to`. Where the shifted
    picture would have no points, the points on its border are repeated.
    """
    return moved(picture.astype(np.float32), -shift(to, picture))


def shift(first: Picture, second: Picture, where: Points | None = None) -> Array:
    """Measure the shift of the second picture relative to the first: (columns, rows), shape (2,). Both pictures have
    the same view.

    The function first finds the shift, in whole points, at which most points agree. It then computes the remaining
    fraction of a point from the gradients of intensity where the pictures agree. A point of the first picture counts
    only if it is in the mask `where`; without a mask, all points count.
    """
    a, b = smooth(first), smooth(second)
    reach = range(-MAX_SHIFT, MAX_SHIFT + 1)
    rough = min(((u, v) for v in reach for u in reach), key=lambda uv: _disagreement(a, b, where, *uv))
    offset = np.array(rough, dtype=float)
    for _ in range(STEPS):
        offset = offset + _step(a, moved(b, -offset), where)
    return offset


def changed(a: Levels, b: Levels) -> Points:
    """Return a mask of the points around which two smoothed pictures differ by more than noise."""
    return np.asarray(cv2.blur(np.abs(b - a), (AREA, AREA)) > QUIET)


def smooth(picture: Picture | Levels) -> Levels:
    """Smooth a picture to reduce its noise."""
    return cv2.GaussianBlur(picture.astype(np.float32), (0, 0), BLUR).astype(np.float32)


def _disagreement(a: Levels, b: Levels, where: Points | None, u: int, v: int) -> float:
    """Shift the second picture back by (u, v), and return the mean difference of the two pictures. The difference is
    capped at each point. Only every second point is compared, because the pictures are smoothed. For `where` see
    `shift`.
    """
    rows, columns = a.shape
    here = a[MARGIN : rows - MARGIN : 2, MARGIN : columns - MARGIN : 2]
    there = b[MARGIN + v : rows - MARGIN + v : 2, MARGIN + u : columns - MARGIN + u : 2]
    off = there - here
    np.minimum(np.abs(off, out=off), CHANGED, out=off)
    these = slice(None) if where is None else where[MARGIN : rows - MARGIN : 2, MARGIN : columns - MARGIN : 2]
    return float(off[these].mean())


def _step(a: Levels, b: Levels, where: Points | None) -> Array:
    """Estimate the remaining shift of the second picture in fractions of a point, shape (2,), from the gradients of
    intensity where the pictures agree. For `where` see `shift`.
    """
    inside = np.s_[MARGIN:-MARGIN, MARGIN:-MARGIN]
    near = cv2.dilate(changed(a, b).astype(np.uint8), np.ones((CLEAR, CLEAR), np.uint8))
    same = near[inside] == 0
    if where is not None:
        same &= where[inside]
    mean = ((a + b) / 2)[MARGIN - 1 : 1 - MARGIN, MARGIN - 1 : 1 - MARGIN]
    across, down = mean[1:-1, 2:] - mean[1:-1, :-2], mean[2:, 1:-1] - mean[:-2, 1:-1]
    slope = np.stack([across[same], down[same]]) / 2
    off = (a - b)[inside][same]
    step, *_ = np.linalg.lstsq(slope @ slope.T, slope @ off, rcond=None)  # zero, if no part is unchanged
    return np.asarray(step, dtype=float)


def moved(picture: Levels, by: Array) -> Levels:
    """Shift a picture by (columns, rows)."""
    matrix = np.array([[1.0, 0.0, by[0]], [0.0, 1.0, by[1]]])
    rows, columns = picture.shape
    return np.asarray(
        cv2.warpAffine(
            picture, matrix, (columns, rows), flags=cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE
        )
    )


LEVEL: Final = 3.0  # least mean difference over 3 x 3 points: six times its noise
RADIUS: Final = 10  # points; the centre is computed within this radius, that of a near lamp in the 50 mm lens


def find_spot(dark_picture: Picture, lit_picture: Picture) -> tuple[float, float] | None:
    """Find the bright spot that the lit picture has and the dark picture lacks. Returns the centre (u, v) of the spot,
    or None if there is no such spot, or more than one.
    """
    difference = lit_picture.astype(np.float32) - aligned(dark_picture, to=lit_picture)
    smooth = cv2.blur(difference, (3, 3))
    v, u = np.unravel_index(int(np.argmax(smooth)), smooth.shape)
    if smooth[v, u] < LEVEL:
        return None
    rows, columns = np.ogrid[0 : smooth.shape[0], 0 : smooth.shape[1]]
    near = (rows - v) ** 2 + (columns - u) ** 2 <= RADIUS**2
    if (smooth[~near] > max(LEVEL, 0.7 * float(smooth[v, u]))).any():
        return None
    weight = np.where(near, np.clip(smooth - 0.3 * smooth[v, u], 0, None), 0)
    total = float(weight.sum())
    return float((weight * columns).sum()) / total, float((weight * rows).sum()) / total
