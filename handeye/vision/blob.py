"""The blob localiser: finds the box around a bright blob on a darker background."""

import math
from collections.abc import Callable, Iterator
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from handeye.core.pose import Array
from handeye.vision.beam import BRIGHTER, SPAN, beams
from handeye.vision.scan import MARGIN, Scan

COARSE: Final = 4  # the first beams are this many times farther apart: enough for blobs of the wanted size
SPACING: Final = 6  # points between beams from the window's border
LOOK_AHEAD: Final = 4  # points beyond a side of the box: crosses a dark wall between bright faces


class BoundingBox(NamedTuple):
    """A box in the picture: first and last column, first and last row, all inclusive."""

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

    def with_piece(self, other: "BoundingBox") -> "BoundingBox | None":
        """Return the box around this box and another. Returns None if the two cannot be pieces of one blob.

        A dark face, in the shade, may divide a lit blob into pieces. Two such pieces lie side by side. They are
        separated by no more than the length of the smaller piece, and the larger piece is most of the blob.
        """
        around = BoundingBox(
            *np.minimum(self[:2], other[:2]).tolist(), *np.maximum(self[2:], other[2:]).tolist()
        )
        larger, smaller = sorted((self, other), key=lambda box: box.width * box.height, reverse=True)
        apart = around.width - larger.width - smaller.width, around.height - larger.height - smaller.height
        most = 2 * larger.width * larger.height > around.width * around.height
        beside = min(apart) < 0 and max(apart) <= max(smaller.width, smaller.height)
        return around if most and beside else None

    def corners(self) -> Array:
        """Return the four corners (u, v) in order, shape (4, 2)."""
        left, top, right, bottom = self
        return np.array([[left, top], [right, top], [right, bottom], [left, bottom]], dtype=np.float64)

    def contains(self, u: float, v: float) -> bool:
        return self.left <= u <= self.right and self.top <= v <= self.bottom


def localise(
    scan: Scan,
    window: ArrayLike,
    step: float,
    fits: Callable[[BoundingBox], bool] = lambda box: True,
    tries: int = 12,
    *,
    whole: bool = True,
) -> BoundingBox | None:
    """Find a blob as `door.localise` does. The window remains set in `scan` after the call.

    If `whole` is False, a blob is also accepted if the window cuts it off or a shadow divides it in two.
    """
    window = np.asarray(window, dtype=float)
    scan.limit(window)
    sides = _inwards(scan, window)
    border = np.vstack([starts[::COARSE] for starts, _ in sides])
    if not len(border):
        return None
    background = np.sort(scan.patches(border, 1).mean(axis=(1, 2)))[len(border) // 2]
    threshold = float(background) + 0.75 * step
    reach = 0.6 * math.hypot(*(window.max(axis=0) - window.min(axis=0)))
    seen: list[BoundingBox] = []
    for starts, inwards in _coarse_first(sides):
        edges = beams(scan, starts, inwards, BRIGHTER, step, reach, wide=True)
        places = (edges.uv + SPAN * inwards)[edges.met]  # just behind the edges
        places = places[scan.inside(places)]
        bright = scan.patches(places, 1).mean(axis=(1, 2)) >= threshold  # more than a speck
        for u, v in places[bright].tolist():
            if any(box.contains(u, v) for box in seen):
                continue
            if len(seen) == tries:
                return None
            box = _grow(scan, round(u), round(v), threshold)
            if not (whole and _is_cut(scan, box, threshold)) and fits(box):
                return box
            if not whole:
                joined = filter(None, (box.with_piece(each) for each in seen))
                fitting = next(filter(fits, joined), None)
                if fitting is not None:
                    return fitting
            seen.append(box)
    return None


Rays = tuple[Array, Array]  # starts (u, v) and unit vectors (du, dv), (n, 2) each


def _inwards(scan: Scan, window: Array) -> list[Rays]:
    """Return rays across the window from each of its four sides."""
    sides = np.roll(window, -1, axis=0) - window
    lengths = [math.hypot(*side) for side in sides.tolist()]
    along = sides / np.array(lengths)[:, None]
    inwards = along[:, ::-1] * (-1, 1)
    inwards[((window.mean(axis=0) - window) * inwards).sum(axis=1) < 0] *= -1
    rays = []
    for corner, side, inward, length in zip(window, along, inwards, lengths, strict=True):
        starts = corner + np.arange(SPACING / 2, length, SPACING)[:, None] * side + inward * (SPAN + 1)
        rays.append((starts[scan.inside(np.rint(starts))], inward))
    return [(starts, np.broadcast_to(inward, starts.shape)) for starts, inward in rays]


def _coarse_first(sides: list[Rays]) -> Iterator[Rays]:
    """Yield rays from all sides: first a few from each side, then the rays between them."""
    for starts, inwards in sides:
        yield starts[COARSE // 2 :: COARSE], inwards[COARSE // 2 :: COARSE]
    for starts, inwards in sides:
        between = np.arange(len(starts)) % COARSE != COARSE // 2
        yield starts[between], inwards[between]


def _is_cut(scan: Scan, box: BoundingBox, threshold: float) -> bool:
    """Return True if a bright part of the box touches the border of the window."""
    v, u = np.mgrid[box.top : box.bottom + 1, box.left : box.right + 1]
    places = np.column_stack([u.ravel(), v.ravel()]).astype(float)
    border = places[scan.border(places, SPAN)]
    return bool((scan.patches(border, 1).mean(axis=(1, 2)) >= threshold).any())


def _grow(scan: Scan, u: int, v: int, threshold: float) -> BoundingBox:
    """Grow a box around a bright point. A side moves outwards as long as a line slightly farther out crosses the
    blob.
    """
    box = [u - SPAN, v - SPAN, u + SPAN, v + SPAN]  # left, top, right, bottom
    sides = [_Side(scan, side) for side in range(4)]
    while sum(side.moves(box, threshold) for side in sides):
        pass
    return BoundingBox(*box)


class _Side:
    """One side of a growing box. For each side, the picture is turned so that line numbers increase outwards."""

    def __init__(self, scan: Scan, side: int) -> None:
        """`side` is an index into a box: it selects the number that gives the place of this side."""
        self.number, self.upright, self.backwards = side, side % 2 == 0, side < 2
        self._clear: tuple[int, int, int] | None = None
        """Where the side lay when `moves` last looked beyond it: the line of the side, and the first and last place of
        the box on this line. `moves` does not look again from the same place.
        """
        self._image, self._read = self._turned(scan.image), self._turned(scan.read)
        across, along, offset = scan.sides.T
        self._window = list(zip(*self._turned_window(across, along, offset), strict=True))

    def moves(self, box: list[int], threshold: float) -> bool:
        """Look for lines that lie a little outside this side of the box and still cross the blob. If there are such
        lines, move the side to the line at which the blob ends. Returns False if there are none.
        """
        line = self._line(box[self.number])
        low, high = (box[1], box[3]) if self.upright else (box[0], box[2])
        if (line, low, high) == self._clear:
            return False
        self._clear = line, low, high
        last = min(line + LOOK_AHEAD, len(self._image) - 1 - MARGIN)
        low, high = self._in_window(line + 1, last, low, high)
        if last <= line or high - low < SPAN - 1:
            return False
        self._read[line : last + 2, low : high + 1] = True
        lines, places = (self._means(line + 1, last, low, high) > threshold).nonzero()
        if not len(lines):
            return False
        places = places[lines.searchsorted(lines[-1]) :]
        middle = low + SPAN // 2 + int(places[len(places) // 2])
        box[self.number] = self._line(self._end(line + 1 + int(lines[-1]), middle, threshold))
        return True

    def _turned(self, points: NDArray[Any]) -> NDArray[Any]:
        turned = points.T if self.upright else points
        return turned[::-1] if self.backwards else turned

    def _line(self, place: int) -> int:
        """Convert the number of a row or column of the picture to the line number of this side. The same conversion
        also leads back from a line number to a row or column.
        """
        return len(self._image) - 1 - place if self.backwards else place

    def _turned_window(
        self, u: Array, v: Array, offset: Array
    ) -> tuple[list[float], list[float], list[float]]:
        """Convert the window to the coordinates of this object. Returns three lists, each with one number per side of
        the window. The first list has the increments per line outwards, the second the increments per point along the
        line, and the third the offsets.
        """
        outwards, along = (u, v) if self.upright else (v, u)
        if self.backwards:
            offset, outwards = offset + outwards * (len(self._image) - 1), -outwards
        return outwards.tolist(), along.tolist(), offset.tolist()

    def _in_window(self, first: int, last: int, low: int, high: int) -> tuple[int, int]:
        """Return the part of the range `low` to `high` that lies within the window on all lines from `first` to
        `last`.
        """
        for outwards, along, offset in self._window:
            least = offset + outwards * (last if outwards < 0 else first)
            if along > 0:
                low = max(low, math.ceil(-least / along))
            elif along < 0:
                high = min(high, math.floor(-least / along))
            elif least <= 0:
                high = low - 1
        return low, high

    def _means(self, first: int, last: int, low: int, high: int) -> NDArray[np.float32]:
        """Return the mean intensities of squares, shape (lines, places). Each square is SPAN points wide, and the
        middle of the square is on one of the lines `first` to `last`.
        """
        slab = self._image[first - 1 : last + 2, low : high + 1]
        wide = slab[:-2] + slab[1:-1]
        wide += slab[2:]
        means: NDArray[np.float32] = wide[:, :-2] + wide[:, 1:-1]
        means += wide[:, 2:]
        means /= SPAN**2
        return means

    def _end(self, line: int, middle: int, threshold: float) -> int:
        """Go straight outwards from a line that crosses the blob, and return the last bright line."""
        far = len(self._image) - 1 - MARGIN
        for outwards, along, offset in self._window:
            if outwards < 0:
                far = min(far, math.floor((offset + along * middle) / -outwards))
        if far <= line:
            return line
        dark, _ = (self._means(line + 1, far, middle - 1, middle + 1) <= threshold).nonzero()
        end = line + int(dark[0]) if len(dark) else far
        self._read[line : end + 3, middle - 1 : middle + 2] = True
        return end
