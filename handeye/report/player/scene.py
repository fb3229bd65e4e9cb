"""What a page needs to draw a scene: surfaces, materials, names, views, lamp."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import numpy as np

from handeye.cell.looks import LATENT, SCENERY, SEEN
from handeye.report.player.materials import Palette
from handeye.report.player.meshes import Meshes, Piece
from handeye.report.player.packing import packed
from handeye.report.player.surfaces import surface
from handeye.report.player.views import lamp, views
from handeye.trace.channels import WORLD

_CALLED: Final = "called/"
"""Begins the names of the texts in which a scene tells what people call a body, or bodies that are numbered."""


@dataclass(frozen=True)
class Names:
    """The names in a scene."""

    model: Any

    def body(self, number: int) -> str:
        """What people call a body: as the scene tells, or its name in words: `pin 0`."""
        name = self.model.body(number).name
        stem = name.rstrip("0123456789")
        if name in self._called:
            return self._called[name]
        return _words(self._called.get(stem, stem) + name.removeprefix(stem))

    def part(self, shape: int) -> str:
        """What people call a shape of the world: its name without its number, or what it is made of."""
        material = self.model.geom_matid[shape]
        made = self.model.material(material).name if material >= 0 else "something"
        return _words((self.model.geom(shape).name or made).rstrip("0123456789"))

    @cached_property
    def _called(self) -> dict[str, str]:
        model = self.model
        names = [_text(model.names, first) for first in model.name_textadr]
        texts = [_text(model.text_data, first) for first in model.text_adr]
        told = zip(names, texts, strict=True)
        return {name.removeprefix(_CALLED): text for name, text in told if name.startswith(_CALLED)}


def _text(data: bytes, first: int) -> str:
    """The text that begins somewhere among others, each with a zero byte behind it."""
    return data[first : data.index(b"\0", first)].decode()


def _words(name: str) -> str:
    """A name in words: `finger_a` of an arm is its `finger a`."""
    own = name.rpartition("/")[2]
    return re.sub(r"(?<=[a-z])(?=\d)", " ", own).replace("_", " ")


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
