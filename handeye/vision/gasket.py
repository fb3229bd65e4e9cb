"""Inspects a gasket by comparing two pictures: one taken before the gasket was laid on the base, one taken after.

In the difference of the pictures the gasket is a bright blob with two dark holes. There is little difference wherever
the base or the gasket has a hole. If the gasket is displaced, each dark hole in the difference is therefore the
*union* of two holes: a hole of the gasket, and the hole of the base below it. The centre of the union moves by only
half the displacement. On one side, the border of the union moves by the whole displacement. Therefore both the centre
and the border are tested. If the gasket is in its place, `gasket_sheet` checks that the gasket is whole.
"""

import math
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from handeye.core.errors import BadArgument
from handeye.core.pose import Array
from handeye.core.units import INCH
from handeye.ports.camera import Picture
from handeye.program.diagnosis.causes import (
    BaseHoleUnseen,
    GasketFault,
    GasketHoleOff,
    GasketHoleUnseen,
    GasketTorn,
    GasketWrong,
    InspectionCause,
    LargeHole,
    NoGasket,
)
from handeye.program.program import Hole, Part
from handeye.vision.camera_model import View, in_picture
from handeye.vision.characteriser import characterise, fit_circle, rim
from handeye.vision.hole_search import hole_places
from handeye.vision.scan import Scan

ABSENT: Final = 2.2  # mean difference, levels, below which there is no gasket
STEP: Final = (1.8, 0.3)  # least step across a border of the gasket: levels, and fraction of its difference
CENTRE_SHIFT: Final = 0.09 * INCH
RIM_SHIFT: Final = 0.10 * INCH
"""Greatest permitted displacements (m) of a dark hole in the difference, relative to the base's hole: CENTRE_SHIFT for
the centre of the dark hole, and RIM_SHIFT for its border. RIM_SHIFT and the three values below are from the vision
study, section 4.
"""
BESIDE: Final = 0.3 * INCH  # distance (m) from a hole's border to where the difference is measured
BEFORE_STEP: Final = 0.38
BRIGHT: Final = 0.65
"""BEFORE_STEP and BRIGHT apply to the picture that was taken before the gasket was laid. In that picture, a step of
intensity is a border if it exceeds BEFORE_STEP times the contrast. The intensity of the face is measured on a ring
around each hole; a point that is brighter than BRIGHT times this intensity belongs to the face.
"""
ROUNDS: Final = 2  # searches for the base's largest hole, each starting from the previous one
RAYS: Final = 32
WINDOW: Final = 9
"""The median is taken over this number of neighbouring rays. These rays span a quarter of the rim. An aligning pin
hides less than a quarter.
"""
CLEAR: Final = 0.06 * INCH
"""A border point of the base counts only if it lies within this distance (m) of the apparent circle of the hole.

The apparent size of the hole depends on the scale of the camera, which may be off: in the world of seed 54010 at the
high level, it is off by 5 %.
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class GasketInspection:
    """Result of an inspection. Centres are (u, v) in the picture, with the centre of the largest hole first."""

    cause: InspectionCause | None  # None: the gasket lies properly
    expected: tuple[tuple[float, float], ...]  # expected centres, from the base's pose and its largest hole
    found: tuple[tuple[float, float] | None, ...]  # in the difference
    shift: float | None  # greatest displacement of a hole's border, m; None if no border is found

    @property
    def ok(self) -> bool:
        """True if the gasket lies in its place."""
        return self.cause is None


def difference(before: Picture, after: Picture) -> NDArray[np.float32]:
    """Return |after - before| at every point of the first picture, after aligning the areas that are the same in both
    pictures.
    """
    from handeye.vision.alignment import aligned  # imports OpenCV, which is not needed to make plans

    return np.abs(aligned(after, to=before) - before.astype(np.float32))


def inspect(
    before: Picture, after: Picture, view: View, part: Part, pose: tuple[float, float, float]
) -> GasketInspection:
    """Compare pictures of a part at `pose` (x, y in m, yaw in rad), taken before and after a gasket was laid on it.

    Both pictures must be taken with the same aim and target voltage. The arm must also be at the same position,
    because its shadow is the greatest disturbance. The second picture is aligned with the first by the areas that are
    the same in both pictures. The part must have two holes.
    """
    if len(part.holes) < 2:
        raise BadArgument("two holes are needed to inspect a gasket, but the program gives fewer")
    new, old = Scan(difference(before, after)), Scan(before)
    places = _as_seen(old, view, part, hole_places(part, pose)[:2])
    expected = tuple((float(u), float(v)) for u, v in view.project(places))
    pairs = list(zip(places, part.holes, strict=False))
    outside = tuple(
        BaseHoleUnseen(hole=name)
        for name, (place, hole) in zip(_NAMES, pairs, strict=True)
        if not in_picture(_ring(view, place, hole))
    )
    if outside:
        return GasketInspection(
            cause=GasketWrong(faults=outside), expected=expected, found=(None, None), shift=None
        )
    if np.median([_around(new, view, place, hole) for place, hole in pairs]) < ABSENT:
        return GasketInspection(cause=NoGasket(), expected=expected, found=(None, None), shift=None)
    checks = [
        _check(name, new, old, view, place, hole) for name, (place, hole) in zip(_NAMES, pairs, strict=True)
    ]
    faults: tuple[GasketFault, ...] = tuple(check.fault for check in checks if check.fault is not None)
    if part.screw_holes and not faults:
        faults = _torn(before, after, view, part, [check.base for check in checks if check.base is not None])
    return GasketInspection(
        cause=GasketWrong(faults=faults) if faults else None,
        expected=expected,
        found=tuple(check.found for check in checks),
        shift=max((check.shift for check in checks if check.shift is not None), default=None),
    )


def _torn(
    before: Picture, after: Picture, view: View, part: Part, large: list[Array]
) -> tuple[GasketTorn, ...]:
    """Check that a gasket in its place is whole. `large` are the centres of the base's large holes, in metres."""
    from handeye.vision.gasket_sheet import MAX_BARE, bare  # imports OpenCV, as does `difference`

    patch = bare(before, after, view, part, large)
    return (GasketTorn(bare=round(patch, 9)),) if patch > MAX_BARE else ()


_NAMES: Final[tuple[LargeHole, LargeHole]] = ("largest", "second")


def _as_seen(old: Scan, view: View, part: Part, places: Array) -> Array:
    """Return the corrected positions of the base's holes (in metres, shape (2, 3)). The largest hole is located in the
    picture without the gasket. The difference from its expected position is then used to correct both positions.

    The aim of the mount may differ from the readings of its potentiometers by more than the width of a hole's border.
    But the arm knows the position of the base with a smaller error. If the hole is not found, the positions
    are not corrected.
    """
    for _ in range(ROUNDS):
        steps = _base_steps(old, view, places[0], part.holes[0])
        fitted = _centre(old, view, places[0], part.holes[0], steps.before, steps.face)
        if fitted is None:
            return places
        places = places + (np.array([*fitted, places[0][2]]) - places[0])
    return places


class _BaseSteps(NamedTuple):
    """Thresholds for the picture without the gasket: the least change of intensity across a border, and the intensity
    above which a point belongs to the face of the base.
    """

    before: float
    face: float


class _Steps(NamedTuple):
    """Thresholds of intensity. `after` is the least change across a border in the difference between the two pictures.
    `before` is the least change across a border in the picture without the gasket. `face` is the intensity above which
    a point of that picture belongs to the face of the base.
    """

    after: float
    before: float
    face: float


@dataclass(frozen=True, slots=True, kw_only=True)
class _Check:
    """Result for one hole; `fault` is None if the gasket is in its place at this hole."""

    fault: BaseHoleUnseen | GasketHoleUnseen | GasketHoleOff | None = None
    base: Array | None = None  # centre of the hole of the base, m, shape (3,)
    found: tuple[float, float] | None = None
    shift: float | None = None


def _check(name: LargeHole, new: Scan, old: Scan, view: View, place: Array, hole: Hole) -> _Check:
    gasket = float(np.percentile(_around(new, view, place, hole), 25))  # a shadow may lie across
    base_steps = _base_steps(old, view, place, hole)
    after = max(STEP[0], STEP[1] * gasket)
    steps = _Steps(after=after, before=base_steps.before, face=base_steps.face)
    fitted = _centre(old, view, place, hole, steps.before, steps.face)
    if fitted is None:
        return _Check(fault=BaseHoleUnseen(hole=name))
    base = np.array([*fitted, place[2]])
    moved = _centre(new, view, base, hole, steps.after)
    bulge = _bulge(new, old, view, base, hole, steps)
    if moved is None or bulge is None:
        return _Check(fault=GasketHoleUnseen(hole=name))
    off = math.dist(moved, fitted)
    wrong = off > CENTRE_SHIFT or bulge > RIM_SHIFT
    fault = GasketHoleOff(hole=name, off=round(max(bulge, off), 6)) if wrong else None
    u, v = view.project(np.array([*moved, place[2]]))[0]
    return _Check(fault=fault, base=base, found=(float(u), float(v)), shift=max(bulge, off))


def _base_steps(old: Scan, view: View, place: Array, hole: Hole) -> _BaseSteps:
    """Return the thresholds for one hole in the picture without the gasket."""
    face = float(np.percentile(_around(old, view, place, hole), 25))
    u, v = view.project(place)[0]
    inside = float(np.median(old.patches(np.array([[u, v]]), 3)))
    return _BaseSteps(before=max(STEP[0], BEFORE_STEP * (face - inside)), face=BRIGHT * face)


def _around(scan: Scan, view: View, place: Array, hole: Hole) -> Array:
    """Return the intensities on a ring around a hole, shape (24,). Almost all of the ring lies on the face or on the
    gasket.
    """
    return np.asarray(scan.patches(_ring(view, place, hole), 1).mean(axis=(1, 2)))


def _ring(view: View, place: Array, hole: Hole) -> Array:
    """Return the points (u, v) of a ring around a hole, shape (24, 2)."""
    angles = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    ring = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(24)])
    return view.project(place + ring * (hole.diameter / 2 + BESIDE))


def _centre(
    scan: Scan, view: View, place: Array, hole: Hole, step: float, beyond: float = 0.0
) -> tuple[float, float] | None:
    """Find the centre (x and y, in metres) of the hole that is expected at `place` (in metres, shape (3,)).

    The characteriser finds the hole, as it does when the base is located. Then a circle is fitted to the border of the
    hole. Rays from the hole's centre find this border. If an aligning pin blocks one of the characteriser's four
    beams, the rays start from the expected place instead.
    """
    seed, reach = _seen(view, place, hole)
    blob = characterise(scan, seed, step, reach, wide=True, beyond=beyond)
    middle = (blob.u, blob.v) if blob else seed
    points = rim(scan, middle, step, reach, rays=RAYS, beyond=beyond)
    return fit_circle(view, points, float(place[2]), hole.diameter)


def _seen(view: View, place: Array, hole: Hole) -> tuple[tuple[float, float], float]:
    """Return the picture point of the place of a hole, and the greatest distance (points) from this point to the
    border of the hole.
    """
    u, v = view.project(place)[0].tolist()
    return (u, v), 0.9 * hole.diameter * view.resolution(place)[0]


def _bulge(new: Scan, old: Scan, view: View, centre: Array, hole: Hole, steps: _Steps) -> float | None:
    """Measure how far (m) the border of a hole bulges outwards in the difference of the pictures. The centre of the
    base's hole is `centre` (in metres, shape (3,)). The picture without the gasket (`old`) shows which part of the
    border is undisturbed.

    The gasket's hole and the base's hole overlap, and the border is the outline of these two discs together. Half of
    this border is nearly undisturbed, so the bulge is measured from the median radius. An aligning pin may hide the
    border of the base's hole. Therefore a ray counts only if it crosses a visible border in the picture without the
    gasket.
    """
    radii, (middle, reach) = [], _seen(view, centre, hole)
    for scan, step, beyond in ((old, steps.before, steps.face), (new, steps.after, 0.0)):
        points = rim(scan, middle, step, reach, rays=RAYS, beyond=beyond)
        spokes = view.back_project(points, float(centre[2])) - centre
        radii.append(np.hypot(spokes[:, 0], spokes[:, 1]))
    seen = np.median(np.nan_to_num(radii[0], nan=hole.diameter / 2))
    clear = np.abs(radii[0] - seen) < CLEAR
    clear &= np.roll(clear, 1) & np.roll(clear, -1) & ~np.isnan(radii[1])
    if np.count_nonzero(clear) < RAYS // 3:
        return None
    bulges = radii[1] - np.median(radii[1][clear])
    near = [np.roll(np.arange(RAYS), -k)[:WINDOW] for k in range(RAYS)]
    windows = [bulges[k][clear[k]] for k in near if np.count_nonzero(clear[k]) > WINDOW // 2]
    return max((float(np.median(window)) for window in windows), default=None)
