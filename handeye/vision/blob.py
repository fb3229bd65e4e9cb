"""The blob localiser: isolates a bright blob on a darker background by surrounding it with a box."""

import math
from collections.abc import Callable, Iterator
from typing import Final, NamedTuple

import numpy as np

from handeye.pose import Array
from handeye.vision.beam import BRIGHTER, SPAN, Scan, beam

SPACING: Final = 6
"""Points between the beams sent inwards from the border of the window."""
LOOK_AHEAD: Final = 4
"""Points a side of the box looks outwards, so that a dark wall between two bright faces does not stop it."""


class BoundingBox(NamedTuple):
    """Columns and rows, all four inside the box."""

    left: int
    top: int
    right: int
    bottom: int

    @property
    def width(self) -> int:
        return self.right - self.left + 1

    @property
    def height(self) -> int:
        return self.bottom - self.top + 1

    def corners(self) -> Array:
        """The four corners (u, v) in order, shape (4, 2)."""
        left, top, right, bottom = self
        return np.array([[left, top], [right, top], [right, bottom], [left, bottom]], dtype=np.float64)

    def contains(self, u: float, v: float) -> bool:
        return self.left <= u <= self.right and self.top <= v <= self.bottom


def localise(
    scan: Scan,
    window: Array,
    step: float,
    fits: Callable[[BoundingBox], bool] = lambda box: True,
    tries: int = 12,
) -> BoundingBox | None:
    """The box around the first blob that fits, or None.

    Beams go inwards from the four sides of the window until one meets something brighter that is more than
    a speck; a box grows from there until all its sides see background only.

    Args:
        window: convex quadrilateral, corners (u, v) in order, shape (4, 2); its border lies on background.
        step: least difference of intensity between blob and background.
        fits: whether a box is what is looked for; a box that is not is not looked at again.
        tries: most boxes to grow.
    """
    scan.limit(window)
    starts = [ray for ray in _inward(window) if _inside(scan, ray[0])]
    if not starts:
        return None
    background = float(np.median([scan.patch(*start, 1).mean() for start, _ in starts]))
    reach = 0.6 * math.hypot(*(window.max(axis=0) - window.min(axis=0)))
    seen: list[BoundingBox] = []
    for start, (du, dv) in starts:
        edge = beam(scan, start, (du, dv), BRIGHTER, step, reach, wide=True)
        if edge is None or len(seen) == tries:
            continue
        u, v = edge.u + SPAN * du, edge.v + SPAN * dv
        if any(box.contains(u, v) for box in seen) or not _inside(scan, (u, v)):
            continue
        if scan.patch(u, v, 1).mean() < background + 0.75 * step:
            continue  # a speck
        box = _grow(scan, round(u), round(v), background + 0.75 * step)
        if fits(box):
            return box
        seen.append(box)
    return None


def _inward(window: Array) -> Iterator[tuple[tuple[float, float], tuple[float, float]]]:
    middle = window.mean(axis=0)
    for side in range(4):
        a, b = window[side], window[(side + 1) % 4]
        along = (b - a) / np.linalg.norm(b - a)
        normal = np.array([-along[1], along[0]])
        if (middle - a) @ normal < 0:
            normal = -normal
        for distance in np.arange(SPACING / 2, float(np.linalg.norm(b - a)), SPACING):
            start = a + along * distance + normal * (SPAN + 1)
            yield (float(start[0]), float(start[1])), (float(normal[0]), float(normal[1]))


def _inside(scan: Scan, place: tuple[float, float]) -> bool:
    u, v = round(place[0]), round(place[1])
    rows, columns = scan.window.shape
    return 0 <= u < columns and 0 <= v < rows and bool(scan.window[v, u])


def _grow(scan: Scan, u: int, v: int, threshold: float) -> BoundingBox:
    """A side moves outwards as long as a line a little further out still crosses the blob."""
    rows, columns = scan.image.shape
    box = [u - SPAN, v - SPAN, u + SPAN, v + SPAN]  # left, top, right, bottom
    limits = (1, 1, columns - 2, rows - 2)
    growing = True
    while growing:
        growing = False
        for side, outwards in enumerate((-1, -1, 1, 1)):
            for ahead in range(LOOK_AHEAD, 0, -1):
                place = box[side] + outwards * ahead
                if (limits[side] - place) * outwards >= 0 and _crosses(scan, box, side, place, threshold):
                    box[side] = place
                    growing = True
                    break
    return BoundingBox(left=box[0], top=box[1], right=box[2], bottom=box[3])


def _crosses(scan: Scan, box: list[int], side: int, place: int, threshold: float) -> bool:
    """True if a line beside the box meets SPAN points in a row brighter, on average, than the threshold."""
    rows, columns = scan.image.shape
    along = side % 2 == 0  # the left and right sides are columns
    lo, hi = (box[1], box[3]) if along else (box[0], box[2])
    run = np.arange(max(lo, 1), min(hi, (rows if along else columns) - 2) + 1)
    fixed = np.full_like(run, place)
    u, v = (fixed, run) if along else (run, fixed)
    usable = scan.window[v, u]
    if np.count_nonzero(usable) < SPAN:
        return False
    line = scan.levels(u[usable], v[usable], (1, 0) if along else (0, 1))
    return bool((np.convolve(line, np.ones(SPAN) / SPAN, mode="valid") > threshold).any())
