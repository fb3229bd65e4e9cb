"""What a page needs to draw a scene: surfaces, materials, names, views, lamp."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from handeye.cell.looks import LATENT, SCENERY, SEEN
from handeye.pose import Array
from handeye.see.player.coarse import CELLS, coarsened
from handeye.see.player.materials import Palette
from handeye.see.player.names import body_name, part_name
from handeye.see.player.packing import columns, octahedral, packed, quantised, rounded, zigzag
from handeye.see.player.surfaces import Surface, surface
from handeye.see.player.views import lamp, views
from handeye.trace.channels import WORLD

FINE: Final = 200
"""Triangles from which on a body has a coarser surface as well."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Mesh:
    """Surfaces of a body."""

    fine: Surface
    coarse: Surface | None
    fine_materials: NDArray[np.uint8]
    coarse_materials: NDArray[np.uint8]
    parts: tuple[tuple[str, int], ...]
    """Names of the parts of the world in order, and how many corners of triangles each has; of other bodies none."""


def scene_bytes(model: Any) -> bytes:
    """The scene, compressed."""
    palette, stock = Palette(model), _Stock()
    bodies = []
    for body in range(model.nbody):
        shapes = seen(model, body)
        if shapes:
            name = model.body(body).name if body else WORLD
            mesh = stock.number(_mesh(model, palette, shapes, whole=body > 0))
            bodies.append({"name": name, "label": body_name(name), "mesh": mesh})
    header = {
        "bodies": bodies, "meshes": stock.told, "materials": palette.rows, "views": views(model), "lamp": lamp(model),
        "grains": palette.grains,
    }  # fmt: skip
    picture = np.frombuffer(palette.picture(), dtype=np.uint8)
    return packed(header, {**stock.arrays(), "picture": picture})


def seen(model: Any, body: int) -> list[int]:
    """The shapes by which a body is seen, or will be, by people."""
    mine = np.flatnonzero(model.geom_bodyid == body)
    return [int(shape) for shape in mine if model.geom_group[shape] in (SCENERY, SEEN, LATENT)]


def lowest(model: Any) -> float:
    """Height (m) of the underside of the world: what is below is put away."""
    found = [surface(model, shape) for shape in seen(model, 0)]
    return min((float(part.points[:, 2].min()) for part in found if part is not None), default=-np.inf)


def _mesh(model: Any, palette: Palette, shapes: Sequence[int], *, whole: bool) -> _Mesh:
    """The surfaces of a body; of the world, `whole` is false: its parts have names."""
    named = [(part_name(model, shape), shape) for shape in shapes]
    if not whole:
        named.sort(key=lambda part: part[0])
    pieces = [(name, shape, surface(model, shape)) for name, shape in named]
    found = [(name, shape, piece) for name, shape, piece in pieces if piece is not None]
    materials = [palette.number(shape, np.ptp(piece.points, axis=0)) for _, shape, piece in found]
    fine = [piece for _, _, piece in found]
    coarse = _coarser(fine) if whole else None
    counts: dict[str, int] = {}
    for name, _, piece in found:
        counts[name] = counts.get(name, 0) + piece.triangles.size
    return _Mesh(
        fine=Surface.joined(fine),
        coarse=Surface.joined(coarse) if coarse else None,
        fine_materials=_spread(materials, fine),
        coarse_materials=_spread(materials, coarse or []),
        parts=() if whole else tuple(counts.items()),
    )


def _coarser(pieces: Sequence[Surface]) -> list[Surface] | None:
    """Coarser surfaces of the pieces of a body; None if that would save less than half of it."""
    count = sum(len(piece.triangles) for piece in pieces)
    cell = float(np.ptp(np.concatenate([piece.points for piece in pieces]), axis=0).max()) / CELLS
    found = [coarsened(piece, cell) for piece in pieces]
    return found if count >= FINE and 2 * sum(len(piece.triangles) for piece in found) < count else None


def _spread(materials: Sequence[int], pieces: Sequence[Surface]) -> NDArray[np.uint8]:
    """The material of each corner."""
    corners = [len(piece.points) for piece in pieces]
    return np.repeat(np.array(materials[: len(corners)], dtype=np.uint8), corners)


@dataclass(slots=True)
class _Stock:
    """All surfaces, equal ones once."""

    told: list[dict[str, Any]] = field(default_factory=list)
    _points: list[NDArray[np.uint16]] = field(default_factory=list)
    _normals: list[NDArray[np.int8]] = field(default_factory=list)
    _materials: list[NDArray[np.uint8]] = field(default_factory=list)
    _triangles: list[NDArray[np.int64]] = field(default_factory=list)
    _known: dict[tuple[bytes, ...], int] = field(default_factory=dict)
    _corners: int = 0
    _indices: int = 0

    def number(self, mesh: _Mesh) -> int:
        """Number of a mesh, which is added if it is new."""
        everything = [mesh.fine] if mesh.coarse is None else [mesh.fine, mesh.coarse]
        whole = Surface.joined(everything)
        points, scale = quantised(whole.points)
        normals = octahedral(whole.normals)
        materials = np.concatenate([mesh.fine_materials, mesh.coarse_materials])
        key = tuple(array.tobytes() for array in (points, normals, materials, whole.triangles))
        key += (repr(scale).encode(),)
        if key not in self._known:
            self._known[key] = len(self.told)
            self.told.append(self._tell(mesh, scale))
            self._points.append(points)
            self._normals.append(normals)
            self._materials.append(materials)
            self._triangles.append(whole.triangles.ravel() + self._corners)
            self._corners += len(points)
            self._indices += whole.triangles.size
        return self._known[key]

    def _tell(self, mesh: _Mesh, scale: list[float]) -> dict[str, Any]:
        """What the header says of a mesh: its ranges of corners of triangles, its place and its size."""
        first, fine = self._indices, mesh.fine.triangles.size
        told: dict[str, Any] = {"fine": [first, fine], "scale": scale, "ball": _ball(mesh.fine.points)}
        if mesh.coarse is not None:
            told["coarse"] = [first + fine, mesh.coarse.triangles.size]
        if mesh.parts:
            told["parts"] = list(_ranges(mesh.parts, first))
        return told

    def arrays(self) -> dict[str, NDArray[Any]]:
        """The arrays of the corners and triangles."""
        normals = np.concatenate(self._normals)
        return {
            "points": columns(np.concatenate(self._points)),
            "normals": np.ascontiguousarray(normals.T),
            "materials": np.concatenate(self._materials),
            "triangles": zigzag(np.concatenate(self._triangles)),
        }


def _ball(points: Array) -> list[float]:
    """Middle and radius of a ball around points, m."""
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    return rounded(np.array([*middle, np.linalg.norm(points - middle, axis=1).max()]))


def _ranges(parts: Sequence[tuple[str, int]], first: int) -> Iterator[tuple[str, int, int]]:
    for name, count in parts:
        yield name, first, count
        first += count
