"""Locates a part that has large round holes. The first stage is general location by the outline of the part; the
second is specific location by its holes.

The part stands upright in a given region, on a darker background, turned by at most 50 degrees from its planned
orientation. The height of the part is known, so one picture is enough: rays through the holes are intersected with the
plane of the upper face.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.core.errors import BadArgument
from handeye.core.pose import Array
from handeye.core.units import DEGREE, INCH
from handeye.ports.camera import COLUMNS, ROWS, Picture
from handeye.program.diagnosis.causes import NoHoles, NoOutline, OutsidePicture, PartAstray, SightCause
from handeye.program.program import Part
from handeye.vision.blob import BoundingBox, localise
from handeye.vision.camera_model import View
from handeye.vision.hole_search import (
    SEARCHES,
    Candidate,
    HoleFinder,
    Levels,
    Pair,
    classify,
    dark_screw_holes,
    placed,
)
from handeye.vision.scan import Scan
from handeye.vision.shaded import locate_shaded

TURNS: Final = np.linspace(-40, 40, 9) * DEGREE
WIDTHS: Final = (0.8, 1.2)
HEIGHTS: Final = (0.75, 1.25)  # accepted box sizes, relative to those that the model gives for all TURNS
# All figures above: vision study, section 1.2.

Rectangle = tuple[float, float, float, float]  # from x, y to x, y, in part coordinates, m


def fitting(view: View, part: Part) -> Callable[[BoundingBox], bool]:
    """Make a function that returns True if a box can be the box around the part's outline."""
    sizes = np.ptp(silhouettes(view, part, part.at[:2], TURNS), axis=1)
    smallest = sizes.min(axis=0) * (WIDTHS[0], HEIGHTS[0])
    largest = sizes.max(axis=0) * (WIDTHS[1], HEIGHTS[1])

    def fits(box: BoundingBox) -> bool:
        size = (box.width, box.height)
        return bool(np.all(size >= smallest) and np.all(size <= largest))

    return fits


def window(view: View, part: Part, shrink: float = 0.0) -> Array:
    """Return the corners (u, v) of the region where the part may be, shape (4, 2). Each side is moved inwards by
    `shrink` (m).
    """
    assert part.region is not None
    assert part.outline is not None
    x, y, z, yaw = part.at
    reach = _rotated(part.outline, yaw + TURNS).reshape(-1, 2)
    lo = np.array([x, y]) - part.region + reach.min(axis=0) + shrink
    hi = np.array([x, y]) + part.region + reach.max(axis=0) - shrink
    corners = np.array([[lo[0], lo[1]], [hi[0], lo[1]], [hi[0], hi[1]], [lo[0], hi[1]]])
    return view.project(np.column_stack([corners, np.full(4, z)]))


def _rotated(outline: Rectangle, yaws: Array) -> Array:
    """Turn an outline about the reference point by `yaws` (rad), shape (n,). Returns the corners of the turned
    outlines (in metres, shape (n, 4, 2)).
    """
    x0, y0, x1, y1 = outline
    corners = np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]])
    c, s = np.cos(yaws), np.sin(yaws)
    return np.asarray(corners @ np.array([[c, s], [-s, c]]).transpose(2, 0, 1))


def silhouettes(view: View, part: Part, place: tuple[float, float] | Array, turns: Array) -> Array:
    """Project the corners of the outline, at the bottom and at the top of the part, into the picture. Returns eight
    picture points for each turn, shape (n, 8, 2).
    """
    assert part.outline is not None
    corners = _rotated(part.outline, part.at[3] + turns) + np.asarray(place)
    solid = np.empty((len(corners), 2, 4, 3))
    solid[..., :2] = corners[:, None]
    solid[:, 0, :, 2], solid[:, 1, :, 2] = part.at[2], part.at[2] + part.face
    return view.project(solid.reshape(-1, 3)).reshape(-1, 8, 2)


OUTLINE_STEP: Final = 2.0  # levels, from background to part
SHRINK: Final = (0.0, 0.6 * INCH, 1.2 * INCH)
"""Distances (m) by which the sides of the window are moved inwards, tried one after another. If the camera model is
inaccurate, neighbouring parts may reach into the window.
"""
SCREW_HOLES: Final = 2 / 3  # fraction that must be visible at the places given by the two large holes

# All figures above: vision study, sections 1.2 and 1.3.


@dataclass(frozen=True, slots=True, kw_only=True)
class Failure:
    """The reason why a part could not be located."""

    cause: SightCause


@dataclass(frozen=True, slots=True, kw_only=True)
class GeneralLocation:
    """Rough position of a part: the position of the part's reference point (m in W), accurate to an inch or two. Only
    x and y are measured in the picture; all other values are as planned.
    """

    box: BoundingBox  # box around the part in the picture
    x: float
    y: float
    corners: tuple[tuple[float, float, float], ...]  # corners of the box at half the part's height, m
    beams: int
    points: int  # beams and points read determine the processing time


@dataclass(frozen=True, slots=True, kw_only=True)
class SeenHole:
    """A large hole: its centre and size in picture points, and its centre (m in W) on the upper face."""

    u: float
    v: float
    width: float
    height: float
    x: float
    y: float


@dataclass(frozen=True, slots=True, kw_only=True)
class SpecificLocation:
    """Pose of a part, found from its holes."""

    pose: tuple[float, float, float]  # x, y (m), yaw (rad) in W, by fitted circles
    bounce_pose: tuple[float, float, float]  # pose from the bouncing characteriser alone, as in 1973
    holes: tuple[SeenHole, SeenHole]  # largest first; centres by fitted circles
    screw_holes: int  # number of screw holes seen at their expected places
    beams: int
    points: int


def locate_general(picture: Picture, view: View, part: Part) -> GeneralLocation | Failure:
    """Find the outline of a part in a picture of the region where the part may be. If a shadow lies on the part, the
    outline may not stand out. In this case, find the two large holes of the part. Raises BadArgument if the part has
    no outline or no region.
    """
    if part.region is None or part.outline is None:
        raise BadArgument("vision needs the region and the outline of a part, but one of them is missing")
    fits, scan = fitting(view, part), Scan(picture)
    for shrink in SHRINK:
        box = localise(
            scan, window(view, part, shrink), OUTLINE_STEP, fits, whole=False
        )  # `fits` decides by size whether the box is the part
        if box is not None:
            return _general(scan, view, part, box)
    shaded = locate_shaded(scan, view, part) if len(part.holes) > 1 else None
    return Failure(cause=NoOutline()) if shaded is None else _placed(scan, view, part, shaded)


def _placed(scan: Scan, view: View, part: Part, pose: tuple[float, float, float]) -> GeneralLocation:
    """Return the location of a part whose pose is roughly known."""
    x, y, yaw = pose
    (outline,) = silhouettes(view, part, (x, y), np.array([yaw - part.at[3]]))
    box = BoundingBox(*np.rint([*outline.min(axis=0), *outline.max(axis=0)]).astype(int).tolist())
    return _located(scan, view, part, box, (x, y))


def _general(scan: Scan, view: View, part: Part, box: BoundingBox) -> GeneralLocation:
    middle_z = part.at[2] + part.face / 2
    seen = view.back_project(box.corners().mean(axis=0), middle_z)[0, :2]
    xy = np.array(part.at[:2])
    for _ in range(2):  # the offset from box to reference point changes a little with the place
        (outline,) = silhouettes(view, part, xy, np.zeros(1))
        middle = (outline.min(axis=0) + outline.max(axis=0)) / 2
        xy = xy + seen - view.back_project(middle, middle_z)[0, :2]
    return _located(scan, view, part, box, (float(xy[0]), float(xy[1])))


def _located(
    scan: Scan, view: View, part: Part, box: BoundingBox, place: tuple[float, float]
) -> GeneralLocation:
    corners = view.back_project(box.corners(), part.at[2] + part.face / 2)
    return GeneralLocation(
        box=box,
        x=place[0],
        y=place[1],
        corners=tuple((float(x), float(y), float(z)) for x, y, z in corners),
        beams=scan.beams,
        points=scan.points,
    )


def locate_specific(
    picture: Picture, view: View, part: Part, general: GeneralLocation
) -> SpecificLocation | Failure:
    """Find the two largest holes of a part in a close-up picture, and compute the pose of the part from them. The
    part must have two holes.
    """
    if len(part.holes) < 2:
        raise BadArgument("two holes are needed to locate a part, but the program gives fewer")
    scan = Scan(picture)
    box = close_box(view, general)
    if box is None:
        return Failure(cause=OutsidePicture())
    levels = Levels.measure(scan, box)
    middle = view.back_project(box.corners().mean(axis=0), part.at[2] + part.face)[0]
    resolution = view.resolution(middle)
    finders = [HoleFinder(scan, view, part, resolution, levels, search) for search in SEARCHES]
    most = 0
    for finder, found in _found(finders, (general.x, general.y), box):
        most = max(most, len(found))
        pair = classify(found, part)
        location = pair and _confirm(scan, view, part, pair, finder, levels)
        if location:
            return location
    return Failure(cause=NoHoles(blobs=most))


def _found(
    finders: list[HoleFinder], place: tuple[float, float], box: BoundingBox
) -> Iterator[tuple[HoleFinder, list[Candidate]]]:
    """Yield candidates for the holes: first near the expected places, then anywhere in the box with each finder. At
    the end, search near the expected places again, in case a shadow covers a hole.
    """
    yield finders[0], finders[0].expected(place)
    for finder in finders:
        yield finder, finder.all_over(box)
    yield finders[0], finders[0].expected(place, shaded=True)


def close_box(view: View, general: GeneralLocation) -> BoundingBox | None:
    """Return the box of a general location in this view, or None if too little of the box is in the picture."""
    uv = view.project(np.array(general.corners))
    left, top = (int(n) for n in np.floor(uv.min(axis=0)))
    right, bottom = (int(n) for n in np.ceil(uv.max(axis=0)))
    box = BoundingBox(max(left, 4), max(top, 4), min(right, COLUMNS - 5), min(bottom, ROWS - 5))
    return box if box.width > 40 and box.height > 40 else None


def _confirm(
    scan: Scan, view: View, part: Part, pair: Pair, finder: HoleFinder, levels: Levels
) -> SpecificLocation | None:
    """Return the location found from a pair of holes. Returns None if the borders are not round or the screw holes
    are missing.
    """
    centres = finder.refined(pair)
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
        points=scan.points,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class PartMatch:
    """Result of comparing a part in two pictures."""

    cause: PartAstray | None  # None: the part stands as before
    outline: tuple[tuple[float, float], ...]  # expected in the second picture, corners (u, v)
    shift: float  # m, relative to its surroundings, at the height of its face
    unlike: float  # fraction of its points that look different, after aligning

    @property
    def ok(self) -> bool:
        """True if the part stands where it stood in the earlier picture."""
        return self.cause is None
