"""The vision functions that a calling program can replace, and wrappers for the program's own functions.

A wrapper checks the result of the caller's function. If the result is the place of a part, the wrapper also computes
where a part at this place appears in the picture. Reports mark this place.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from handeye.core.errors import BadArgument
from handeye.core.pose import Array
from handeye.ports.camera import COLUMNS, ROWS, Picture
from handeye.program.diagnosis.causes import CallersVision
from handeye.program.program import Part
from handeye.vision.base import (
    Failure,
    GeneralLocation,
    SeenHole,
    SpecificLocation,
    locate_general,
    locate_specific,
    silhouettes,
)
from handeye.vision.blob import BoundingBox
from handeye.vision.camera_model import View
from handeye.vision.gasket import GasketInspection, inspect
from handeye.vision.hole_search import hole_places

Pose2D = tuple[float, float, float]  # x, y (m) and yaw (rad)
General = Callable[[Picture, View, Part], GeneralLocation | Failure]
Specific = Callable[[Picture, View, Part, GeneralLocation], SpecificLocation | Failure]
Inspect = Callable[[Picture, Picture, View, Part, Pose2D], GasketInspection]


@dataclass(frozen=True, slots=True, kw_only=True)
class VisionFunctions:
    """The functions behind `GENERAL`, `SPECIFIC` and `INSPECT`."""

    general: General = locate_general
    specific: Specific = locate_specific
    inspect: Inspect = inspect


BUILT_IN: Final = VisionFunctions()


def with_functions(functions: Mapping[str, Callable[..., Any]]) -> VisionFunctions:
    """Return the vision functions. If an instruction is a key of `functions`, the given function replaces handeye's
    own function for this instruction.
    """
    return VisionFunctions(**{word.lower(): function for word, function in functions.items()})


def general_by(name: str, function: Callable[..., Any]) -> General:
    """Wrap a function that locates a part. The function takes a picture, its view and the part. It returns the place
    x, y (m) of the part's reference point in W, or None if it does not find the part.
    """

    def locate(picture: Picture, view: View, part: Part) -> GeneralLocation | Failure:
        given = function(picture.copy(), view, part)
        if given is None:
            return Failure(cause=CallersVision(by=name))
        x, y = _numbers(name, given, "the place x, y (m)", 2)
        points = _outline(view, part, (x, y))
        (left, top), (right, bottom) = points.min(axis=0), points.max(axis=0)
        box = BoundingBox(int(left), int(top), int(np.ceil(right)), int(np.ceil(bottom)))
        corners = view.back_project(box.corners(), part.at[2] + part.face / 2)
        around = tuple((float(x), float(y), float(z)) for x, y, z in corners)
        return GeneralLocation(box=box, x=x, y=y, corners=around, beams=0, points=0)

    return locate


def specific_by(name: str, function: Callable[..., Any]) -> Specific:
    """Wrap a function that finds the pose of a part. The function takes a close-up picture, its view, the part, and
    the rough place x, y (m). It returns the pose x, y (m), yaw (rad) of the part in W, or None if it does not find the
    part.
    """

    def locate(
        picture: Picture, view: View, part: Part, general: GeneralLocation
    ) -> SpecificLocation | Failure:
        given = function(picture.copy(), view, part, (general.x, general.y))
        if given is None:
            return Failure(cause=CallersVision(by=name))
        x, y, yaw = _numbers(name, given, "the pose x, y (m), yaw (rad)", 3)
        holes = _holes(view, part, (x, y, yaw))
        return SpecificLocation(
            pose=(x, y, yaw), bounce_pose=(x, y, yaw), holes=holes, screw_holes=0, beams=0, points=0
        )

    return locate


def inspect_by(name: str, function: Callable[..., Any]) -> Inspect:
    """Wrap a function that returns True if a gasket is in place. The function takes two pictures, one taken before and
    one taken after the gasket was laid. It also takes the view, the part under the gasket, and the pose x, y (m), yaw
    (rad) of this part.
    """

    def inspected(before: Picture, after: Picture, view: View, part: Part, pose: Pose2D) -> GasketInspection:
        ok = function(before.copy(), after.copy(), view, part, pose)
        if not isinstance(ok, bool | np.bool_):
            raise BadArgument(f"the function `{name}` must return True or False, not {ok!r}")
        expected = tuple((float(u), float(v)) for u, v in view.project(hole_places(part, pose)[:2]))
        cause = None if ok else CallersVision(by=name)
        return GasketInspection(cause=cause, expected=expected, found=(None, None), shift=None)

    return inspected


def _numbers(name: str, given: object, what: str, count: int) -> tuple[float, ...]:
    try:
        found = tuple(float(each) for each in np.asarray(given, dtype=object).ravel())
    except (TypeError, ValueError):
        found = ()
    if len(found) != count or not np.isfinite(found).all():
        raise BadArgument(f"the function `{name}` must return {what} or None, not {given!r}")
    return found


def _outline(view: View, part: Part, place: tuple[float, float]) -> Array:
    """Return the corners (u, v) of the part's outline at a place, shape (8, 2). Corners outside the picture are moved
    to its border.
    """
    if part.outline is None:
        raise BadArgument("vision needs the outline of a part, but the program gives none")
    (points,) = silhouettes(view, part, place, np.zeros(1))
    return np.asarray(np.clip(points, 0, (COLUMNS - 1, ROWS - 1)))


def _holes(view: View, part: Part, pose: Pose2D) -> tuple[SeenHole, SeenHole]:
    """Return the two largest holes of a part at a pose, as they would appear in the picture."""
    if len(part.holes) < 2:
        raise BadArgument("two holes are needed to locate a part, but the program gives fewer")
    seen = []
    for place, hole in zip(hole_places(part, pose)[:2], part.holes, strict=False):
        ((u, v),), (across, down) = view.project(place).tolist(), view.resolution(place)
        width, height = across * hole.diameter, down * hole.diameter
        seen.append(SeenHole(u=u, v=v, width=width, height=height, x=float(place[0]), y=float(place[1])))
    first, second = seen
    return first, second


WRAPPERS: Final[Mapping[str, Callable[[str, Callable[..., Any]], Any]]] = {
    "GENERAL": general_by,
    "SPECIFIC": specific_by,
    "INSPECT": inspect_by,
}
