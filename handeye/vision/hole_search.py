"""Finds the large holes of a part in a picture, identifies them by size and distance, and computes the pose of the
part.
"""

import itertools
import math
from typing import Final, NamedTuple

import numpy as np

from handeye.core.pose import Array
from handeye.core.units import DEGREE, INCH
from handeye.program.program import Part
from handeye.vision.beam import DARKER, beams
from handeye.vision.blob import BoundingBox
from handeye.vision.camera_model import View
from handeye.vision.characteriser import Blob, characterise, fit_circle, rim, rims
from handeye.vision.scan import Scan

SIZE_ERROR: Final = 0.22
RATIO_ERROR: Final = 0.16
DISTANCE_ERROR: Final = 0.16  # relative error of the distance between the two holes
TURN: Final = 50 * DEGREE  # of the line between the two holes, relative to the plan, rad
# All figures above: vision study, section 1.3.


class Candidate(NamedTuple):
    """A blob that may be a hole, with its centre (m) and its mean diameter (m)."""

    blob: Blob
    x: float
    y: float
    size: float


class Pair(NamedTuple):
    """The two largest holes, the larger first."""

    first: Candidate
    second: Candidate


def classify(found: list[Candidate], part: Part) -> Pair | None:
    """Choose the two candidates whose sizes, distance and direction agree best with the two largest holes of the
    part.
    """
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
    """Compute the pose of the part's frame (x and y in metres, yaw in rad) from the centres of its two holes (in
    metres, shape (2, 2)).
    """
    model = np.array([[hole.x, hole.y] for hole in part.holes[:2]])
    seen, drawn = centres[1] - centres[0], model[1] - model[0]
    yaw = wrapped(math.atan2(seen[1], seen[0]) - math.atan2(drawn[1], drawn[0]))
    c, s = math.cos(yaw), math.sin(yaw)
    x, y = centres.mean(axis=0) - np.array([[c, -s], [s, c]]) @ model.mean(axis=0)
    return float(x), float(y), yaw


def hole_places(part: Part, pose: tuple[float, float, float], *, screws: bool = False) -> Array:
    """Return the centres of a part's large holes, in W (in metres, shape (n, 3)), when the part is at a pose. If
    `screws` is True, return the centres of its screw holes instead.
    """
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
    """Count the screw holes that are visible as dark spots in the bright face."""
    places = view.project(hole_places(part, pose, screws=True))
    places = places[scan.inside(places)]
    around = np.sort(scan.patches(places, 6, 2).reshape(len(places), 49), axis=1)[
        :, 24
    ]  # the median of 49 points
    spots = scan.patches(places, 2)
    means = (spots[:, :-1, :-1] + spots[:, :-1, 1:] + spots[:, 1:, :-1] + spots[:, 1:, 1:]) / 4
    dark = means.min(axis=(1, 2)) < 0.8 * around - 0.3
    return int(np.count_nonzero(dark & (around > 0.4 * face)))


def wrapped(angle: float) -> float:
    """Return the angle (rad) in [-pi, pi)."""
    return (angle + math.pi) % (2 * math.pi) - math.pi


ELONGATION: Final = (0.6, 1.65)
SIZES: Final = (
    0.55,
    1.3,
)  # limits of accepted sizes, as multiples of the smallest and of the largest diameter
SEED: Final = 4  # points inside the border where bouncing starts

# All figures above: vision study, sections 1.2 and 1.3.

INNER: Final = 0.25
"""Beams that look for the border of a hole start at this distance from the middle of the hole. The distance is a
fraction of the smaller width of the hole. With this value, the beams start half-way to the border.
"""
ANGLES: Final = np.linspace(-TURN, TURN, 7)
"""Angles of the beams from the largest hole towards the second, relative to the planned direction. The beams are so
close together that the second hole cannot lie between two of them.
"""
BEFORE: Final = 0.35 * INCH
"""The beams towards the second hole start at this distance (m) before the border of the second hole. They therefore do
not meet the screw holes around the first hole.
"""


class HoleSearch(NamedTuple):
    """Parameters of a search for holes: the spacing and width of the beams, and the contrast of a border."""

    spacing: int  # points between beams
    wide: bool  # averages over three points across a beam
    contrast: float  # of an edge, as a fraction of the contrast in the box
    face: float = 0.72  # least brightness around a hole, as a fraction of the machined face's


SEARCHES: Final = (
    HoleSearch(7, False, 0.38),
    HoleSearch(7, True, 0.38),
    HoleSearch(5, True, 0.28),
    HoleSearch(5, True, 0.20),
    HoleSearch(5, True, 0.20, face=0.4),
)
"""Searches, in the order in which they are tried. The searches for a large contrast come first, because a search for a
small contrast finds more false holes. The last search is for pictures in which the shadow of the arm falls across the
face; the vision study had no pictures of this kind.
"""


class Levels(NamedTuple):
    """Intensities of the face and of dark holes in a box around the part."""

    face: float
    dark: float

    @classmethod
    def measure(cls, scan: Scan, box: BoundingBox) -> "Levels":
        """Measure the intensities on every fourth point of every fourth line."""
        where = np.s_[box.top : box.bottom : 4, box.left : box.right : 4]
        scan.read[where] = True
        ordered = np.sort(scan.image[where], axis=None)
        dark, face = (float(ordered[round(share * (len(ordered) - 1))]) for share in (0.12, 0.92))
        return cls(face=face, dark=dark)

    def step(self, search: HoleSearch) -> float:
        """Return the least step of intensity at an edge. The step is the fraction `contrast` of the difference between
        the face and a hole. The least possible step is two levels, which is a few times the noise.
        """
        return max(2.0, search.contrast * (self.face - self.dark))


class HoleFinder:
    """Searches for the holes of a part with one set of parameters."""

    def __init__(
        self,
        scan: Scan,
        view: View,
        part: Part,
        resolution: tuple[float, float],
        levels: Levels,
        search: HoleSearch,
    ) -> None:
        """`resolution` is the number of picture points per metre on the upper face of the part, along the picture
        lines and across them.
        """
        self._scan, self._view, self._part, self._search = scan, view, part, search
        self._z = part.at[2] + part.face
        self._across, self._down = resolution
        self._step, self._bright = levels.step(search), search.face * levels.face

    def expected(self, place: tuple[float, float], *, shaded: bool = False) -> list[Candidate]:
        """Find candidates near their expected places, if the part's reference point is at `place` (x and y, in
        metres). The largest hole is found first, and then holes around it.

        The second hole is found by beams from the first, at all angles by which the part may be turned. If `shaded`
        is True, a circle of the size of the first hole is fitted, because a shadow blocks one of the four beams of
        the characteriser.
        """
        part = self._part
        seed = self._view.project(hole_places(part, (*place, part.at[3]))[0])[0]
        first = self._circle(seed) if shaded else self._tried(seed)
        if first is None or abs(first.size / part.holes[0].diameter - 1) > SIZE_ERROR:
            return []
        found = [first]
        for seed in self._around(first):
            if not any(_within(seed, known.blob) for known in found):
                found += filter(None, [self._tried(seed)])
        return found

    def _circle(self, middle: Array) -> Candidate | None:
        """Find the largest hole by fitting two circles. The first is fitted to the border around a point (u, v), and
        the second to the border around the centre of the first circle.
        """
        diameter = self._part.holes[0].diameter
        width, height = diameter * self._across, diameter * self._down
        for _ in range(2):
            at = float(middle[0]), float(middle[1])
            points = rim(self._scan, at, self._step, width, beyond=0.9 * self._bright)
            centre = fit_circle(self._view, points, self._z, diameter)
            if centre is None:
                return None
            x, y = centre
            middle = self._view.project(np.array([x, y, self._z]))[0]
        u, v = middle.tolist()
        return Candidate(Blob(u=u, v=v, width=width, height=height, bounces=0), x, y, diameter)

    def _around(self, first: Candidate) -> Array:
        """Return points (u, v), shape (n, 2), at which the second hole may be. Beams search for dark edges on an arc
        around the largest hole, `first`. Each point is just beyond an edge.
        """
        large, small = self._part.holes[:2]
        planned = self._part.at[3] + math.atan2(small.y - large.y, small.x - large.x)
        spokes = np.column_stack([np.cos(planned + ANGLES), np.sin(planned + ANGLES)])
        away = math.hypot(small.x - large.x, small.y - large.y)
        reach = np.array([away - small.diameter / 2 - BEFORE, away])
        ends = np.full((2, len(spokes), 3), self._z)
        ends[..., :2] = spokes * reach[:, None, None] + (first.x, first.y)
        near, far = self._view.project(ends.reshape(-1, 3)).reshape(2, -1, 2)
        lengths = np.hypot(*(far - near).T)
        ahead = (far - near) / lengths[:, None]
        edges = beams(self._scan, near, ahead, DARKER, self._step, lengths.max(), wide=True)
        return np.asarray((edges.uv + SEED * ahead)[edges.met & (edges.before >= self._bright)])

    def all_over(self, box: BoundingBox) -> list[Candidate]:
        """Find candidates in the whole box. Beams go through the box. Wherever a beam passes from the bright face to
        dark, the characteriser starts.
        """
        found: list[Candidate] = []
        for seed in self._dark_steps(box):
            if not any(_within(seed, known.blob) for known in found):
                found += filter(None, [self._tried(seed)])
        return found

    def _dark_steps(self, box: BoundingBox) -> Array:
        """Return points (u, v), shape (n, 2), just behind every step from bright to dark on beams through the box."""
        starts, ahead, lengths = _lines(box, self._search.spacing)
        gone, line = np.zeros(len(starts)), np.arange(len(starts))
        steps: list[tuple[int, float]] = []
        while len(line):
            edges = beams(
                self._scan, starts[line] + gone[line, None] * ahead[line], ahead[line],
                DARKER, self._step, (lengths - gone)[line], wide=self._search.wide,
            )  # fmt: skip
            face = edges.met & (edges.before >= self._bright)  # other edges: outline, plate, shadows
            steps += zip(line[face].tolist(), (gone[line] + edges.length + SEED)[face].tolist(), strict=True)
            gone[line] += edges.length + 2
            line = line[edges.met & (gone[line] < lengths[line] - 2 * SEED)]
        steps.sort()
        return np.array([starts[n] + k * ahead[n] for n, k in steps]).reshape(-1, 2)

    def _tried(self, seed: Array) -> Candidate | None:
        """Characterise the blob around a seed. Returns None if the blob cannot be a hole of the part."""
        reach = 1.35 * self._part.holes[0].diameter * self._across
        at, wide, beyond = (float(seed[0]), float(seed[1])), self._search.wide, 0.9 * self._bright
        blob = characterise(self._scan, at, self._step, reach, wide=wide, beyond=beyond)
        if blob is None:
            return None
        width, height = blob.width / self._across, blob.height / self._down
        size = math.sqrt(max(width * height, 0.0))
        smallest, largest = SIZES[0] * self._part.holes[1].diameter, SIZES[1] * self._part.holes[0].diameter
        if not (ELONGATION[0] * height < width < ELONGATION[1] * height and smallest < size < largest):
            return None
        x, y, _ = self._view.back_project(np.array([blob.u, blob.v]), self._z)[0].tolist()
        return Candidate(blob, x, y, size)

    def refined(self, pair: Pair) -> Array | None:
        """Find the centres of both holes (in metres, shape (2, 2)) by fitting circles. Returns None if a border is
        not seen well enough.
        """
        blobs = [candidate.blob for candidate in pair]
        middles = np.array([(blob.u, blob.v) for blob in blobs])
        reach = np.array([0.75 * blob.width + 3 for blob in blobs])
        inner = np.array([INNER * min(blob.width, blob.height) for blob in blobs])
        borders = rims(
            self._scan, middles, self._step, reach,
            inner=inner, wide=self._search.wide, beyond=0.9 * self._bright,
        )  # fmt: skip
        centres = [
            fit_circle(self._view, points, self._z, hole.diameter)
            for points, hole in zip(borders, self._part.holes, strict=False)
        ]
        return None if None in centres else np.array(centres)


def _lines(box: BoundingBox, spacing: int) -> tuple[Array, Array, Array]:
    """Return the starts, directions and lengths of beams along rows and columns. The beams along columns are half as
    dense as those along rows.
    """
    left, top, right, bottom = box
    rows = np.array([[left, v] for v in range(top + spacing, bottom, spacing)]).reshape(-1, 2)
    columns = np.array([[u, top] for u in range(left + spacing, right, 2 * spacing)]).reshape(-1, 2)
    ahead = np.repeat([[1.0, 0.0], [0.0, 1.0]], [len(rows), len(columns)], axis=0)
    lengths = np.repeat([right - left, bottom - top], [len(rows), len(columns)])
    return np.vstack([rows, columns]).astype(float), ahead, lengths.astype(float)


def _within(place: Array, blob: Blob) -> bool:
    u, v = place
    return bool(abs(u - blob.u) < blob.width / 2 + 1 and abs(v - blob.v) < blob.height / 2 + 1)
