"""The beam: the first discontinuity along a ray through the picture. Every other primitive is made of it."""

from typing import Final, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from handeye.pose import Array

SPAN: Final = 3
"""Points averaged on either side of a discontinuity: means of 2 are too noisy at one level of noise."""

BRIGHTER: Final = 1
DARKER: Final = -1
Polarity = Literal[1, -1]


class Edge(NamedTuple):
    """A discontinuity met by a beam."""

    u: float
    v: float
    before: float
    """Intensity on the side the beam came from."""
    after: float
    length: float
    """Points from the start of the beam."""


class Scan:
    """A picture as the primitives read it; it keeps account of what they read, for times and for people."""

    def __init__(self, picture: NDArray[np.generic]) -> None:
        """`picture`: intensities, shape (rows, columns)."""
        self.image: NDArray[np.float32] = picture.astype(np.float32)
        self.read: NDArray[np.bool_] = np.zeros(picture.shape, dtype=bool)
        self.beams = 0
        self.window: NDArray[np.bool_] = np.zeros(picture.shape, dtype=bool)
        """Where beams may go; a margin of one point is never read, so that beams can be three points wide."""
        self.open()

    def open(self) -> None:
        """Let beams go everywhere."""
        self.window[1:-1, 1:-1] = True

    def limit(self, quadrilateral: Array) -> None:
        """Keep all beams within a convex quadrilateral, corners (u, v) in order, shape (4, 2)."""
        rows, columns = self.image.shape
        v, u = np.mgrid[0:rows, 0:columns]
        sides = np.stack(
            [
                (b[0] - a[0]) * (v - a[1]) - (b[1] - a[1]) * (u - a[0])
                for a, b in zip(quadrilateral, np.roll(quadrilateral, -1, axis=0), strict=True)
            ]
        )
        self.window &= np.all(sides >= 0, axis=0) | np.all(sides <= 0, axis=0)

    def levels(self, u: NDArray[np.intp], v: NDArray[np.intp], across: tuple[int, int] | None) -> Array:
        """Intensities at points; averaged over three points in the direction `across`, if given."""
        self.read[v, u] = True
        if across is None:
            return np.asarray(self.image[v, u], dtype=np.float64)
        a, b = across
        return np.asarray(
            (self.image[v - b, u - a] + self.image[v, u] + self.image[v + b, u + a]) / 3, dtype=np.float64
        )

    def patch(self, u: float, v: float, radius: int) -> Array:
        """The square of points about a place, cut off at the edge of the picture."""
        column, row = round(u), round(v)
        where = np.s_[max(row - radius, 0) : row + radius + 1, max(column - radius, 0) : column + radius + 1]
        self.read[where] = True
        return np.asarray(self.image[where], dtype=np.float64)


def beam(
    scan: Scan,
    start: tuple[float, float],
    direction: tuple[float, float],
    polarity: Polarity,
    step: float,
    reach: float,
    *,
    wide: bool = False,
    beyond: float = 0.0,
) -> Edge | None:
    """The first discontinuity along a ray, or None.

    Args:
        start: (u, v).
        direction: unit vector (du, dv).
        polarity: BRIGHTER: dark to bright; DARKER: bright to dark.
        step: least difference of intensity between SPAN points ahead and SPAN points behind.
        reach: greatest length, points.
        wide: average over three points across, against noise.
        beyond: least intensity behind the discontinuity; those that lead to less are passed over.
    """
    scan.beams += 1
    (u0, v0), (du, dv) = start, direction
    k = np.arange(1 - SPAN, int(reach) + SPAN)
    u, v = np.rint(u0 + k * du).astype(np.intp), np.rint(v0 + k * dv).astype(np.intp)
    lo, hi = _usable(scan, u, v)
    if hi - lo < 2 * SPAN:
        return None
    across = (0, 1) if abs(du) >= abs(dv) else (1, 0)
    line = scan.levels(u[lo:hi], v[lo:hi], across if wide else None)
    mean = np.convolve(line, np.ones(SPAN) / SPAN, mode="valid")
    rise = polarity * (mean[SPAN:] - mean[:-SPAN])
    best = _first(rise, step, mean[SPAN:], beyond)
    if best is None:
        return None
    length = float(k[lo]) + best + SPAN - 0.5 + _vertex(rise, best)
    before, after = float(mean[best]), float(mean[best + SPAN])
    return Edge(u=u0 + length * du, v=v0 + length * dv, before=before, after=after, length=length)


def _first(rise: Array, step: float, ahead: Array, beyond: float) -> int | None:
    """Index where the first rise of at least `step` is steepest, of those that lead to at least `beyond`."""
    for start in np.flatnonzero(rise >= step):
        best = int(start + np.argmax(rise[start : start + SPAN + 1]))
        if ahead[best] >= beyond:
            return best
    return None


def _usable(scan: Scan, u: NDArray[np.intp], v: NDArray[np.intp]) -> tuple[int, int]:
    """The run of ray points about the start that lies within the window, as a slice."""
    rows, columns = scan.image.shape
    usable = (u >= 0) & (u < columns) & (v >= 0) & (v < rows)
    usable[usable] = scan.window[v[usable], u[usable]]
    start = SPAN - 1
    if not usable[start]:
        return 0, 0
    blocked = np.flatnonzero(~usable)
    lo = int(blocked[blocked < start].max(initial=-1)) + 1
    hi = int(blocked[blocked > start].min(initial=len(u)))
    return lo, hi


def _vertex(y: Array, i: int) -> float:
    """Place of the top of the parabola through three values about `i`, from -.5 to .5."""
    if not 0 < i < len(y) - 1:
        return 0.0
    bend = y[i - 1] - 2 * y[i] + y[i + 1]
    return float(np.clip((y[i - 1] - y[i + 1]) / (2 * bend), -0.5, 0.5)) if bend < 0 else 0.0
