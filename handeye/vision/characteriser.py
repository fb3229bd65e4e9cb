"""The convex blob characteriser: finds the centre, width and height of a convex blob with beams that bounce inside
it.

`fit_circle` is our addition to the primitives of 1973 and uses the same beams. The bouncing beams use four points of
the border, and the fit uses up to 24 points.
"""

import math
from functools import cache
from typing import Final, NamedTuple

import numpy as np

from handeye.core.pose import Array
from handeye.vision.beam import BRIGHTER, SPAN, Edge, Polarity, beams
from handeye.vision.camera_model import View
from handeye.vision.scan import Scan


def walk(
    scan: Scan,
    start: tuple[float, float],
    direction: tuple[int, int],
    polarity: Polarity,
    step: float,
    reach: float,
    *,
    wide: bool = False,
    beyond: float = 0.0,
) -> Edge | None:
    """Find the first edge along a picture line or column, or return None if there is no edge. The arguments are those
    of `beams`; for a single beam, `walk` is faster than `beams`.
    """
    scan.beams += 1
    u, v, (du, dv) = round(start[0]), round(start[1]), direction
    back, ahead = scan.run(u, v, du, dv)
    low, high = max(1 - SPAN, -back), min(int(reach) + SPAN - 1, ahead)
    if high - low + 1 < 2 * SPAN:
        return None
    stride, first = dv * scan.columns + du, v * scan.columns + u + low * (dv * scan.columns + du)
    beside = (-1, 0, 1) if wide else (0,)
    starts = [first + k * (1 if dv else scan.columns) for k in beside]
    line = scan.summed(starts, high - low + 1, stride)
    scale = SPAN * len(starts)
    met, best = _first(line, polarity, step * scale, beyond * scale)
    scan.account_lines(starts, min(met + 3 * SPAN, len(line)), stride)
    if best is None:
        return None
    length = low + best + SPAN - 0.5 + _vertex(line, polarity, best)
    before = sum(line[best : best + SPAN]) / scale
    after = sum(line[best + SPAN : best + 2 * SPAN]) / scale
    return Edge(u + length * du, v + length * dv, before, after, length)


def _first(line: list[float], polarity: Polarity, step: float, beyond: float) -> tuple[int, int | None]:
    """Find the first rise on a line. A rise must be at least `step`, and must end at an intensity of at least
    `beyond`. Returns the index of this rise, and the index of the steepest rise near it. Returns (end, None) if the
    line never rises that far.
    """
    rise, places = _rise(line, 0), len(line) - 2 * SPAN + 1
    entering = [*line[2 * SPAN :], 0.0]  # no point enters after the last place
    for i, (left, passed, entered) in enumerate(zip(line, line[SPAN:], entering, strict=False)):
        if polarity * rise >= step:
            near = [polarity * _rise(line, k) for k in range(i, min(i + SPAN + 1, places))]
            best = i + near.index(max(near))
            if sum(line[best + SPAN : best + 2 * SPAN]) >= beyond:
                return i, best
        rise += left - 2 * passed + entered
    return len(line), None


def _rise(line: list[float], i: int) -> float:
    """Return the sum of the SPAN points that begin at index `i`, minus the sum of the SPAN points before them."""
    return sum(line[i + SPAN : i + 2 * SPAN]) - sum(line[i : i + SPAN])


def _vertex(line: list[float], polarity: Polarity, i: int) -> float:
    """Put a parabola through the rises at index `i` and at the two indices next to it. Return the offset of its vertex
    from `i`, limited to -.5 to .5.
    """
    if not 0 < i < len(line) - 2 * SPAN:
        return 0.0
    left, top, right = (polarity * _rise(line, k) for k in (i - 1, i, i + 1))
    bend = left - 2 * top + right
    return min(max((left - right) / (2 * bend), -0.5), 0.5) if bend < 0 else 0.0


BOUNCES: Final = 10
RAYS: Final = 24


class Blob(NamedTuple):
    """A convex blob; all lengths in picture points."""

    u: float
    v: float
    width: float
    """Length of the horizontal chord of the last bounce."""
    height: float
    bounces: int


def characterise(
    scan: Scan,
    seed: tuple[float, float],
    step: float,
    reach: float,
    *,
    polarity: Polarity = BRIGHTER,
    wide: bool = False,
    beyond: float = 0.0,
) -> Blob | None:
    """Characterise a blob as `door.characterise` does. The caller must have checked the arguments."""
    u, v = seed
    for bounce in range(1, BOUNCES + 1):
        level = _chord(scan, (u, v), (1, 0), polarity, step, reach, wide, beyond)
        if level is None:
            return None
        left, right = level[0].u, level[1].u
        middle = (left + right) / 2
        upright = _chord(scan, (middle, v), (0, 1), polarity, step, reach, wide, beyond)
        if upright is None:
            return None
        top, bottom = upright[0].v, upright[1].v
        moved = math.hypot(middle - u, (top + bottom) / 2 - v)
        u, v = middle, (top + bottom) / 2
        if moved < 1 and bounce > 1:
            return Blob(u=u, v=v, width=right - left, height=bottom - top, bounces=bounce)
    return None


def _chord(
    scan: Scan,
    start: tuple[float, float],
    direction: tuple[int, int],
    polarity: Polarity,
    step: float,
    reach: float,
    wide: bool,
    beyond: float,
) -> tuple[Edge, Edge] | None:
    """Find the edges at both ends of a chord, with two opposite beams from one start. Returns None if a beam finds
    no edge.
    """
    du, dv = direction
    back = walk(scan, start, (-du, -dv), polarity, step, reach, wide=wide, beyond=beyond)
    ahead = walk(scan, start, (du, dv), polarity, step, reach, wide=wide, beyond=beyond) if back else None
    return (back, ahead) if back and ahead else None


def rim(
    scan: Scan, centre: tuple[float, float], step: float, reach: float, *, rays: int = RAYS, beyond: float = 0.0
) -> Array:  # fmt: skip
    """Find border points (u, v) around a centre, using wide beams. Returns an array of shape (`rays`, 2), in order of
    angle, with NaN for a beam that finds no edge.
    """
    borders = rims(
        scan, np.array([centre]), step, np.array([reach]), rays=rays, inner=np.zeros(1), wide=True, beyond=beyond
    )  # fmt: skip
    return np.asarray(borders[0])


def rims(
    scan: Scan,
    centres: Array,
    step: float,
    reach: Array,
    *,
    rays: int = RAYS,
    inner: Array,
    wide: bool = False,
    beyond: float = 0.0,
) -> Array:
    """Find border points around several centres, shape (n, 2). Returns shape (n, `rays`, 2). One call for all centres
    is faster than a call for each centre. `reach` and `inner` have shape (n,).
    """
    spokes = _spokes(rays)
    starts = centres[:, None] + inner[:, None, None] * spokes
    directions = np.broadcast_to(spokes, starts.shape).reshape(-1, 2)
    lengths = np.repeat(reach - inner, rays)
    edges = beams(scan, starts.reshape(-1, 2), directions, BRIGHTER, step, lengths, wide=wide, beyond=beyond)
    points = edges.uv
    points[~edges.met] = np.nan
    return np.asarray(points.reshape(-1, rays, 2))


@cache
def _spokes(rays: int) -> Array:
    """Return unit vectors in all directions, shape (`rays`, 2)."""
    angles = np.arange(rays) * (2 * math.pi / rays)
    spokes = np.column_stack([np.cos(angles), np.sin(angles)])
    spokes.flags.writeable = False
    return spokes


def fit_circle(view: View, points: Array, z: float, diameter: float) -> tuple[float, float] | None:
    """Fit a circle of known diameter (m) at height `z` (m) to its border points, shape (n, 2).

    Points that are NaN are dropped, and so are points that disagree with the others because of shadows or noise.
    Returns the centre (x and y, in metres), or None if fewer than `RAYS` / 2 points remain.
    """
    met = points[~np.isnan(points[:, 0])]
    if len(met) < RAYS // 2:
        return None
    x, y = view.back_project(met, z)[:, :2].T
    x0, y0 = _median(x), _median(y)
    for _ in range(10):
        dx, dy = x - x0, y - y0
        radius = np.sqrt(dx * dx + dy * dy)
        excess = radius - diameter / 2
        spread = np.abs(excess - _median(excess))
        kept = spread <= max(0.0015, 2 * _median(spread))  # 1.5 mm is about one point
        kept &= radius > 0.0  # a point in the middle of the others tells no direction
        move = _least_squares(dx[kept] / radius[kept], dy[kept] / radius[kept], excess[kept])
        if move is None:
            return None
        x0, y0 = x0 + move[0], y0 + move[1]
        if max(abs(move[0]), abs(move[1])) < 1e-5:
            break
    return (x0, y0) if np.count_nonzero(kept) >= RAYS // 2 else None


def _median(values: Array) -> float:
    """Return the median of a short array. For such an array, `np.median` takes thirty times as long."""
    ordered, half = sorted(values.tolist()), len(values) // 2
    return float(ordered[half] + ordered[-1 - half]) / 2


def _least_squares(a: Array, b: Array, c: Array) -> tuple[float, float] | None:
    """Return the least-squares solution p, q of a p + b q = c, or None if the equations are singular."""
    aa, ab, bb = float(a @ a), float(a @ b), float(b @ b)
    ac, bc = float(a @ c), float(b @ c)
    determinant = aa * bb - ab * ab
    if not determinant > 0:
        return None
    return (ac * bb - bc * ab) / determinant, (bc * aa - ac * ab) / determinant
