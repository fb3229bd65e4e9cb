"""A picture as the primitives read it, with a record of what they have read."""

import math
from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from handeye.core.pose import Array

Places = NDArray[np.intp]  # indices of points, line by line
MARGIN: Final = 1  # border points that no beam enters, so that it can be three points wide


class Scan:
    """A picture that beams go through, within a window; it counts beams and points, for times and for people."""

    def __init__(self, picture: NDArray[np.generic]) -> None:
        """`picture`: intensities, shape (rows, columns)."""
        self.image: NDArray[np.float32] = picture.astype(np.float32)
        self.rows, self.columns = picture.shape
        self._levels = memoryview(self.image.ravel().data)
        self.read: NDArray[np.bool_] = np.zeros(picture.shape, dtype=bool)
        self._read = self.read.ravel()
        self.beams = 0
        self.open()

    def __repr__(self) -> str:
        return f"<Scan of {self.rows} x {self.columns} points, {self.points} read>"

    @property
    def points(self) -> int:
        """Number of points read, each counted once."""
        return int(np.count_nonzero(self.read))

    def open(self) -> None:
        """Let beams go everywhere but on the margin."""
        low, high = MARGIN - 0.5, MARGIN + 0.5
        self.sides = np.array(
            [[1, 0, -low], [0, 1, -low], [-1, 0, self.columns - high], [0, -1, self.rows - high]], dtype=float
        )
        """A line for each side, shape (n, 3): inside, a*u + b*v + c is positive."""
        self._lines = self.sides.tolist()

    def limit(self, quadrilateral: Array) -> None:
        """Keep all beams within a convex quadrilateral, corners (u, v) in order, shape (4, 2)."""
        along = np.roll(quadrilateral, -1, axis=0) - quadrilateral
        normal = np.column_stack([-along[:, 1], along[:, 0]])
        offset = -(normal * quadrilateral).sum(axis=1)
        inwards = np.sign(normal @ quadrilateral.mean(axis=0) + offset)
        sides = np.column_stack([normal, offset]) * inwards[:, None]
        self.sides = np.vstack([self.sides, sides])
        self._lines = self.sides.tolist()

    def inside(self, places: Array) -> NDArray[np.bool_]:
        """Which of some places (u, v), shape (n, 2), lie within the window, shape (n,)."""
        return np.asarray((self._heights(places) > 0).all(axis=1))

    def runs(self, starts: Array, directions: Array) -> tuple[Array, Array]:
        """Lengths of rays back and ahead within the window, points, shape (n,) each."""
        heights, slopes = self._heights(starts), directions @ self.sides[:, :2].T
        back, ahead = np.full((2, *heights.shape), np.inf)
        np.divide(heights, -slopes, out=ahead, where=slopes < -1e-9)
        np.divide(heights, slopes, out=back, where=slopes > 1e-9)
        nearest = ahead.min(axis=1)
        nearest[(heights <= 0).any(axis=1)] = -np.inf
        return back.min(axis=1), nearest

    def run(self, u: int, v: int, du: int, dv: int) -> tuple[int, int]:
        """Lengths of one ray back and ahead, points; (0, -1) from a start outside the window."""
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
        """Signed distances of places to the window's sides, not normalised, shape (n, sides)."""
        return np.asarray(places @ self.sides[:, :2].T + self.sides[:, 2])

    def levels(self, places: Places) -> NDArray[np.float32]:
        """Intensities at points, clipped to the picture."""
        return self.image.take(places, mode="clip")

    def account(self, places: Places) -> None:
        """Record that points have been read."""
        self._read[places] = True

    def summed(self, starts: Sequence[int], length: int, stride: int) -> list[float]:
        """Intensities on parallel lines that begin at these points, summed across."""
        ends = [slice(start, start + length * stride, stride) for start in starts]
        lines: list[Any] = [self._levels[each].tolist() for each in ends]
        return lines[0] if len(lines) == 1 else [sum(across) for across in zip(*lines, strict=True)]

    def account_lines(self, starts: Sequence[int], length: int, stride: int) -> None:
        """Record that points of such lines have been read."""
        for start in starts:
            self._read[start : start + length * stride : stride] = True

    def patches(self, places: Array, radius: int, stride: int = 1) -> NDArray[np.float32]:
        """Squares of points about places (u, v), shape (n, side, side), clipped to the picture."""
        off = np.arange(-radius, radius + 1, stride)
        middle = np.rint(places).astype(np.intp)
        u = np.minimum(np.maximum(middle[:, 0, None] + off, 0), self.columns - 1)
        v = np.minimum(np.maximum(middle[:, 1, None] + off, 0), self.rows - 1)
        where = v[:, :, None] * self.columns + u[:, None, :]
        self.account(where)
        return self.levels(where)
