"""The collision shapes of the base's casting: walls of wedges around the two large holes, and the metal beside the
tapped holes. In the simulation, only pins and screws collide with this metal.
"""

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import mujoco
import numpy as np

from handeye.cell.looks import MESH
from handeye.tasks.stanford_cell.dimensions import Dimensions, Point, base_top, dimensions
from handeye.tasks.stanford_cell.shapes import Bore, Shaper

_WEDGES = 24  # number of wedges around a large hole; each covers 15 degrees
_WEDGE = 2 * math.pi / _WEDGES  # rad


class _Wall(NamedTuple):
    """The wall of solid metal around a large hole, and the tapped holes in it."""

    name: str
    x: float  # of the axis, m
    inner: float  # radius, m
    outer: float  # radius, m
    mouths: list[tuple[float, float]]
    """For each tapped hole in the wall, two directions (rad), as seen from the axis of the wall. The mouth of the hole
    lies between these directions.
    """

    def style(self, angle: float) -> str:
        """Return the default class of the wedge at `angle` (rad). A wedge that contains a part of a tapped hole
        collides only with the hand and the driver, so that a screw can enter the hole.
        """
        for low, high in self.mouths:
            away = abs(math.remainder((low + high) / 2 - angle, 2 * math.pi))
            if away < (_WEDGE + high - low) / 2:
                return "pierced"
        return "face"

    def rests(self) -> Iterator[list[Point]]:
        """Yield the solid metal that remains in the pierced wedges: for either side of each tapped hole, the corners
        (m) of the metal between the mouth of the hole and the next wedge that is not pierced.
        """
        for low, high in self.mouths:
            right = _WEDGE * (math.floor(low / _WEDGE + 0.5) - 0.5)
            left = _WEDGE * (math.ceil(high / _WEDGE - 0.5) + 0.5)
            for begins, ends in ((right, low), (high, left)):
                radii = (self.inner / math.cos((ends - begins) / 2), self.outer)
                yield [(self.x + r * math.cos(a), r * math.sin(a)) for r in radii for a in (begins, ends)]


def add_casting(shaper: Shaper, body: mujoco.MjsBody, holes: Sequence[Point]) -> None:
    """Add walls of solid metal around the large holes, the floor of the first, and the spout. `holes` are the places of
    the tapped holes (m).
    """
    d = dimensions()
    floor, top = d("base.plate.thickness"), base_top()
    for wall in _walls(d, holes):
        ring = Bore(radius=wall.inner, outer=wall.outer, height=top - floor, sectors=_WEDGES)
        shaper.ring(body, wall.name, ring, (wall.x, 0.0, floor), wall.style)
    depth = top - d("base.large_hole_1.depth")
    radius = d("base.large_hole_1.diameter") * 0.51
    shaper.cylinder(body, "face", radius, (0, 0, floor), (0, 0, depth), name="floor_1")
    x0, y0, x1, y1 = d.all("base.casting.spout")
    shaper.box(body, "wall", (x0, y0, floor), (x1, y1, top), name="spout")


def add_metal_beside_holes(shaper: Shaper, body: mujoco.MjsBody, holes: Sequence[Point]) -> None:
    """Add the parts of the casting's face that the walls do not provide: in pierced wedges, between the walls and the
    straight sides of the outline, in the ear and in the spout. A pin or a screw that misses its hole stands on this
    metal.
    """
    d = dimensions()
    top = base_top()
    floor = top - d("base.screw_holes.depth")
    first, second = walls = _walls(d, holes)
    pieces = [corners for wall in walls for corners in wall.rests()]
    pieces += [[(x, side * y) for x, y in _flank(first, second)] for side in (-1, 1)]
    for number, corners in enumerate(pieces):
        mesh = shaper.convex(
            f"metal{number}", np.array([(x, y, z) for x, y in corners for z in (floor, top)])
        )
        body.add_geom(shaper.style("tap"), type=MESH, meshname=mesh)
    direction, reach = d("base.casting.ear_direction"), d("base.casting.ear_radius")
    x, y = reach * math.cos(direction), reach * math.sin(direction)
    shaper.cylinder(body, "tap", d("base.casting.ear_diameter") / 2, (x, y, floor), (x, y, top))
    x0, y0, x1, _ = d.all("base.casting.spout")
    edge = -math.sqrt(first.outer**2 - x1**2)  # where the sides of the spout leave the first wall
    shaper.box(body, "tap", (x0, y0, floor), (x1, edge, top))


def _walls(d: Dimensions, holes: Sequence[Point]) -> tuple[_Wall, _Wall]:
    """Return the walls around the first and the second large hole."""
    reach = d("base.screw_holes.radius") + d("base.screw_holes.chamfer")

    def wall(name: str, x: float, hole: str, disc: str) -> _Wall:
        inner, outer, mouths = d(hole) / 2, d(disc) / 2, []
        for hole_x, hole_y in holes:
            away, direction = math.hypot(hole_x - x, hole_y), math.atan2(hole_y, hole_x - x)
            if inner - reach < away < outer + reach:
                half = math.asin(reach / away)
                mouths.append((direction - half, direction + half))
        return _Wall(name, x, inner, outer, mouths)

    return (
        wall("wall_1", 0.0, "base.large_hole_1.diameter", "base.casting.chamber_diameter"),
        wall("wall_2", d("base.large_hole_2.x"), "base.large_hole_2.diameter", "base.casting.inlet_diameter"),
    )


def _flank(first: _Wall, second: _Wall) -> list[Point]:
    """Return the corners (m) of the metal between the two walls and the left straight side of the outline: the ends of
    this side, and the point where the walls meet.
    """
    r1, r2, apart = first.outer, second.outer, second.x
    cosine = (r1 - r2) / apart  # of the direction in which the straight side faces
    sine = math.sqrt(1 - cosine**2)
    x = (r1**2 - r2**2 + apart**2) / (2 * apart)
    return [(r1 * cosine, r1 * sine), (apart + r2 * cosine, r2 * sine), (x, math.sqrt(r1**2 - x**2))]
