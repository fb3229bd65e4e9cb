"""Marks that show the findings in a picture. Their coordinates are in picture points.

The box of general location is white. Each hole has a red cross and a yellow box, and a red line joins the centres of
the two holes. The line of the first grasp is blue. Picture 10 of the paper shows the line between the holes and the
line of the grasp. Red crosses mark the expected centres of a gasket's holes. Discs mark the centres that were found:
green discs if the gasket is in place, and red discs if not. If a part is checked again, its outline is green if the
part stands as before, and red if not.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.core.pose import Pose
from handeye.ports.camera import COLUMNS, ROWS
from handeye.vision.base import GeneralLocation, PartMatch, SpecificLocation
from handeye.vision.camera_model import View
from handeye.vision.gasket import GasketInspection

GraspLine = tuple[tuple[float, float], tuple[float, float]]  # two ends (u, v)


def grasp_line(view: View, X_WT: Pose, gap: float, z: float) -> GraspLine | None:
    """Return the line between the two fingers, which are `gap` (m) apart. The line is projected from the hand down to
    the height `z` (m in W). Returns None unless this line lies within the picture.
    """
    ends = X_WT[:3, 3] + np.array([[-0.5], [0.5]]) * gap * X_WT[:3, 1]
    ends[:, 2] = z
    (u, v), (across, down) = view.project(ends).tolist()
    if not (0 <= min(u, across) <= max(u, across) < COLUMNS and 0 <= min(v, down) <= max(v, down) < ROWS):
        return None
    return (u, v), (across, down)


Colour = tuple[int, int, int]  # red, green, blue, 0 to 255
Point = tuple[float, float]  # u, v from the centre of the first point

WHITE: Final = (255, 255, 255)
RED: Final = (235, 40, 40)
YELLOW: Final = (240, 220, 0)
GREEN: Final = (60, 200, 90)
BLUE: Final = (40, 110, 255)
BOLD: Final = 2 / 3
THIN: Final = 1 / 3
ARM: Final = 4.0  # arm length of a cross, and diameter of a disc, in points


@dataclass(frozen=True, slots=True, kw_only=True)
class Loop:
    """A closed line through points; `width` is in picture points."""

    points: tuple[Point, ...]
    colour: Colour
    width: float = THIN


@dataclass(frozen=True, slots=True, kw_only=True)
class Line:
    """A line; `width` is in picture points."""

    ends: tuple[Point, Point]
    colour: Colour
    width: float = THIN


@dataclass(frozen=True, slots=True, kw_only=True)
class Disc:
    """A filled circle; `diameter` is in picture points."""

    centre: Point
    colour: Colour
    diameter: float = ARM


Mark = Loop | Line | Disc


def marks(
    *,
    general: GeneralLocation | None = None,
    specific: SpecificLocation | None = None,
    grasp: GraspLine | None = None,
    inspection: GasketInspection | None = None,
    match: PartMatch | None = None,
) -> list[Mark]:
    """Return the marks for the findings in a picture, in the order in which they are drawn."""
    drawn: list[Mark] = []
    if general:
        left, top, right, bottom = general.box
        drawn.append(_box(left, top, right, bottom, WHITE, BOLD))
    if specific:
        first, second = specific.holes
        drawn.append(Line(ends=((first.u, first.v), (second.u, second.v)), colour=RED))
        for hole in specific.holes:
            u, v, w, h = hole.u, hole.v, hole.width / 2, hole.height / 2
            drawn += [_box(u - w, v - h, u + w, v + h, YELLOW, THIN), *_cross(u, v)]
    if grasp:
        drawn.append(Line(ends=grasp, colour=BLUE, width=BOLD))
    if inspection:
        drawn += [mark for u, v in inspection.expected for mark in _cross(u, v)]
        colour = GREEN if inspection.ok else RED
        drawn += [Disc(centre=found, colour=colour) for found in inspection.found if found]
    if match:
        drawn.append(Loop(points=match.outline, colour=GREEN if match.ok else RED, width=BOLD))
    return drawn


def _box(left: float, top: float, right: float, bottom: float, colour: Colour, width: float) -> Mark:
    corners = ((left, top), (right, top), (right, bottom), (left, bottom))
    return Loop(points=corners, colour=colour, width=width)


def _cross(u: float, v: float) -> list[Mark]:
    along, down = ((u - ARM, v), (u + ARM, v)), ((u, v - ARM), (u, v + ARM))
    return [Line(ends=ends, colour=RED, width=BOLD) for ends in (along, down)]
