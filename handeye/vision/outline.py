"""The outline of a part in a picture: where it may be, and how large its box can be."""

from collections.abc import Callable
from typing import Final

import numpy as np

from handeye.core.pose import Array
from handeye.core.units import DEGREE
from handeye.program.program import Part
from handeye.vision.blob import BoundingBox
from handeye.vision.camera_model import View

TURNS: Final = np.linspace(-40, 40, 9) * DEGREE
WIDTHS: Final = (0.8, 1.2)
HEIGHTS: Final = (0.75, 1.25)
"""Accepted box size, over the range the model gives for all TURNS."""
# All figures above: vision study, section 1.2.

Rectangle = tuple[float, float, float, float]
"""x, y from, x, y to, part coordinates, m."""


def fitting(view: View, part: Part) -> Callable[[BoundingBox], bool]:
    """A test whether a box can be that of the part's outline."""
    sizes = np.ptp(silhouettes(view, part, part.at[:2], TURNS), axis=1)
    smallest = sizes.min(axis=0) * (WIDTHS[0], HEIGHTS[0])
    largest = sizes.max(axis=0) * (WIDTHS[1], HEIGHTS[1])

    def fits(box: BoundingBox) -> bool:
        size = (box.width, box.height)
        return bool(np.all(size >= smallest) and np.all(size <= largest))

    return fits


def window(view: View, part: Part, shrink: float = 0.0) -> Array:
    """Corners (u, v) of the region where the part may be, shape (4, 2), smaller on each side by `shrink` (m)."""
    assert part.region is not None
    assert part.outline is not None
    x, y, z, yaw = part.at
    reach = _rotated(part.outline, yaw + TURNS).reshape(-1, 2)
    lo = np.array([x, y]) - part.region + reach.min(axis=0) + shrink
    hi = np.array([x, y]) + part.region + reach.max(axis=0) - shrink
    corners = np.array([[lo[0], lo[1]], [hi[0], lo[1]], [hi[0], hi[1]], [lo[0], hi[1]]])
    return view.project(np.column_stack([corners, np.full(4, z)]))


def _rotated(outline: Rectangle, yaws: Array) -> Array:
    """Corners turned about the reference point by `yaws`, shape (n,); shape (n, 4, 2)."""
    x0, y0, x1, y1 = outline
    corners = np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]])
    c, s = np.cos(yaws), np.sin(yaws)
    return np.asarray(corners @ np.array([[c, s], [-s, c]]).transpose(2, 0, 1))


def silhouettes(view: View, part: Part, place: tuple[float, float] | Array, turns: Array) -> Array:
    """Picture points of the outline's corners on the ground and on top, shape (n, 8, 2), for each turn."""
    assert part.outline is not None
    corners = _rotated(part.outline, part.at[3] + turns) + np.asarray(place)
    solid = np.empty((len(corners), 2, 4, 3))
    solid[..., :2] = corners[:, None]
    solid[:, 0, :, 2], solid[:, 1, :, 2] = part.at[2], part.at[2] + part.face
    return view.project(solid.reshape(-1, 3)).reshape(-1, 8, 2)
