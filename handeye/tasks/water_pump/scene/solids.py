"""Makes exact solids of the pump's parts from the parts' dimensions, with manifold3d. The solids serve to display the
parts and to compute clearances.

Making a solid takes longer than compiling the whole scene. Surfaces that are the same in all worlds are
therefore kept for the next world.
"""

import math
from collections.abc import Callable, Sequence
from functools import cache
from itertools import pairwise

import numpy as np
from manifold3d import CrossSection, Manifold, OpType  # type: ignore[import-not-found]  # stubs, but no marker
from numpy.typing import NDArray

from handeye.core.pose import Array
from handeye.tasks.stanford_cell.dimensions import Point, base_top, dimensions, screw_holes, web_centre

Surface = tuple[Array, NDArray[np.int32]]  # vertices, shape (n, 3), m, and triangles, shape (m, 3)

_ROUND = 96
TORN_HOLE = 5  # index of the screw hole that a torn gasket lacks


def disc(radius: float, x: float = 0.0, y: float = 0.0, segments: int = _ROUND) -> CrossSection:
    """Return a round cross-section with a radius and a centre (m)."""
    return CrossSection.circle(radius, segments).translate((x, y))


def rectangle(x0: float, y0: float, x1: float, y1: float, corner: float = 0.0) -> CrossSection:
    """Return a rectangular cross-section between the opposite corners (x0, y0) and (x1, y1). All four corners are
    rounded to the radius `corner` (m).
    """
    if corner == 0.0:
        return CrossSection.square((x1 - x0, y1 - y0)).translate((x0, y0))
    centres = [(x, y) for x in (x0 + corner, x1 - corner) for y in (y0 + corner, y1 - corner)]
    return CrossSection.batch_hull([disc(corner, x, y, 32) for x, y in centres])


def hull(*sections: CrossSection) -> CrossSection:
    """Return the convex hull of cross-sections."""
    return CrossSection.batch_hull(list(sections))


def extruded(section: CrossSection, z0: float, z1: float) -> Manifold:
    """Return the solid that a cross-section forms between two heights (m)."""
    return Manifold.extrude(section, z1 - z0).translate((0.0, 0.0, z0))


def prism(profile: Sequence[Point], y0: float, y1: float) -> Manifold:
    """Return the solid that a profile in the xz plane forms between `y0` and `y1` (m). The profile is a list of its
    corners (x, z) in order, in m.
    """
    upright = Manifold.extrude(CrossSection([list(profile)]), y1 - y0).rotate((90.0, 0.0, 0.0))
    return upright.translate((0.0, y1, 0.0))


def tube(points: Sequence[tuple[float, float, float]], radius: float) -> Manifold:
    """Return a round tube with the radius `radius` (m) along a path through the given points (m)."""
    balls = [Manifold.sphere(radius, 12).translate(point) for point in points]
    return Manifold.batch_boolean([Manifold.batch_hull(list(two)) for two in pairwise(balls)], OpType.Add)


def bore(radius: float, z0: float, z1: float, *, above: float = 0.0, below: float = 0.0) -> Manifold:
    """Return the solid that is subtracted to make a hole from z0 to z1 (m). `above` and `below` are the widths (m) of
    the 45 degree chamfers at its ends.
    """
    hole = Manifold.cylinder(z1 - z0 + 2e-4, radius, radius, _ROUND).translate((0.0, 0.0, z0 - 1e-4))
    if above:
        hole += Manifold.cylinder(above, radius, radius + above, _ROUND).translate((0.0, 0.0, z1 - above))
    if below:
        hole += Manifold.cylinder(below, radius + below, radius, _ROUND).translate((0.0, 0.0, z0))
    return hole


def outline() -> CrossSection:
    """Return the irregular outline that casting, gasket and top share, in part coordinates (m)."""
    d = dimensions()
    chamber, inlet = d("base.casting.chamber_diameter") / 2, d("base.casting.inlet_diameter") / 2
    direction, reach = d("base.casting.ear_direction"), d("base.casting.ear_radius")
    ear = disc(d("base.casting.ear_diameter") / 2, reach * math.cos(direction), reach * math.sin(direction))
    x0, y0, x1, y1 = d.all("base.casting.spout")
    body = CrossSection.batch_hull([disc(chamber), disc(inlet, d("base.large_hole_2.x"))])
    return body + rectangle(x0, y0, x1, y1, 0.004) + ear


@cache
def casting(screws: int) -> Surface:
    """Return the surface of the base's casting. The casting is above the base's plate and has `screws` tapped holes."""
    d = dimensions()
    top, floor = base_top(), d("base.plate.thickness")
    solid = extruded(outline().offset(-0.0012), floor, top) + extruded(outline(), floor, top - 0.0016)
    solid -= bore(d("base.large_hole_1.diameter") / 2, top - d("base.large_hole_1.depth"), top + 1e-5)
    second = bore(d("base.large_hole_2.diameter") / 2, floor, top + 1e-5)
    solid -= second.translate((d("base.large_hole_2.x"), 0.0, 0.0))
    radius, chamfer = d("base.screw_holes.radius"), d("base.screw_holes.chamfer")
    tap = bore(radius, top - d("base.screw_holes.depth"), top, above=chamfer)
    for x, y in screw_holes(screws):
        solid -= tap.translate((x, y, 0.0))
    return surface(solid)


@cache
def plate() -> Surface:
    """Return the surface of the base's plate."""
    d = dimensions()
    x, length, width = d("base.plate.centre_x"), d("base.plate.length"), d("base.plate.width")
    box = rectangle(x - length / 2, -width / 2, x + length / 2, width / 2, 0.004)
    return surface(extruded(box, 0.0, d("base.plate.thickness")))


@cache
def gasket(screws: int, torn: float = 0.0) -> Surface:
    """Return the surface of the gasket. The gasket's large holes have flats that the fingers grip, and are slightly
    wider than the large holes of the base. A square with the side `torn` (m) is missing around screw hole 6.
    """
    d = dimensions()
    over, half = d("gasket.hole_oversize") / 2, d("gasket.web") / 2
    first = disc(d("base.large_hole_1.diameter") / 2 + over)
    second = disc(d("base.large_hole_2.diameter") / 2 + over, d("base.large_hole_2.x"))
    web = rectangle(web_centre() - half, -1.0, web_centre() + half, 1.0)
    section = outline() - (first + second - web)
    for x, y in screw_holes(screws):
        section -= disc(d("gasket.screw_hole_radius"), x, y, 32)
    if torn:
        x, y = screw_holes(screws)[TORN_HOLE]
        section -= rectangle(x - torn / 2, y - torn / 2, x + torn / 2, y + torn / 2)
    return surface(extruded(section, 0.0, d("gasket.thickness")))


@cache
def flange(screws: int) -> Surface:
    """Return the surface of the top's flange, with a clearance hole for each screw."""
    d = dimensions()
    thick = d("top.flange")
    solid = extruded(outline().offset(-0.0008), 0.0, thick) + extruded(outline(), 0.0, thick - 0.001)
    above, below = d("top.chamfer_above"), d("top.chamfer_below")
    hole = bore(d("top.screw_hole_radius"), 0.0, thick, above=above, below=below)
    for x, y in screw_holes(screws):
        solid -= hole.translate((x, y, 0.0))
    return surface(solid)


@cache
def drilled(
    edges: tuple[float, float, float, float], height: float, places: tuple[Point, ...],
    radius: float, depth: float, chamfer: float,
) -> Surface:  # fmt: skip
    """Return the surface of an upright block between the edges (x0, y0, x1, y1), with a blind hole from above
    at each of `places`. All lengths are in m."""
    block = extruded(rectangle(*edges, 0.004), 0.0, height)
    for x, y in places:
        block -= bore(radius, height - depth, height, above=chamfer).translate((x, y, 0.0))
    return surface(block)


def revolved(profile: list[tuple[float, float]], segments: int = 32) -> Manifold:
    """Return the solid that a profile forms when it is revolved about z. The profile is a list of its corners (radius,
    z) in order, in m.
    """
    return Manifold.revolve(CrossSection([profile]), segments)


def surface(solid: Manifold) -> Surface:
    """Return the whole surface of a solid."""
    mesh = solid.to_mesh()
    vertices = np.array(mesh.vert_properties[:, :3], np.float64)  # copies, so that the mesh can be freed
    return vertices, np.array(mesh.tri_verts, np.int32)


def volume_moments(closed: Surface) -> tuple[float, Array, Array]:
    """Return the volume of a solid (m3), its centre of volume (m), and its second moments of volume about the
    axes through that centre (m5)."""
    vertices, triangles = closed
    corners = vertices[triangles]
    volumes = np.linalg.det(corners) / 6
    volume, together = volumes.sum(), corners.sum(axis=1)
    centre = volumes @ together / (4 * volume)
    squares = volumes @ ((corners**2).sum(axis=1) + together**2) / 20 - volume * centre**2
    return float(volume), centre, squares.sum() - squares


def painted(whole: Surface, colour: Callable[[Array, Array], NDArray[np.str_]]) -> dict[str, Surface]:
    """Divide a surface into parts of one colour each. `colour` receives the centres and the unit normals of the
    triangles, each of shape (m, 3). It returns the names of the triangles' colours, shape (m,).
    """
    vertices, triangles = whole
    corners = vertices[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-18)
    names = colour(corners.mean(axis=1), normals)
    parts: dict[str, Surface] = {}
    for name in np.unique(names):
        used, renumbered = np.unique(triangles[names == name], return_inverse=True)
        parts[str(name)] = (vertices[used], renumbered.reshape(-1, 3).astype(np.int32))
    return parts
