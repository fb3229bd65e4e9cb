"""Is the gasket on properly? What a picture taken after has, and the picture before has not, tells.

In the difference of the two pictures the gasket is a bright blob with two dark holes. Where either base or
gasket has a hole there is little difference, so that a displaced gasket shows the *union* of both holes: its
centre moves by half the displacement only, but its border on one side by all of it. Hence two tests, of
centre and of rim.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.cell.ports import Picture
from handeye.errors import InvalidInput
from handeye.plan.program import Hole, Part
from handeye.pose import Array
from handeye.units import INCH
from handeye.vision.beam import Scan
from handeye.vision.camera import View
from handeye.vision.characteriser import Blob, characterise, fit_circle, rim
from handeye.vision.holes import hole_places

ABSENT: Final = 2.2
"""Mean difference, levels, where the gasket should be, below which there is none."""
STEP: Final = (1.8, 0.3)
"""Least step across a border of the gasket: levels, and share of the difference it makes."""
CENTRE_SHIFT: Final = 0.09 * INCH
RIM_SHIFT: Final = 0.10 * INCH
"""Most that centre and rim may be off. These four: vision study, section 4."""
BESIDE: Final = 0.3 * INCH
"""From the border of a hole to where the gasket's difference is measured."""
BEFORE_STEP: Final = 0.38
BRIGHT: Final = 0.65
"""In the picture before: share of the contrast that is a border, and of the face's level that is face."""
RAYS: Final = 32
CLEAR: Final = 0.06 * INCH
"""The base's border in the picture before counts where it is this near to the circle it should be."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Inspection:
    """What was found of the gasket. Centres are (u, v) in the picture, largest hole first."""

    ok: bool
    sentence: str
    """For the operator."""
    expected: tuple[tuple[float, float], ...]
    """Where the centres of the large holes should be, by the pose of the base."""
    found: tuple[tuple[float, float] | None, ...]
    """Where the characteriser finds them in the difference."""
    shift: float | None
    """The most that the border of a hole is displaced, m; None if no border is found."""


def difference(before: Picture, after: Picture) -> Picture:
    """|after - before| at every point."""
    return np.abs(after.astype(np.int16) - before.astype(np.int16)).astype(np.uint8)


def inspect(
    before: Picture, after: Picture, view: View, part: Part, pose: tuple[float, float, float]
) -> Inspection:
    """Compare pictures of a part at `pose` (x, y m, yaw rad) before and after a gasket was put on it.

    Both must be taken with one aim and one target voltage, and with the arm in one place: its shadow is the
    main enemy.

    Raises:
        InvalidInput: the program does not give two holes of the part.
    """
    if len(part.holes) < 2:
        raise InvalidInput("a gasket can be inspected only by two holes; the program gives fewer of the part")
    new, old = Scan(difference(before, after)), Scan(before)
    places = hole_places(part, pose)[:2]
    expected = tuple((float(u), float(v)) for u, v in view.project(places))
    level = _level(new, view, part, places)
    if level < ABSENT:
        return Inspection(
            ok=False,
            sentence="no gasket: the picture after shows nothing new where it should be",
            expected=expected,
            found=(None, None),
            shift=None,
        )
    face, dark = np.percentile(_about(old, expected), [92, 12])
    steps = _Steps(
        after=max(STEP[0], STEP[1] * level),
        before=max(2.0, BEFORE_STEP * float(face - dark)),
        face=BRIGHT * float(face),
    )
    checks = [
        _check(new, old, view, place, hole, steps) for place, hole in zip(places, part.holes, strict=False)
    ]
    faults = [f"{name} {check.fault}" for name, check in zip(_NAMES, checks, strict=True) if check.fault]
    return Inspection(
        ok=not faults,
        sentence="; ".join(faults) or "the gasket is on properly",
        expected=expected,
        found=tuple(check.found for check in checks),
        shift=max((check.shift for check in checks if check.shift is not None), default=None),
    )


_NAMES: Final = ("the largest hole", "the second hole")


@dataclass(frozen=True, slots=True, kw_only=True)
class _Steps:
    """Levels: least step across a border in the difference, in the picture before, and what is face there."""

    after: float
    before: float
    face: float


@dataclass(frozen=True, slots=True, kw_only=True)
class _Check:
    """What was found of one hole; `fault` is empty if all is well."""

    fault: str
    found: tuple[float, float] | None = None
    shift: float | None = None


def _check(new: Scan, old: Scan, view: View, place: Array, hole: Hole, steps: _Steps) -> _Check:
    base = place
    for _ in range(2):  # the second time from the middle of the hole, where a beam meets its border squarely
        fitted = _centre(old, view, base, hole, steps.before, steps.face)
        if fitted is None:
            return _Check(fault="of the base is not found in the picture before")
        base = np.array([*fitted, place[2]])
    blob = _hole(new, view, base, hole, steps.after)
    if blob is None:
        return _Check(fault="of the gasket is not found")
    moved = _centre(new, view, base, hole, steps.after)
    bulge = _bulge(new, old, view, base, hole, steps)
    if moved is None or bulge is None:
        return _Check(fault="of the gasket has no round border", found=(blob.u, blob.v))
    off = math.dist(moved, fitted)
    fault = ""
    if off > CENTRE_SHIFT or bulge > RIM_SHIFT:
        fault = f"of the gasket is off by about {max(bulge, off) / INCH:.2f} in"
    return _Check(fault=fault, found=(blob.u, blob.v), shift=max(bulge, off))


def _hole(scan: Scan, view: View, place: Array, hole: Hole, step: float) -> Blob | None:
    """The dark blob at a place, shape (3,), m, if it is about as large as the hole."""
    u, v = view.project(place)[0]
    across, down = view.resolution(place)
    blob = characterise(scan, (float(u), float(v)), step, 1.1 * hole.diameter * across, wide=True)
    if blob is None:
        return None
    size = np.sqrt(max(blob.width * blob.height, 0.0) / (across * down))
    return blob if 0.6 < size / hole.diameter < 1.6 else None


def _centre(
    scan: Scan, view: View, place: Array, hole: Hole, step: float, beyond: float = 0.0
) -> tuple[float, float] | None:
    """Centre (x, y), m, of the hole whose border is seen about a place, shape (3,), m."""
    return fit_circle(view, _border(scan, view, place, hole, step, beyond), float(place[2]), hole.diameter)


def _border(scan: Scan, view: View, place: Array, hole: Hole, step: float, beyond: float) -> Array:
    u, v = view.project(place)[0]
    reach = 0.9 * hole.diameter * view.resolution(place)[0]
    return rim(scan, (float(u), float(v)), step, reach, rays=RAYS, wide=True, beyond=beyond)


def _bulge(new: Scan, old: Scan, view: View, centre: Array, hole: Hole, steps: _Steps) -> float | None:
    """How far the border of the difference bulges outwards about the base's hole at `centre`, shape (3,), m.

    Against its own median radius: half of the border of a union of two discs is nearly undisturbed. Only
    where the base's border is seen in the picture before: an aligning pin may stand in front of it.
    """
    radii = []
    for scan, step, beyond in ((old, steps.before, steps.face), (new, steps.after, 0.0)):
        points = _border(scan, view, centre, hole, step, beyond)
        spokes = view.back_project(points, float(centre[2])) - centre
        radii.append(np.hypot(spokes[:, 0], spokes[:, 1]))
    clear = np.abs(radii[0] - hole.diameter / 2) < CLEAR
    clear &= np.roll(clear, 1) & np.roll(clear, -1)
    neighbours = np.stack([np.roll(radii[1], -1), radii[1], np.roll(radii[1], 1)])
    smooth = np.median(neighbours, axis=0)[clear]
    smooth = smooth[~np.isnan(smooth)]
    return float(smooth.max() - np.median(smooth)) if len(smooth) >= RAYS // 3 else None


def _level(scan: Scan, view: View, part: Part, places: Array) -> float:
    """Median difference around the holes, where there is gasket and nothing else."""
    angles = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    ring = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(24)])
    around = [
        place + ring * (hole.diameter / 2 + BESIDE) for place, hole in zip(places, part.holes, strict=False)
    ]
    return float(np.median([scan.patch(u, v, 1).mean() for u, v in view.project(np.vstack(around))]))


def _about(scan: Scan, expected: Sequence[tuple[float, float]]) -> Array:
    """Intensities about the two holes."""
    u, v = np.mean(expected, axis=0)
    return scan.patch(float(u), float(v), round(math.dist(*expected)))[::4, ::4]
