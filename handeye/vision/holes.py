"""Identifies the holes of a part by size and distance, and derives its pose."""

import itertools
import math
from typing import Final, NamedTuple

import numpy as np

from handeye.core.pose import Array
from handeye.core.units import DEGREE
from handeye.program.program import Part
from handeye.vision.camera_model import View
from handeye.vision.characteriser import Blob
from handeye.vision.scan import Scan

SIZE_ERROR: Final = 0.22
RATIO_ERROR: Final = 0.16
DISTANCE_ERROR: Final = 0.16
"""Relative, of the distance between the two holes."""
TURN: Final = 50 * DEGREE  # of the line of centres against plan, rad
# All figures above: vision study, section 1.3.


class Candidate(NamedTuple):
    """A blob that may be a hole, with its centre (m) and mean diameter (m)."""

    blob: Blob
    x: float
    y: float
    size: float


class Pair(NamedTuple):
    """The two largest holes, the larger first."""

    first: Candidate
    second: Candidate


def classify(found: list[Candidate], part: Part) -> Pair | None:
    """The two candidates whose sizes, distance and direction agree best with the part's largest holes."""
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


def placed(centres: Array, part: Part) -> tuple[float, float, float]:
    """Pose (x, y, yaw) of the part's frame, m and rad, from the centres of its two holes, shape (2, 2)."""
    model = np.array([[hole.x, hole.y] for hole in part.holes[:2]])
    seen, drawn = centres[1] - centres[0], model[1] - model[0]
    yaw = wrapped(math.atan2(seen[1], seen[0]) - math.atan2(drawn[1], drawn[0]))
    c, s = math.cos(yaw), math.sin(yaw)
    x, y = centres.mean(axis=0) - np.array([[c, -s], [s, c]]) @ model.mean(axis=0)
    return float(x), float(y), yaw


def hole_places(part: Part, pose: tuple[float, float, float], *, screws: bool = False) -> Array:
    """Centres of the large holes, or of the screw holes, of a part at a pose, shape (n, 3), m in W."""
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
    """Number of screw holes seen as dark spots in the bright face."""
    places = view.project(hole_places(part, pose, screws=True))
    places = places[scan.inside(places)]
    around = np.sort(scan.patches(places, 6, 2).reshape(len(places), 49), axis=1)[:, 24]  # the median
    spots = scan.patches(places, 2)
    means = (spots[:, :-1, :-1] + spots[:, :-1, 1:] + spots[:, 1:, :-1] + spots[:, 1:, 1:]) / 4
    dark = means.min(axis=(1, 2)) < 0.8 * around - 0.3
    return int(np.count_nonzero(dark & (around > 0.4 * face)))


def wrapped(angle: float) -> float:
    """The same angle in [-pi, pi)."""
    return (angle + math.pi) % (2 * math.pi) - math.pi
