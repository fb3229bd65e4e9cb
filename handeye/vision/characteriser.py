"""The convex blob characteriser: centre, width and height of a convex blob by bouncing around inside it.

`fit_circle` is an addition of ours to the period's primitives, made of the same beams: bouncing uses four
points of the border, the fit up to 24.
"""

import math
from typing import Final, NamedTuple

import numpy as np

from handeye.pose import Array
from handeye.vision.beam import BRIGHTER, Edge, Polarity, Scan, beam
from handeye.vision.camera_model import View

BOUNCES: Final = 10
RAYS: Final = 24


class Blob(NamedTuple):
    """A convex blob."""

    u: float
    v: float
    width: float
    """Length of the last chord along the lines, points."""
    height: float
    surround: float
    """Lowest intensity met on the far side of its border."""
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
    """Bounce from a seed inside the blob until its centre rests; None if a beam finds no edge.

    Args:
        step: least difference of intensity across the border.
        reach: greatest distance of the border from the present centre, points.
        polarity: BRIGHTER: the surroundings are brighter than the blob.
        wide: average over three points across each beam.
        beyond: least intensity outside the border: a shadow's edge inside a hole is no border of it.
    """
    u, v = seed
    for bounce in range(1, BOUNCES + 1):
        level = _chord(scan, (u, v), (1.0, 0.0), polarity, step, reach, wide, beyond)
        if level is None:
            return None
        middle = (level[0].u + level[1].u) / 2
        upright = _chord(scan, (middle, v), (0.0, 1.0), polarity, step, reach, wide, beyond)
        if upright is None:
            return None
        moved = math.hypot(middle - u, (upright[0].v + upright[1].v) / 2 - v)
        u, v = middle, (upright[0].v + upright[1].v) / 2
        if moved < 1 and bounce > 1:
            edges = level + upright
            return Blob(
                u=u,
                v=v,
                width=level[1].u - level[0].u,
                height=upright[1].v - upright[0].v,
                surround=min(edge.after for edge in edges),
                bounces=bounce,
            )
    return None


def _chord(
    scan: Scan,
    start: tuple[float, float],
    direction: tuple[float, float],
    polarity: Polarity,
    step: float,
    reach: float,
    wide: bool,
    beyond: float,
) -> tuple[Edge, Edge] | None:
    du, dv = direction
    back = beam(scan, start, (-du, -dv), polarity, step, reach, wide=wide, beyond=beyond)
    ahead = beam(scan, start, (du, dv), polarity, step, reach, wide=wide, beyond=beyond) if back else None
    return (back, ahead) if back and ahead else None


def rim(
    scan: Scan,
    centre: tuple[float, float],
    step: float,
    reach: float,
    *,
    rays: int = RAYS,
    polarity: Polarity = BRIGHTER,
    wide: bool = False,
    beyond: float = 0.0,
) -> Array:
    """Points (u, v) of the border around a centre, shape (`rays`, 2), by angle; NaN where none is met."""
    points = np.full((rays, 2), np.nan)
    for k in range(rays):
        angle = k * 2 * math.pi / rays
        edge = beam(
            scan, centre, (math.cos(angle), math.sin(angle)), polarity, step, reach, wide=wide, beyond=beyond
        )
        if edge is not None:
            points[k] = edge.u, edge.v
    return points


def fit_circle(view: View, points: Array, z: float, diameter: float) -> tuple[float, float] | None:
    """Centre (x, y), m, of a circle of known diameter (m) at height `z`.

    From points (u, v) of its border, shape (n, 2), of which some may be NaN.
    Points that disagree (shadows, noise) are dropped; None with fewer than half the rays left.
    """
    met = points[~np.isnan(points[:, 0])]
    if len(met) < RAYS // 2:
        return None
    p = view.back_project(met, z)[:, :2]
    centre = np.median(p, axis=0)
    for _ in range(10):
        spoke = p - centre
        radius = np.linalg.norm(spoke, axis=1)
        excess = radius - diameter / 2
        spread = np.abs(excess - np.median(excess))
        kept = spread <= max(0.0015, 2 * float(np.median(spread)))  # 1.5 mm is about one point
        move, *_ = np.linalg.lstsq(spoke[kept] / radius[kept, None], excess[kept], rcond=None)
        centre = centre + move
        if np.abs(move).max() < 1e-5:
            break
    return (float(centre[0]), float(centre[1])) if np.count_nonzero(kept) >= RAYS // 2 else None
