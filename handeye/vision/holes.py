"""Finding the holes of a part in a picture of it, and telling by their sizes which is which."""

import itertools
import math
from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np

from handeye.pose import Array
from handeye.program.program import Part
from handeye.units import DEGREE
from handeye.vision.beam import DARKER, Edge, Scan, beam
from handeye.vision.blob import BoundingBox
from handeye.vision.camera_model import View
from handeye.vision.characteriser import Blob, characterise, fit_circle, rim

ELONGATION: Final = (0.6, 1.65)
SIZES: Final = (0.55, 1.3)
"""Accepted sizes, over the diameters of the smallest and the largest hole."""
SIZE_ERROR: Final = 0.22
RATIO_ERROR: Final = 0.16
DISTANCE_ERROR: Final = 0.16
"""Of the distance between the two holes, relative."""
TURN: Final = 50 * DEGREE
"""The line of centres lies within this of the planned one."""
SEED: Final = 4
"""Points inside the border where bouncing starts."""

# All figures above: vision study, sections 1.2 and 1.3.


class HoleSearch(NamedTuple):
    """One way to look for holes: how closely, and for how clear a border."""

    spacing: int
    """Points between beams."""
    wide: bool
    """Average over three points across a beam."""
    contrast: float
    """Step that is an edge, as a share of the contrast in the box."""
    face: float = 0.72
    """Least brightness around a hole, as a share of the level of the machined face."""


SEARCHES: Final = (
    HoleSearch(7, False, 0.38),
    HoleSearch(7, True, 0.38),
    HoleSearch(5, True, 0.28),
    HoleSearch(5, True, 0.20),
    HoleSearch(5, True, 0.20, face=0.4),
)
"""Tried in this order: starting with a small step finds more that is not a hole. The last is for the shadow
of the arm across the face, which the vision study did not have."""


class Levels(NamedTuple):
    """Intensities in a box about the part."""

    face: float
    dark: float

    @classmethod
    def measure(cls, scan: Scan, box: BoundingBox) -> "Levels":
        """From every fourth point of every fourth line."""
        where = np.s_[box.top : box.bottom : 4, box.left : box.right : 4]
        scan.read[where] = True
        dark, face = np.percentile(scan.image[where], [12, 92])
        return cls(face=float(face), dark=float(dark))

    def step(self, search: HoleSearch) -> float:
        """Least difference of intensity for an edge; two levels are a few times the noise."""
        return max(2.0, search.contrast * (self.face - self.dark))


class Candidate(NamedTuple):
    """A blob that may be a hole."""

    blob: Blob
    x: float
    y: float
    size: float
    """Mean diameter, m."""


class Pair(NamedTuple):
    """The two largest holes, the larger first."""

    first: Candidate
    second: Candidate


def candidates(
    scan: Scan, view: View, box: BoundingBox, part: Part, levels: Levels, search: HoleSearch
) -> list[Candidate]:
    """Send beams through the box; at every step from the bright face to dark try the characteriser."""
    z = part.at[2] + part.face
    across, down = view.resolution(view.back_project(box.corners().mean(axis=0), z)[0])
    step, bright = levels.step(search), search.face * levels.face
    reach = 1.35 * part.holes[0].diameter * across
    found: list[Candidate] = []
    for edge, (du, dv) in _dark_edges(scan, box, step, search):
        if edge.before < bright:
            continue  # not an edge of the machined face: outline, plate, shadow
        seed = edge.u + SEED * du, edge.v + SEED * dv
        if any(_within(seed, known.blob) for known in found):
            continue
        blob = characterise(scan, seed, step, reach, wide=search.wide, beyond=0.9 * bright)
        if blob is None:
            continue
        size = _size(blob.width / across, blob.height / down, part)
        if size is not None:
            x, y, _ = view.back_project(np.array([blob.u, blob.v]), z)[0]
            found.append(Candidate(blob, float(x), float(y), size))
    return found


def _dark_edges(
    scan: Scan, box: BoundingBox, step: float, search: HoleSearch
) -> Iterator[tuple[Edge, tuple[float, float]]]:
    """Every edge from bright to dark on beams through the box, with the direction of the beam."""
    for u, v, du, dv, length in _lines(box, search.spacing):
        k = 0.0
        while k < length - 2 * SEED:
            start = u + k * du, v + k * dv
            edge = beam(scan, start, (du, dv), DARKER, step, length - k, wide=search.wide)
            if edge is None:
                break
            yield edge, (du, dv)
            k += edge.length + 2


def _size(width: float, height: float, part: Part) -> float | None:
    """Mean diameter (m) of a blob that is round enough, and as large as a hole of the part may be."""
    size = math.sqrt(max(width * height, 0.0))
    is_round = ELONGATION[0] * height < width < ELONGATION[1] * height
    fits = SIZES[0] * part.holes[1].diameter < size < SIZES[1] * part.holes[0].diameter
    return size if is_round and fits else None


def _lines(box: BoundingBox, spacing: int) -> Iterator[tuple[int, int, float, float, int]]:
    """Start, direction and length of beams in rows and, half as dense, in columns."""
    for v in range(box.top + spacing, box.bottom, spacing):
        yield box.left, v, 1.0, 0.0, box.right - box.left
    for u in range(box.left + spacing, box.right, 2 * spacing):
        yield u, box.top, 0.0, 1.0, box.bottom - box.top


def _within(place: tuple[float, float], blob: Blob) -> bool:
    u, v = place
    return abs(u - blob.u) < blob.width / 2 + 1 and abs(v - blob.v) < blob.height / 2 + 1


def classify(found: list[Candidate], part: Part) -> Pair | None:
    """The two candidates whose sizes, distance and direction agree best with the part's two largest holes."""
    large, small = part.holes[:2]
    distance = math.hypot(small.x - large.x, small.y - large.y)
    planned = part.at[3] + math.atan2(small.y - large.y, small.x - large.x)
    best: tuple[float, Pair] | None = None
    for a, b in itertools.permutations(found, 2):
        deviations = (
            abs(a.size / large.diameter - 1) / SIZE_ERROR,
            abs(b.size / a.size - small.diameter / large.diameter) / RATIO_ERROR,
            abs(math.hypot(b.x - a.x, b.y - a.y) / distance - 1) / DISTANCE_ERROR,
            abs(wrapped(math.atan2(b.y - a.y, b.x - a.x) - planned)) / TURN,
        )
        score = sum(deviations[:3])
        if max(deviations) <= 1 and (best is None or score < best[0]):
            best = score, Pair(a, b)
    return best[1] if best else None


def refine(
    scan: Scan, view: View, pair: Pair, part: Part, levels: Levels, search: HoleSearch
) -> Array | None:
    """Centres of the two holes by fitted circles, shape (2, 2), m; None if a border is not seen well."""
    z = part.at[2] + part.face
    step, bright = levels.step(search), 0.9 * search.face * levels.face
    centres = []
    for candidate, hole in zip(pair, part.holes, strict=False):
        blob = candidate.blob
        points = rim(scan, (blob.u, blob.v), step, 0.75 * blob.width + 3, wide=search.wide, beyond=bright)
        centre = fit_circle(view, points, z, hole.diameter)
        if centre is None:
            return None
        centres.append(centre)
    return np.array(centres)


def placed(centres: Array, part: Part) -> tuple[float, float, float]:
    """Pose (x, y, yaw) of the part's frame, m and rad, from the centres of its two holes, shape (2, 2)."""
    model = np.array([[hole.x, hole.y] for hole in part.holes[:2]])
    seen, drawn = centres[1] - centres[0], model[1] - model[0]
    yaw = wrapped(math.atan2(seen[1], seen[0]) - math.atan2(drawn[1], drawn[0]))
    c, s = math.cos(yaw), math.sin(yaw)
    x, y = centres.mean(axis=0) - np.array([[c, -s], [s, c]]) @ model.mean(axis=0)
    return float(x), float(y), yaw


def hole_places(part: Part, pose: tuple[float, float, float], *, screws: bool = False) -> Array:
    """Centres of the large holes, or of the screw holes, shape (n, 3), m in W, of the part at a pose."""
    x, y, yaw = pose
    c, s = math.cos(yaw), math.sin(yaw)
    z = part.at[2] + part.face
    holes = part.screw_holes if screws else part.holes
    return np.array(
        [(x + c * hole.x - s * hole.y, y + s * hole.x + c * hole.y, z) for hole in holes]
    ).reshape(-1, 3)


def dark_screw_holes(
    scan: Scan, view: View, part: Part, pose: tuple[float, float, float], face: float
) -> int:
    """Count of the screw holes that are dark spots in the bright face, as they should be."""
    dark = 0
    for u, v in view.project(hole_places(part, pose, screws=True)):
        spot, around = scan.patch(u, v, 2), float(np.median(scan.patch(u, v, 6)))
        if spot.shape == (5, 5) and around > 0.4 * face:
            means = (spot[:-1, :-1] + spot[:-1, 1:] + spot[1:, :-1] + spot[1:, 1:]) / 4
            dark += bool(means.min() < 0.8 * around - 0.3)
    return dark


def wrapped(angle: float) -> float:
    """The same angle in [-pi, pi)."""
    return (angle + math.pi) % (2 * math.pi) - math.pi
