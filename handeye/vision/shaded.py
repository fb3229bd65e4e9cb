"""Finds the rough place of a part on which a shadow lies. The two large holes of the part show where the part is.

In a shadow, a part can be as dark as the lit background, and its outline then does not stand out. Its holes are still
darker than the face around them, because the same shadow lies on both.
"""

import math
from typing import Final

import numpy as np

from handeye.core.pose import Array
from handeye.core.units import DEGREE, INCH
from handeye.program.program import Part
from handeye.vision.camera_model import View
from handeye.vision.hole_search import TURN, placed
from handeye.vision.scan import Scan

GRID: Final = 0.2 * INCH  # distance between the places that are tried: two points of a wide-angle picture
TURN_STEP: Final = 5 * DEGREE  # between the turns that are tried: moves the second hole by about GRID
BEYOND: Final = 1.0 * INCH  # how far outside its region a part can seem to lie: the error of the camera model
WALL: Final = 0.2 * INCH  # distance from the border of a hole at which the face is read
SECTORS: Final = 16  # places around a hole at which the face is read
DARKEST: Final = 3  # number of these places that may be dark: screw holes, or the edge of a shadow
CONTRAST: Final = 2.0  # levels; least difference between face and hole, as between a part and its background

# All figures above are our choice.

_ANGLES: Final = np.linspace(0, 2 * np.pi, SECTORS, endpoint=False)
_RAYS: Final = np.column_stack([np.cos(_ANGLES), np.sin(_ANGLES)])


def locate_shaded(scan: Scan, view: View, part: Part) -> tuple[float, float, float] | None:
    """Find the two large holes of a part. The picture shows the region where the part may be. Returns the pose of the
    part (x, y in m, yaw in rad), or None if no such holes are visible. The part must have a region and two holes.
    """
    assert part.region is not None
    large, small = part.holes[:2]
    beyond = BEYOND + math.hypot(large.x, large.y)
    x, y = (np.arange(-half - beyond, half + beyond, GRID) for half in part.region)
    places = np.array(part.at[:2]) + np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    contrast = _contrast(scan, view, part, places, large.diameter)
    seen = contrast >= CONTRAST
    turns = part.at[3] + np.arange(-TURN, TURN + TURN_STEP / 2, TURN_STEP)
    c, s = np.cos(turns), np.sin(turns)
    along = np.array([small.x - large.x, small.y - large.y]) @ np.array([[c, s], [-s, c]]).transpose(2, 0, 1)
    firsts = np.repeat(places[seen], len(turns), axis=0)
    seconds = firsts + np.tile(along, (int(seen.sum()), 1))
    both = np.minimum(
        np.repeat(contrast[seen], len(turns)), _contrast(scan, view, part, seconds, small.diameter)
    )
    if both.max(initial=0.0) < CONTRAST:
        return None
    return placed(np.array([firsts[both.argmax()], seconds[both.argmax()]]), part)


def _contrast(scan: Scan, view: View, part: Part, centres: Array, diameter: float) -> Array:
    """Return the contrast (levels) between the face around a hole and the darker hole, shape (n,). The n values are
    for n assumed places of the hole's centre, `centres` (m in W, shape (n, 2)).
    """
    wall = _levels(scan, view, part, centres, diameter / 2 + WALL)
    inside = _levels(scan, view, part, centres, diameter / 4)
    return np.asarray(np.sort(wall, axis=1)[:, DARKEST] - np.median(inside, axis=1))


def _levels(scan: Scan, view: View, part: Part, centres: Array, radius: float) -> Array:
    """Return the intensities on circles about `centres`, shape (n, SECTORS)."""
    points = np.full((len(centres), SECTORS, 3), part.at[2] + part.face)
    points[..., :2] = centres[:, None] + radius * _RAYS
    patches = scan.patches(view.project(points.reshape(-1, 3)), 1)
    return np.asarray(patches.mean(axis=(1, 2)).reshape(len(centres), SECTORS))
