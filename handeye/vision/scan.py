"""A picture as the primitives read it, with a record of the points that were read."""

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from handeye.core.errors import BadArgument
from handeye.core.pose import Array

Places = NDArray[np.intp]  # indices of points, line by line
_FARTHEST: Final = 1e6  # points
MARGIN: Final = 1  # border points that no beam enters, so that a beam can be three points wide


def numbers(given: object, said: str) -> Array:
    """Convert an argument to an array of finite numbers. If the argument cannot be converted, raises BadArgument with
    a message that begins with `said`.
    """
    try:
        found = np.asarray(given)
        sound = found.dtype.kind in "uif" and bool(np.isfinite(found).all())
    except (TypeError, ValueError):  # rows of different lengths, values that are no arrays
        sound = False
    if not sound:
        raise BadArgument(f"{said}, in finite numbers, not {' '.join(repr(given).split()):.60}")
    return found.astype(np.float64)


def places(given: object, said: str) -> Array:
    """Convert an argument to finite positions (in picture points) in or near the picture. Raises BadArgument if that
    is impossible.
    """
    found = numbers(given, said)
    if (np.abs(found) > _FARTHEST).any():
        raise BadArgument(f"{said}, at most {_FARTHEST:g} pixels from the picture")
    return found


def quadrilateral(given: object) -> Array:
    """Convert an argument to the corners (u, v) of a convex quadrilateral, shape (4, 2). Raises BadArgument if the
    argument is no such quadrilateral.
    """
    said = "a window must have four corners (u, v) in order, shape (4, 2)"
    found = places(given, said)
    if found.shape != (4, 2):
        raise BadArgument(f"{said}, not {found.shape}")
    (du, dv), (eu, ev) = (np.roll(found, -k, axis=0).T - np.roll(found, 1 - k, axis=0).T for k in (1, 2))
    turns = du * ev - dv * eu
    if not ((turns > 0).all() or (turns < 0).all()):
        corners = ", ".join(f"({u:g}, {v:g})" for u, v in found.tolist())
        raise BadArgument(
            f"the corners of a window must be in order around a convex quadrilateral, but the corners {corners} are "
            "not"
        )
    return found


def _intensities(picture: object) -> NDArray[np.float32]:
    """Convert an argument to the intensities of a picture. Raises BadArgument if that is impossible."""
    if not isinstance(picture, np.ndarray):
        raise BadArgument(
            f"a picture must be an array of intensities, shape (rows, columns), not {type(picture).__name__}"
        )
    if picture.ndim != 2 or not picture.size:
        hint = "; convert it to grey levels" if picture.ndim == 3 else ""
        raise BadArgument(
            f"a picture must have rows and columns of pixels, but the given picture has shape {picture.shape}{hint}"
        )
    if picture.dtype.kind not in "buif":
        raise BadArgument(f"the pixels of a picture must be numbers, not of type {picture.dtype}")
    with np.errstate(over="ignore"):
        found: NDArray[np.float32] = np.asarray(picture).astype(np.float32)
    if not np.isfinite(found).all():
        raise BadArgument("the picture has pixels that are not finite numbers")
    return found


class Scan:
    """A picture in which beams (straight rays) search for edges, within a window. The scan counts its beams, and the
    points that these beams read, for timing and display.
    """

    def __init__(self, picture: NDArray[np.generic]) -> None:
        """`picture` holds intensities, shape (rows, columns). Raises BadArgument if `picture` is anything else."""
        self.image: NDArray[np.float32] = _intensities(picture)
        self.rows, self.columns = self.image.shape
        self._levels = memoryview(self.image.ravel().data)
        self.read: NDArray[np.bool_] = np.zeros(self.image.shape, dtype=bool)
        self._read = self.read.ravel()
        self.beams = 0
        self.open()

    def __repr__(self) -> str:
        return f"<Scan of {self.rows} x {self.columns} points, {self.points} read>"

    @property
    def points(self) -> int:
        """Number of points read; each point counts once."""
        return int(np.count_nonzero(self.read))

    def open(self) -> None:
        """Remove the window. After this call, beams may go everywhere in the picture except on its outermost points."""
        low, high = MARGIN - 0.5, MARGIN + 0.5
        self._look_within(
            np.array(
                [[1, 0, -low], [0, 1, -low], [-1, 0, self.columns - high], [0, -1, self.rows - high]],
                dtype=float,
            )
        )

    def limit(self, corners: ArrayLike) -> None:
        """Set the window, a convex quadrilateral that limits all beams. The new window replaces the previous window.
        Raises BadArgument if `corners` form no such quadrilateral.

        `corners` are the positions (u, v) of the corners, in picture points, in order around the window, shape (4, 2).
        """
        found = quadrilateral(corners)
        along = np.roll(found, -1, axis=0) - found
        normal = np.column_stack([-along[:, 1], along[:, 0]])
        offset = -(normal * found).sum(axis=1)
        inwards = np.sign(normal @ found.mean(axis=0) + offset)
        self.open()
        self._look_within(np.vstack([self.sides, np.column_stack([normal, offset]) * inwards[:, None]]))

    @contextmanager
    def within(self, corners: ArrayLike) -> Iterator[None]:
        """Limit beams to a convex quadrilateral while the context is open, and then restore the previous window."""
        before = self.sides
        self.limit(corners)
        try:
            yield
        finally:
            self._look_within(before)

    def _look_within(self, sides: Array) -> None:
        self.sides = sides
        """The sides of the window, one per row, shape (n, 3). Inside the window, a*u + b*v + c is positive for
        every side.
        """
        self._lines = sides.tolist()

    def inside(self, places: Array) -> NDArray[np.bool_]:
        """Return a mask, shape (n,), of the places (u, v), shape (n, 2), that lie within the window."""
        return np.asarray((self._heights(places) > 0).all(axis=1))

    def border(self, places: Array, width: float) -> NDArray[np.bool_]:
        """Return a mask, shape (n,), of the places (u, v), shape (n, 2), that lie within the window and less than
        `width` (points) from its border.
        """
        away = self._heights(places) / np.hypot(*self.sides[:, :2].T)
        nearest = away.min(axis=1)
        return np.asarray((nearest > 0) & (nearest < width))

    def runs(self, starts: Array, directions: Array) -> tuple[Array, Array]:
        """Return how far each ray can go within the window, in picture points. The first array, shape (n,), has the
        distances backwards from the starts, and the second array the distances forwards.
        """
        heights, slopes = self._heights(starts), directions @ self.sides[:, :2].T
        back, ahead = np.full((2, *heights.shape), np.inf)
        np.divide(heights, -slopes, out=ahead, where=slopes < -1e-9)
        np.divide(heights, slopes, out=back, where=slopes > 1e-9)
        nearest = ahead.min(axis=1)
        nearest[(heights <= 0).any(axis=1)] = -np.inf
        return back.min(axis=1), nearest

    def run(self, u: int, v: int, du: int, dv: int) -> tuple[int, int]:
        """Return two lengths (points): how far a ray can extend backwards and forwards from its start within the
        window. Returns (0, -1) if the start of the ray is outside the window.
        """
        back = ahead = math.inf
        for a, b, c in self._lines:
            height, slope = a * u + b * v + c, a * du + b * dv
            if height <= 0:
                return 0, -1
            if slope > 0:
                back = min(back, height / slope)
            elif slope < 0:
                ahead = min(ahead, -height / slope)
        return math.floor(back), math.floor(ahead)

    def _heights(self, places: Array) -> Array:
        """Return the signed distances of places from the sides of the window, shape (n, sides). Each distance is
        multiplied by the length of the side's normal vector.
        """
        return np.asarray(places @ self.sides[:, :2].T + self.sides[:, 2])

    def levels(self, places: Places) -> NDArray[np.float32]:
        """Return the intensities at places, which are given by their indices in the picture. For a place outside the
        picture, the nearest place in the picture is used.
        """
        return self.image.take(places, mode="clip")

    def account(self, places: Places) -> None:
        """Record that points have been read."""
        self._read[places] = True

    def summed(self, starts: Sequence[int], length: int, stride: int) -> list[float]:
        """Return `length` values: for each index along parallel lines that begin at `starts`, the sum of the
        intensities of all lines at this index.
        """
        ends = [slice(start, start + length * stride, stride) for start in starts]
        lines: list[Any] = [self._levels[each].tolist() for each in ends]
        return lines[0] if len(lines) == 1 else [sum(across) for across in zip(*lines, strict=True)]

    def account_lines(self, starts: Sequence[int], length: int, stride: int) -> None:
        """Record that the points of the given lines have been read. The arguments are the same as for `summed`."""
        for start in starts:
            self._read[start : start + length * stride : stride] = True

    def patches(self, places: Array, radius: int, stride: int = 1) -> NDArray[np.float32]:
        """Return squares of points about places (u, v), shape (n, side, side), clipped to the picture."""
        off = np.arange(-radius, radius + 1, stride)
        middle = np.rint(places).astype(np.intp)
        u = np.minimum(np.maximum(middle[:, 0, None] + off, 0), self.columns - 1)
        v = np.minimum(np.maximum(middle[:, 1, None] + off, 0), self.rows - 1)
        where = v[:, :, None] * self.columns + u[:, None, :]
        self.account(where)
        return self.levels(where)
