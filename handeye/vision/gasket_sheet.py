"""Measures how much of the base's face a gasket leaves bare.

A gasket changes the intensity of the face that it covers, in light and in shadow. Where a piece of the gasket is
missing, the face looks the same in the pictures before and after the gasket was laid. A pin also looks the same in
both pictures, but its intensity usually differs from that of the face. Therefore, a point counts only if it looks like
the face in the picture without the gasket.
"""

from typing import Final

import cv2
import numpy as np

from handeye.core.pose import Array
from handeye.core.units import INCH
from handeye.ports.camera import Picture
from handeye.program.program import Part
from handeye.vision.alignment import Points, aligned, smooth
from handeye.vision.camera_model import View

MAX_BARE: Final = 40e-6
"""Greatest permitted bare area (m2) in a square with the side WINDOW (m).

In 139 worlds without faults, the greatest measured area was 21 mm2. The mean plus five standard deviations was 34 mm2
in 60 worlds of the nominal level, and 30 mm2 in 79 worlds of the high level. Most of the measured area is due to the
edges of pins.
"""
WINDOW: Final = 0.6 * INCH
WALL: Final = 0.4 * INCH  # width (m) of the examined sheet around a large hole; drawn: at least .575 in
LAND: Final = 0.25 * INCH  # radius (m) of the sheet that is examined around a screw hole; drawn: .374 in
FOOT: Final = 0.2 * INCH  # radius (m) around a screw hole that is not examined, because a pin may stand there
COVERED: Final = 0.25  # least relative change of a point that the gasket certainly covers
COMMON: Final = 0.05  # least share of a level, among the covered points, for it to be a level of the face
NEAR: Final = 1.0  # greatest deviation of a point from a level of the face, levels
BARE: Final = 0.5  # greatest change of a bare point, as a fraction of the usual change at its level
_TURNS: Final = np.linspace(0, 2 * np.pi, 64, endpoint=False)
_CIRCLE: Final = np.column_stack([np.cos(_TURNS), np.sin(_TURNS), np.zeros(64)])


def bare(before: Picture, after: Picture, view: View, part: Part, large: list[Array]) -> float:
    """Return the greatest area (m2) that the gasket leaves bare within any square with sides of length WINDOW.

    `large` are the centres (in metres, each of shape (3,)) of the two large holes of the base, as found in the picture
    without the gasket.
    """
    old = smooth(before)
    change = np.abs(smooth(aligned(after, to=before)) - old)
    sheet, level = _sheet(old.shape, view, part, large), old.round().astype(np.intp)
    covered = sheet & (change > COVERED * old)
    counts, usual = np.bincount(level[covered]), np.zeros(old.shape)
    for k in np.flatnonzero(counts > COMMON * counts.sum()):
        usual[np.abs(old - k) <= NEAR] = np.median(change[covered & (level == k)])
    still = (sheet & (change < BARE * usual)).astype(np.float32)
    across, down = view.resolution(large[0])
    square = round(WINDOW * across), round(WINDOW * down)
    sums = cv2.boxFilter(still, -1, square, normalize=False, borderType=cv2.BORDER_CONSTANT)
    return float(sums.max()) / (across * down)


def _sheet(shape: tuple[int, ...], view: View, part: Part, large: list[Array]) -> Points:
    """Return a mask of the sheet that is examined: the convex hull of the surroundings of all holes, without the
    holes."""
    screws, holes = _screw_holes(part, large), list(zip(large, part.holes, strict=False))
    around = [(place, hole.diameter / 2 + WALL) for place, hole in holes] + [
        (place, LAND) for place in screws
    ]
    within = [(place, hole.diameter / 2) for place, hole in holes] + [(place, FOOT) for place in screws]
    mask = np.zeros(shape, np.uint8)
    corners = np.concatenate([_seen(view, *disc) for disc in around])
    cv2.fillConvexPoly(mask, cv2.convexHull(corners), 1)
    for disc in within:
        cv2.fillConvexPoly(mask, _seen(view, *disc), 0)
    return mask.astype(np.bool_)


def _screw_holes(part: Part, large: list[Array]) -> list[Array]:
    """Return the centres of the screw holes (in metres, shape (3,)). The positions and the scale of the screw holes
    are computed from the large holes in the picture, because the scale of the camera may be wrong.
    """
    first, second = (complex(*place[:2]) for place in large)
    drawn, other = (complex(hole.x, hole.y) for hole in part.holes[:2])
    places = [
        first + (complex(hole.x, hole.y) - drawn) * (second - first) / (other - drawn)
        for hole in part.screw_holes
    ]
    return [np.array([place.real, place.imag, large[0][2]]) for place in places]


def _seen(view: View, centre: Array, radius: float) -> Array:
    """Return the border of a disc in the picture, in whole points (u, v), shape (64, 2)."""
    return np.asarray(view.project(centre + radius * _CIRCLE).round().astype(np.int32))
