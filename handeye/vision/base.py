"""Locating a part with large round holes, in two stages: roughly by its outline, then closely by its holes.

The part lies upright in a stated region, on a darker background, turned by at most 50 degrees from plan. Its
height is known, so that one picture is enough: rays through the holes meet the plane of its upper face.
"""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.errors import InvalidInput
from handeye.ports.camera import COLUMNS, ROWS, Picture
from handeye.pose import Array
from handeye.program.causes import NoHoles, NoOutline, OutsidePicture, SightCause
from handeye.program.program import Part
from handeye.units import DEGREE, INCH
from handeye.vision.beam import Scan
from handeye.vision.blob import BoundingBox, localise
from handeye.vision.camera_model import View
from handeye.vision.holes import (
    SEARCHES,
    HoleSearch,
    Levels,
    Pair,
    candidates,
    classify,
    dark_screw_holes,
    placed,
    refine,
)

OUTLINE_STEP: Final = 2.0
"""Least step of intensity, levels, from the background to the part."""
SHRINK: Final = (0.0, 0.6 * INCH, 1.2 * INCH)
"""The window is tried again smaller: what is beside the region may reach into it if the camera is off."""
TURNS: Final = np.linspace(-40, 40, 9) * DEGREE
WIDTHS: Final = (0.8, 1.2)
HEIGHTS: Final = (0.75, 1.25)
"""Accepted size of the box, over the range the model gives for all TURNS."""
SCREW_HOLES: Final = 2 / 3
"""Share of the screw holes that must be seen where the two large ones say."""

# All figures above: vision study, sections 1.2 and 1.3.

Rectangle = tuple[float, float, float, float]
"""x from, y from, x to, y to, part coordinates, m."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Failure:
    """Nothing was found."""

    cause: SightCause


@dataclass(frozen=True, slots=True, kw_only=True)
class GeneralLocation:
    """Rough place of a part: within an inch or two."""

    box: BoundingBox
    """Around it in the picture."""
    x: float
    """Of its reference point in W, m, if it lies as planned but for x and y."""
    y: float
    corners: tuple[tuple[float, float, float], ...]
    """The corners of the box at half the part's height, m."""
    beams: int
    points: int
    """Beams sent and picture points read: what the time of processing would follow from."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SeenHole:
    """A large hole in the picture and in the world."""

    u: float
    v: float
    width: float
    """Points."""
    height: float
    x: float
    """Of its centre in W, at the height of the upper face, m."""
    y: float


@dataclass(frozen=True, slots=True, kw_only=True)
class SpecificLocation:
    """Pose of a part."""

    pose: tuple[float, float, float]
    """x, y (m) of the reference point and yaw (rad) in W, by circles fitted to the borders of the holes."""
    bounce_pose: tuple[float, float, float]
    """The same by the bouncing characteriser alone, the way of 1973."""
    holes: tuple[SeenHole, SeenHole]
    """The largest first; centres by the fitted circles. The line of centres joins them."""
    screw_holes: int
    """How many were seen where they should be."""
    beams: int
    points: int


def locate_general(picture: Picture, view: View, part: Part) -> GeneralLocation | Failure:
    """Find a part's outline in a picture of the region where it may be.

    Raises:
        InvalidInput: the program does not say enough of the part.
    """
    region, outline = part.region, part.outline
    if region is None or outline is None:
        raise InvalidInput("vision needs the region and the outline of a part")
    sizes = np.array([np.ptp(_silhouette(view, part, part.at[0], part.at[1], t), axis=0) for t in TURNS])
    smallest = sizes.min(axis=0) * (WIDTHS[0], HEIGHTS[0])
    largest = sizes.max(axis=0) * (WIDTHS[1], HEIGHTS[1])

    def fits(box: BoundingBox) -> bool:
        size = (box.width, box.height)
        return bool(np.all(size >= smallest) and np.all(size <= largest))

    scan = Scan(picture)
    for shrink in SHRINK:
        scan.open()
        box = localise(scan, _window(view, part, region, outline, shrink), OUTLINE_STEP, fits)
        if box is not None:
            return _general(scan, view, part, box)
    return Failure(cause=NoOutline())


def _window(view: View, part: Part, region: tuple[float, float], outline: Rectangle, shrink: float) -> Array:
    """Corners (u, v) of where the part may be, shape (4, 2)."""
    x, y, z, yaw = part.at
    reach = np.array([_rotated(outline, yaw + turn) for turn in TURNS]).reshape(-1, 2)
    lo = np.array([x, y]) - region + reach.min(axis=0) + shrink
    hi = np.array([x, y]) + region + reach.max(axis=0) - shrink
    corners = np.array([[lo[0], lo[1]], [hi[0], lo[1]], [hi[0], hi[1]], [lo[0], hi[1]]])
    return view.project(np.column_stack([corners, np.full(4, z)]))


def _rotated(outline: Rectangle, yaw: float) -> Array:
    """Its corners turned about the reference point, shape (4, 2)."""
    x0, y0, x1, y1 = outline
    c, s = math.cos(yaw), math.sin(yaw)
    corners = np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]])
    return np.asarray(corners @ np.array([[c, s], [-s, c]]))


def _silhouette(view: View, part: Part, x: float, y: float, turn: float = 0.0) -> Array:
    """Picture points of the corners of the part's outline, on the ground and on top, shape (8, 2)."""
    assert part.outline is not None
    corners = _rotated(part.outline, part.at[3] + turn) + np.array([x, y])
    z = np.repeat([part.at[2], part.at[2] + part.face], 4)
    return view.project(np.column_stack([np.vstack([corners, corners]), z]))


def _general(scan: Scan, view: View, part: Part, box: BoundingBox) -> GeneralLocation:
    middle_z = part.at[2] + part.face / 2
    seen = view.back_project(box.corners().mean(axis=0), middle_z)[0, :2]
    xy = np.array(part.at[:2])
    for _ in range(3):  # the offset from box to reference point changes a little with the place
        outline = _silhouette(view, part, *xy)
        middle = (outline.min(axis=0) + outline.max(axis=0)) / 2
        xy = xy + seen - view.back_project(middle, middle_z)[0, :2]
    corners = view.back_project(box.corners(), middle_z)
    return GeneralLocation(
        box=box,
        x=float(xy[0]),
        y=float(xy[1]),
        corners=tuple((float(x), float(y), float(z)) for x, y, z in corners),
        beams=scan.beams,
        points=int(scan.read.sum()),
    )


def locate_specific(
    picture: Picture, view: View, part: Part, general: GeneralLocation
) -> SpecificLocation | Failure:
    """Find a part's two largest holes in a close picture, and from them its pose.

    Raises:
        InvalidInput: the program does not give two holes of the part.
    """
    if len(part.holes) < 2:
        raise InvalidInput("a part can be located only by two holes; the program gives fewer")
    scan = Scan(picture)
    box = _close_box(view, general)
    if box is None:
        return Failure(cause=OutsidePicture())
    levels = Levels.measure(scan, box)
    most: list[int] = []
    for search in SEARCHES:
        found = candidates(scan, view, box, part, levels, search)
        most.append(len(found))
        pair = classify(found, part)
        location = pair and _confirm(scan, view, part, pair, levels, search)
        if location:
            return location
    return Failure(cause=NoHoles(blobs=max(most)))


def _close_box(view: View, general: GeneralLocation) -> BoundingBox | None:
    """The box of general location, as this view sees it."""
    uv = view.project(np.array(general.corners))
    left, top = (int(n) for n in np.floor(uv.min(axis=0)))
    right, bottom = (int(n) for n in np.ceil(uv.max(axis=0)))
    box = BoundingBox(max(left, 4), max(top, 4), min(right, COLUMNS - 5), min(bottom, ROWS - 5))
    return box if box.width > 40 and box.height > 40 else None


def _confirm(
    scan: Scan, view: View, part: Part, pair: Pair, levels: Levels, search: HoleSearch
) -> SpecificLocation | None:
    """The location, unless the borders are not round or the screw holes are not where they should be."""
    centres = refine(scan, view, pair, part, levels, search)
    if centres is None:
        return None
    pose = placed(centres, part)
    dark = dark_screw_holes(scan, view, part, pose, levels.face)
    if dark < math.ceil(SCREW_HOLES * len(part.screw_holes)):
        return None
    z = part.at[2] + part.face
    uv = view.project(np.column_stack([centres, [z, z]]))
    first, second = (
        SeenHole(u=float(u), v=float(v), width=c.blob.width, height=c.blob.height, x=float(x), y=float(y))
        for (u, v), (x, y), c in zip(uv, centres, pair, strict=True)
    )
    return SpecificLocation(
        pose=pose,
        bounce_pose=placed(np.array([[c.x, c.y] for c in pair]), part),
        holes=(first, second),
        screw_holes=dark,
        beams=scan.beams,
        points=int(scan.read.sum()),
    )
