"""Stores the surfaces of bodies as arrays of vertices. Equal surfaces are stored once."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from handeye.core.pose import Array
from handeye.report.player.packing import columns, octahedral, quantised, rounded, zigzag
from handeye.report.player.surfaces import Surface, creased

FINE: Final = 200  # A body with at least this number of triangles also has a coarser surface


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Piece:
    """A part of a body's surface, of one material."""

    name: str
    surface: Surface
    material: int

    @property
    def size(self) -> float:
        """Length of the longest side of the surface's bounding box (m)."""
        return float(np.ptp(self.surface.points, axis=0).max())


@dataclass(slots=True)
class Meshes:
    """The meshes of bodies. Each body has a fine mesh, and also a coarse mesh if the coarse mesh has far fewer
    corners.
    """

    told: list[dict[str, Any]] = field(default_factory=list)
    """The data of each mesh for the page. `fine` and `coarse` are the two levels of detail. The corners of a level are
    consecutive in the list of triangles; `fine` or `coarse` gives the index of the first corner, and the number of
    corners. `scale` is the scale of the points, and `ball` is the bounding sphere. `parts` gives the name and the
    range of each piece.
    """
    _points: list[NDArray[np.uint16]] = field(default_factory=list)
    _normals: list[NDArray[np.int8]] = field(default_factory=list)
    _materials: list[NDArray[np.uint8]] = field(default_factory=list)
    _triangles: list[NDArray[np.int64]] = field(default_factory=list)
    _known: dict[tuple[bytes, ...], int] = field(default_factory=dict)

    def number(self, pieces: Sequence[Piece]) -> int:
        """Return the number of a body's mesh. If the mesh is not stored yet, it is added."""
        return self._added(pieces, _coarse(pieces))

    def number_of_parts(self, pieces: Sequence[Piece]) -> int:
        """Return the number of a body's mesh, as `number` does. Unlike the mesh of `number`, this mesh keeps the named
        pieces of the body apart, so that the user can click on them. Pieces with the same name are stored together.
        """
        number = self._added(pieces, ())
        first, _ = self.told[number]["fine"]
        self.told[number]["parts"] = parts = []
        for name, group in groupby(pieces, key=lambda piece: piece.name):
            count = sum(piece.surface.triangles.size for piece in group)
            parts.append([name, first, count])
            first += count
        return number

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Return the vertices and triangles of all meshes."""
        return {
            "points": columns(np.concatenate(self._points)),
            "normals": np.ascontiguousarray(np.concatenate(self._normals).T),
            "materials": np.concatenate(self._materials),
            "triangles": zigzag(np.concatenate(self._triangles)),
        }

    def _added(self, fine: Sequence[Piece], coarse: Sequence[Piece]) -> int:
        pieces = [*fine, *coarse]
        whole = Surface.joined([piece.surface for piece in pieces])
        points, scale = quantised(whole.points)
        normals = octahedral(whole.normals)
        corners = [len(piece.surface.points) for piece in pieces]
        materials = np.repeat(np.array([piece.material for piece in pieces], dtype=np.uint8), corners)
        arrays = points, normals, materials, whole.triangles
        key = (*(array.tobytes() for array in arrays), repr(scale).encode())
        if key not in self._known:
            self._known[key] = len(self.told)
            self.told.append(self._tell(fine, coarse, scale))
            self._triangles.append(whole.triangles.ravel() + sum(map(len, self._points)))
            self._points.append(points)
            self._normals.append(normals)
            self._materials.append(materials)
        return self._known[key]

    def _tell(self, fine: Sequence[Piece], coarse: Sequence[Piece], scale: list[float]) -> dict[str, Any]:
        first, count = sum(map(len, self._triangles)), _corners(fine)
        points = _points(fine)
        middle = (points.min(axis=0) + points.max(axis=0)) / 2
        told = {
            "fine": [first, count],
            "scale": scale,
            "ball": rounded(np.array([*middle, np.linalg.norm(points - middle, axis=1).max()])),
        }
        return {**told, "coarse": [first + count, _corners(coarse)]} if coarse else told


def _coarse(pieces: Sequence[Piece]) -> Sequence[Piece]:
    """Return coarser pieces. Returns no pieces if the coarser ones would save less than half of the corners."""
    cell = float(np.ptp(_points(pieces), axis=0).max()) / CELLS
    if _corners(pieces) < 3 * FINE:
        return ()
    coarse = [
        Piece(name=piece.name, surface=coarsened(piece.surface, cell), material=piece.material)
        for piece in pieces
    ]
    return coarse if 2 * _corners(coarse) < _corners(pieces) else ()


def _corners(pieces: Sequence[Piece]) -> int:
    """Return the number of corners of all triangles."""
    return sum(piece.surface.triangles.size for piece in pieces)


def _points(pieces: Sequence[Piece]) -> Array:
    return np.concatenate([piece.surface.points for piece in pieces])


CELLS: Final = 14  # Along the longest side of a body: all points in a cell become one


def coarsened(surface: Surface, cell: float) -> Surface:
    """Divide the space into cubes with sides of length `cell` (m), and merge all points of a surface that lie in the
    same cube. Returns the surface of the remaining triangles.
    """
    places = np.floor((surface.points - surface.points.min(axis=0)) / cell + 0.5)
    _, number = np.unique(places, axis=0, return_inverse=True)
    number = number.reshape(-1)
    count = np.bincount(number)
    points = np.column_stack([np.bincount(number, column) / count for column in surface.points.T])
    triangles = number[surface.triangles]
    a, b, c = triangles.T
    return creased(points, triangles[(a != b) & (b != c) & (c != a)])
