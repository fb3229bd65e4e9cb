"""Beams. A beam finds the first edge along a ray. An edge is a discontinuity of intensity. A walk is a beam along one
line or column of the picture. All other primitives are built from beams and walks.

A beam ends at its edge and reads no points beyond it.
"""

from typing import Final, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from handeye.core.pose import Array
from handeye.vision.scan import Scan

SPAN: Final = 3
"""Number of points averaged on either side of an edge. Averages of 2 points are too noisy if the noise of the picture
is one grey level.
"""

BRIGHTER: Final = 1
DARKER: Final = -1
Polarity = Literal[1, -1]


class Edge(NamedTuple):
    """An edge: its position (u, v), the intensities before and after it on the beam, and its distance from the
    start of the beam (points).
    """

    u: float
    v: float
    before: float
    after: float
    length: float


class Edges(NamedTuple):
    """The edges found by several beams. Row `n` of each field belongs to beam `n`."""

    met: NDArray[np.bool_]
    """True if the beam found an edge; if not, the other fields of the row are meaningless."""
    uv: Array
    """Positions of the edges, shape (n, 2)."""
    before: Array
    after: Array
    length: Array

    def edge(self, n: int) -> Edge | None:
        """Return the edge that beam `n` found, or None if it found none."""
        if not self.met[n]:
            return None
        (u, v), before, after = self.uv[n].tolist(), float(self.before[n]), float(self.after[n])
        return Edge(u=u, v=v, before=before, after=after, length=float(self.length[n]))


def beams(
    scan: Scan,
    starts: ArrayLike,
    directions: ArrayLike,
    polarity: Polarity,
    step: float,
    reach: float | Array,
    *,
    wide: bool = False,
    beyond: float = 0.0,
) -> Edges:
    """Find edges as `door.beams` does. The caller must have checked the arguments."""
    starts, directions = np.rint(starts), np.asarray(directions, dtype=float)
    scan.beams += len(starts)
    back, ahead = scan.runs(starts, directions)
    low = np.maximum(np.ceil(-back), 1 - SPAN)
    high = np.minimum(np.floor(ahead), np.trunc(reach) + SPAN - 1)
    high[high - low + 1 < 2 * SPAN] = -SPAN  # too short for a step
    k = np.arange(1 - SPAN, max(SPAN, int(high.max(initial=0))) + 1)
    usable = (k >= low[:, None]) & (k <= high[:, None])
    u, v = np.rint(starts.T[:, :, None] + directions.T[:, :, None] * k)
    where = np.asarray(v * scan.columns + u, dtype=np.intp)
    across = None
    if wide:  # to the neighbour below a ray, or to the right of it, (n, 1)
        level = np.abs(directions[:, 0]) >= np.abs(directions[:, 1])
        across = np.where(level, scan.columns, 1)[:, None]
    total = _sums(scan, where, across)
    rise = polarity * (total[:, SPAN:] - total[:, :-SPAN])
    scale = SPAN * (3 if wide else 1)
    rise[~(usable[:, : 1 - 2 * SPAN] & usable[:, 2 * SPAN - 1 :])] = _BLOCKED
    met, first, best = _steepest(rise, step * scale, total[:, SPAN:], beyond * scale)
    _account(scan, where, usable, across, np.where(met, first + 3 * SPAN, len(k)))
    n = np.arange(len(starts))
    length = k[0] + best + SPAN - 0.5 + _vertex(rise, best)
    return Edges(
        met=met,
        uv=starts + length[:, None] * directions,
        before=total[n, best] / scale,
        after=total[n, best + SPAN] / scale,
        length=length,
    )


_BLOCKED: Final = -1e6  # stands for the rise at places that a beam may not read


def _sums(scan: Scan, where: NDArray[np.intp], across: NDArray[np.intp] | None) -> Array:
    """Sum the intensities over SPAN points at each place along each beam, and optionally over three points across
    the beam. Returns shape (n, points - SPAN + 1).
    """
    line = scan.levels(where if across is None else where - across).astype(float)
    if across is not None:
        line += scan.levels(where)
        line += scan.levels(where + across)
    places = where.shape[1] - SPAN + 1
    total = line[:, :places].copy()
    for k in range(1, SPAN):
        total += line[:, k : k + places]
    return total


def _steepest(
    rise: Array, step: float, ahead: Array, beyond: float
) -> tuple[NDArray[np.bool_], NDArray[np.intp], NDArray[np.intp]]:
    """Return a mask of the lines on which the intensity rises. A rise counts if it is at least `step` and ends at an
    intensity of at least `beyond`. Also return the first place of such a rise on each line, and the steepest place
    near it.
    """
    n, last = np.arange(len(rise)), rise.shape[1] - 1
    strong = rise >= step
    while True:
        first = strong.argmax(axis=1)
        near = np.minimum(first[:, None] + np.arange(SPAN + 1), last)
        best = first + rise[n[:, None], near].argmax(axis=1)
        met = strong[n, first]
        passed = met & (ahead[n, best] < beyond)
        if not passed.any():
            return met, first, best
        strong[passed, first[passed]] = False


def _account(
    scan: Scan,
    where: NDArray[np.intp],
    usable: NDArray[np.bool_],
    across: NDArray[np.intp] | None,
    ends: NDArray[np.intp],
) -> None:
    """Record in `scan` which points the beams have read."""
    looked = usable & (np.arange(where.shape[1]) < ends[:, None])
    read = where[looked]
    scan.account(read)
    if across is not None:
        beside = np.broadcast_to(across, where.shape)[looked]
        scan.account(read - beside)
        scan.account(read + beside)


def _vertex(y: Array, i: NDArray[np.intp]) -> Array:
    """Return the position of a vertex for each line, relative to index `i`, shape (n,). This is the vertex of the
    parabola through the three values about index `i`. Positions are limited to the range from -.5 to .5.
    """
    n, last = np.arange(len(y)), y.shape[1] - 1
    left, top, right = y[n, np.maximum(i - 1, 0)], y[n, i], y[n, np.minimum(i + 1, last)]
    bend = left - 2 * top + right
    known = (i > 0) & (i < last) & (bend < 0) & (np.minimum(left, right) > _BLOCKED)
    place = np.divide(left - right, 2 * bend, out=np.zeros(len(y)), where=known)
    return np.asarray(np.minimum(np.maximum(place, -0.5), 0.5))
