"""What a page needs to draw a scene: surfaces, materials, names, views, lamp."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from handeye.cell.looks import LATENT, SCENERY, SEEN
from handeye.report.player.materials import Palette
from handeye.report.player.meshes import Meshes, Piece
from handeye.report.player.names import Names
from handeye.report.player.packing import packed
from handeye.report.player.surfaces import surface
from handeye.report.player.views import lamp, views
from handeye.trace.channels import WORLD


def scene_bytes(model: Any) -> bytes:
    """The scene, compressed."""
    palette, names, meshes, bodies = Palette(model), Names(model), Meshes(), []
    for body in range(model.nbody):
        pieces = _pieces(model, palette, names, body)
        if pieces and body:
            told = {"name": model.body(body).name, "label": names.body(body), "mesh": meshes.number(pieces)}
            bodies.append(told)
        elif pieces:
            parts = _small_first(pieces)
            bodies.append({"name": WORLD, "label": WORLD, "mesh": meshes.number_of_parts(parts)})
    header = {
        "bodies": bodies, "meshes": meshes.told, "materials": palette.rows, "views": views(model), "lamp": lamp(model),
        "grains": palette.grains,
    }  # fmt: skip
    picture = np.frombuffer(palette.picture(), dtype=np.uint8)
    return packed(header, {**meshes.arrays(), "picture": picture})


def seen(model: Any, body: int) -> list[int]:
    """The shapes by which a body is seen, or will be, by people."""
    mine = np.flatnonzero(model.geom_bodyid == body)
    return [int(shape) for shape in mine if model.geom_group[shape] in (SCENERY, SEEN, LATENT)]


def lowest(model: Any) -> float:
    """Height (m) of the underside of the world: what is below is put away."""
    found = [surface(model, shape) for shape in seen(model, 0)]
    return min((float(part.points[:, 2].min()) for part in found if part is not None), default=-np.inf)


def _pieces(model: Any, palette: Palette, names: Names, body: int) -> list[Piece]:
    """The pieces of a body."""
    pieces = []
    for shape in seen(model, body):
        part = surface(model, shape)
        if part is not None:
            material = palette.number(shape, np.ptp(part.points, axis=0))
            pieces.append(Piece(name=names.part(shape), surface=part, material=material))
    return pieces


def _small_first(pieces: Sequence[Piece]) -> list[Piece]:
    """The pieces name by name; what is large comes last, for floor and walls are behind all else."""
    sizes = {piece.name: 0.0 for piece in pieces}
    for piece in pieces:
        sizes[piece.name] = max(sizes[piece.name], piece.size)
    return sorted(pieces, key=lambda piece: (sizes[piece.name], piece.name))
