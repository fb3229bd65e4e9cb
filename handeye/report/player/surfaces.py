"""Makes the surfaces of the shapes in a scene. A surface consists of triangles, and has a normal at each corner."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, Final, Self

import numpy as np
from numpy.typing import NDArray

from handeye.cell.looks import BOX, CYLINDER, MESH, SPHERE
from handeye.core.pose import Array

SIDES: Final = 32  # Sides of the prism that stands for a cylinder
CREASE: Final = np.cos(np.radians(35.0))
"""Cosine of an angle. If the normals of two adjacent faces differ by this angle or more, the edge between the faces is
drawn as sharp. If they differ by less, the faces are drawn as one curved surface.
"""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Surface:
    """A surface made of triangles."""

    points: Array  # Corners, shape (n, 3), m
    normals: Array  # Normals of the surface at the corners, shape (n, 3)
    triangles: NDArray[np.int64]  # Numbers of corners, shape (m, 3), counterclockwise from outside

    @classmethod
    def joined(cls, surfaces: Sequence[Self]) -> Self:
        """Join several surfaces to one, in order."""
        first = np.cumsum([0, *(len(surface.points) for surface in surfaces)])
        return cls(
            points=np.concatenate([surface.points for surface in surfaces]),
            normals=np.concatenate([surface.normals for surface in surfaces]),
            triangles=np.concatenate(
                [surface.triangles + k for surface, k in zip(surfaces, first, strict=False)]
            ),
        )


def surface(model: Any, shape: int) -> Surface | None:
    """Return the surface of a shape, in the frame of the shape's body. Returns None if the shape has no surface."""
    kind, size = model.geom_type[shape], model.geom_size[shape]
    if kind == BOX:
        local = _scaled(_box(), size)
    elif kind == CYLINDER:
        local = _scaled(_cylinder(), size[[0, 0, 1]])
    elif kind == SPHERE:
        local = _scaled(_ball(), size[[0, 0, 0]])
    elif kind == MESH:
        mesh = model.geom_dataid[shape]
        first, corner = model.mesh_vertadr[mesh], model.mesh_faceadr[mesh]
        points = model.mesh_vert[first : first + model.mesh_vertnum[mesh]].astype(float)
        triangles = model.mesh_face[corner : corner + model.mesh_facenum[mesh]].astype(np.int64)
        distinct, number = _distinct(points)
        local = creased(points[distinct], number[triangles])
    else:
        return None
    R = rotation(model.geom_quat[shape])
    return Surface(
        points=local.points @ R.T + model.geom_pos[shape],
        normals=local.normals @ R.T,
        triangles=local.triangles,
    )


def rotation(quaternion: Array) -> Array:
    """Return the rotation matrix, shape (3, 3), of a unit quaternion w, x, y, z."""
    w, x, y, z = quaternion
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def creased(points: Array, triangles: NDArray[Any]) -> Surface:
    """Make a surface from points and triangles. The surface is smooth where neighbouring faces nearly agree, and has
    sharp edges elsewhere.
    """
    facets = points[triangles]
    area = np.cross(facets[:, 1] - facets[:, 0], facets[:, 2] - facets[:, 0])
    sizes = np.linalg.norm(area, axis=1)
    solid = sizes > 0
    triangles, area, flat = triangles[solid], area[solid], area[solid] / sizes[solid, None]
    corner, face = triangles.ravel(), np.repeat(np.arange(len(triangles)), 3)
    one, other = _meeting(corner)
    alike = np.einsum("ij,ij->i", flat[face[one]], flat[face[other]]) > CREASE
    normals = np.zeros((len(corner), 3))
    np.add.at(normals, one[alike], area[face[other[alike]]])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    first, number = _distinct(np.column_stack([corner, np.rint(normals * 1000)]))
    return Surface(points=points[corner[first]], normals=normals[first], triangles=number.reshape(-1, 3))


def _distinct(rows: NDArray[Any]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return two arrays. The first has the indices of the distinct rows, in order of first occurrence. The second
    gives, for each row, the number of the distinct row that equals it.
    """
    _, first, number = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    order = np.argsort(first)
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    return first[order], rank[number.reshape(-1)]


def _meeting(corner: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return all pairs of entries of `corner` that stand for the same point. Each entry also forms a pair with
    itself.
    """
    order = np.argsort(corner, kind="stable")
    first = np.flatnonzero(np.diff(corner[order], prepend=-1))
    count = np.diff(np.append(first, len(order)))
    begin, many = np.repeat(first, count), np.repeat(count, count)
    one = np.repeat(np.arange(len(order)), many)
    inside = np.arange(len(one)) - np.repeat(np.cumsum(many) - many, many)
    return order[one], order[np.repeat(begin, many) + inside]


def _scaled(unit: Surface, size: Array) -> Surface:
    normals = unit.normals / size
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return Surface(points=unit.points * size, normals=normals, triangles=unit.triangles)


@cache
def _box() -> Surface:
    """Return a box that extends from -1 to 1 along each axis."""
    corners = np.array([(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
    quads = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    return creased(corners, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]))


@cache
def _cylinder() -> Surface:
    """Return a prism of radius 1 that extends from z = -1 to 1."""
    turn = 2 * np.pi * np.arange(SIDES) / SIDES
    ring = np.column_stack([np.cos(turn), np.sin(turn)])
    points = [(x, y, z) for z in (-1.0, 1.0) for x, y in ring] + [(0.0, 0.0, -1.0), (0.0, 0.0, 1.0)]
    triangles = []
    for k, after in enumerate([*range(1, SIDES), 0]):
        below, above = 2 * SIDES, 2 * SIDES + 1
        triangles += [(k, after, after + SIDES), (k, after + SIDES, k + SIDES)]
        triangles += [(below, after, k), (above, k + SIDES, after + SIDES)]
    return creased(np.array(points), np.array(triangles))


@cache
def _ball() -> Surface:
    """Return a sphere of radius 1, made from a box whose faces are divided and projected outwards."""
    grid = np.linspace(-1, 1, 9)
    faces = []
    for axis in range(3):
        for side in (-1.0, 1.0):
            u, v = np.meshgrid(grid, grid * side, indexing="ij")
            faces.append(np.roll(np.stack([np.full_like(u, side), u, v], axis=-1), axis, axis=-1))
    points = np.tan(np.pi / 4 * np.stack(faces))
    points /= np.linalg.norm(points, axis=-1, keepdims=True)
    k = np.arange(points.shape[0] * 81).reshape(-1, 9, 9)
    a, b, c, d = (part.ravel() for part in (k[:, :-1, :-1], k[:, 1:, :-1], k[:, 1:, 1:], k[:, :-1, 1:]))
    triangles = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    flat = points.reshape(-1, 3)
    return Surface(points=flat, normals=flat, triangles=triangles)
