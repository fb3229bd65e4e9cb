"""Prepares the data for drawing a scene on a page: surfaces, materials, names, views and lamp."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Final

import cv2
import numpy as np
from numpy.typing import NDArray

from handeye.cell.looks import LATENT, SCENERY, SEEN
from handeye.core.pose import Array
from handeye.report.player.meshes import Meshes, Piece
from handeye.report.player.packing import packed, rounded
from handeye.report.player.surfaces import surface
from handeye.trace.channels import WORLD

GRAIN: Final = 512
QUALITY: Final = 45
_MOST: Final = 128
_RGB: Final = 1  # Where a material has its texture: MuJoCo's `mjTEXROLE_RGB`
_SLENDER: Final = 3.0  # Ratio of length to width above which the grain goes along a piece

Row = tuple[float, ...]
"""A material: red, green and blue in linear light (0 to 1); emitted light; metalness; roughness; number of its
grain, or -1; axis of the body (0 to 2) along which the grain runs; repeats of the grain per metre along and across
the axis.
"""


@dataclass(slots=True)
class Palette:
    """The materials of the shapes in a scene. Each is stored once."""

    model: Any
    rows: list[Row] = field(default_factory=list)
    _numbers: dict[Row, int] = field(default_factory=dict)
    _grains: list[int] = field(default_factory=list)

    def number(self, shape: int, sides: Array) -> int:
        """Return the number of a shape's material. `sides` are the lengths of the shape along the axes of its
        body (m)."""
        row = (*self._colour(shape), *self._gloss(shape), *self._grain(shape, sides))
        if row not in self._numbers:
            assert len(self.rows) < _MOST, "the number of a material must fit in seven bits"
            self._numbers[row] = len(self.rows)
            self.rows.append(row)
        return self._numbers[row]

    @property
    def grains(self) -> int:
        """Number of different grains."""
        return len(self._grains)

    def picture(self) -> bytes:
        """Return one grey WebP picture that shows all grains, one below the other. The result is empty if there are no
        grains.
        """
        if not self._grains:
            return b""
        grey = np.vstack([cv2.cvtColor(_texture(self.model, n), cv2.COLOR_RGB2GRAY) for n in self._grains])
        done, data = cv2.imencode(
            ".webp", cv2.cvtColor(grey, cv2.COLOR_GRAY2BGR), [cv2.IMWRITE_WEBP_QUALITY, QUALITY]
        )
        assert done
        return data.tobytes()

    def _colour(self, shape: int) -> Row:
        """Return the colour and the emitted light of a shape. The colour includes the tint of the shape's
        grain."""
        material, texture = self.model.geom_matid[shape], self._texture_of(shape)
        screen = self.model.mat_rgba[material] if material >= 0 else self.model.geom_rgba[shape]
        colour = np.asarray(screen[:3], dtype=float)
        if texture >= 0:
            mean = _texture(self.model, texture).reshape(-1, 3).mean(axis=0)
            colour = colour * mean / mean.mean()
        own = float(self.model.mat_emission[material]) if material >= 0 else 0.0
        return (*(round(float(c) ** 2.2, 4) for c in colour), round(own, 3))

    def _gloss(self, shape: int) -> Row:
        """Return the metalness and the roughness of a shape."""
        material = self.model.geom_matid[shape]
        if material < 0:
            return 0.0, 1.0
        told = f"gloss/{self.model.material(material).name}"
        for number in range(self.model.nnumeric):
            if self.model.numeric(number).name == told:
                metallic, roughness = self.model.numeric(number).data.tolist()
                return metallic, roughness
        specular, shininess = (
            float(self.model.mat_specular[material]),
            float(self.model.mat_shininess[material]),
        )
        return round(min(max(4 * (specular - 0.3), 0.0), 1.0), 3), round(
            1 - min(specular, 1.0) * shininess, 3
        )

    def _grain(self, shape: int, sides: Array) -> Row:
        """Return the number of a shape's grain, the grain's axis, and the repeats per metre along and across
        that axis."""
        texture = self._texture_of(shape)
        if texture < 0:
            return -1.0, 0.0, 0.0, 0.0
        if texture not in self._grains:
            self._grains.append(texture)
        number, material = float(self._grains.index(texture)), self.model.geom_matid[shape]
        if self.model.mat_texuniform[material]:
            along, across = self.model.mat_texrepeat[material].tolist()
            return number, 0.0, round(along, 4), round(across, 4)
        _, middle, long = np.sort(sides)
        if long > _SLENDER * middle:
            return number, float(sides.argmax()), round(1 / long, 4), round(1 / long, 4)
        return number, 0.0, round(1 / sides[0], 4), round(1 / sides[1], 4)

    def _texture_of(self, shape: int) -> int:
        material = self.model.geom_matid[shape]
        return int(self.model.mat_texid[material, _RGB]) if material >= 0 else -1


def _texture(model: Any, number: int) -> NDArray[np.uint8]:
    """Return the red, green and blue values of a texture, shape (GRAIN, GRAIN, 3)."""
    first, height, width = model.tex_adr[number], model.tex_height[number], model.tex_width[number]
    pixels = model.tex_data[first : first + 3 * height * width].reshape(height, width, 3)
    return np.asarray(cv2.resize(pixels, (GRAIN, GRAIN), interpolation=cv2.INTER_AREA), dtype=np.uint8)


_CALLED: Final = "called/"
"""Some text fields of the scene give the display name of a body, or of several numbered bodies. The names of these
fields have this prefix.
"""


@dataclass(frozen=True)
class Names:
    """The display names of the bodies and shapes in a scene."""

    model: Any

    def body(self, number: int) -> str:
        """Return the display name of a body: the name that the scene defines for display or, if there is none, the
        body's own name in words, such as `pin 0`.
        """
        name = self.model.body(number).name
        stem = name.rstrip("0123456789")
        if name in self._called:
            return self._called[name]
        return _words(self._called.get(stem, stem) + name.removeprefix(stem))

    def part(self, shape: int) -> str:
        """Return the display name of a shape of the world: the shape's name without its number or, if the shape has no
        name, the name of its material.
        """
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
    """Return the zero-terminated text that begins at the byte `first`."""
    return data[first : data.index(b"\0", first)].decode()


def _words(name: str) -> str:
    """Return a name in words: `finger_a` of an arm becomes `finger a`."""
    own = name.rpartition("/")[2]
    return re.sub(r"(?<=[a-z])(?=\d)", " ", own).replace("_", " ")


def scene_bytes(model: Any) -> bytes:
    """Return the scene, compressed."""
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
    """Return the shapes of a body that are visible, or that will become visible after an event."""
    mine = np.flatnonzero(model.geom_bodyid == body)
    return [int(shape) for shape in mine if model.geom_group[shape] in (SCENERY, SEEN, LATENT)]


def lowest(model: Any) -> float:
    """Return the height (m) of the lowest point of the world. A simulation puts a body below this point while the body
    is absent from the cell.
    """
    found = [surface(model, shape) for shape in seen(model, 0)]
    return min((float(part.points[:, 2].min()) for part in found if part is not None), default=-np.inf)


def _pieces(model: Any, palette: Palette, names: Names, body: int) -> list[Piece]:
    """Return the pieces of a body."""
    pieces = []
    for shape in seen(model, body):
        part = surface(model, shape)
        if part is not None:
            material = palette.number(shape, np.ptp(part.points, axis=0))
            pieces.append(Piece(name=names.part(shape), surface=part, material=material))
    return pieces


def _small_first(pieces: Sequence[Piece]) -> list[Piece]:
    """Return the pieces in the order of their size, the smallest first, so that floor and walls come last. Pieces with
    the same name stay together.
    """
    sizes = {piece.name: 0.0 for piece in pieces}
    for piece in pieces:
        sizes[piece.name] = max(sizes[piece.name], piece.size)
    return sorted(pieces, key=lambda piece: (sizes[piece.name], piece.name))


ROOM: Final = "room"
_SEEN_AS: Final = {"studio": ROOM}  # Names of views that differ from the names of their cameras
_ORDER: Final = (ROOM, "hand", "pump", "work", "belt", "tv")
_TOOL: Final = "tool"
_BESIDE: Final = np.array([0.30, 0.38, 0.36])  # From the hand to the viewer, m
_FINGERS: Final = 0.8  # Where the fingers are: fraction of the way from wrist to tool centre point
_LENS: Final = 37.0  # Angle of view if no camera defines it, degrees
_LAMP: Final = np.array([1.05, -0.65, 1.3])
"""Position of the lamp relative to the centre of the scene, divided by the scene's size. The lamp is high, in front of
the scene, and to the left of the viewer.
"""


def views(model: Any) -> list[dict[str, Any]]:
    """Return the views of a scene. Each view has a name and a viewing angle (degrees). The viewer is at the point
    `eye` (m), and looks at the point `at` (m).

    In a view with a `body`, `eye` and `at` are relative to the body's position, along the axes of the world.
    """
    found = [_camera(model, number) for number in range(model.ncam)]
    if not any(view["name"] == ROOM for view in found):
        found.append(_overview(model))
    found += [_hand(model, site) for site in _tools(model)]
    rank = {name: number for number, name in enumerate(_ORDER)}
    return sorted(found, key=lambda view: rank.get(view["name"], len(rank)))


def lamp(model: Any) -> dict[str, list[float]]:
    """Return the position of the lamp, and the point at which the lamp is aimed (m)."""
    middle = np.array(model.stat.center)
    return {"eye": rounded(middle + model.stat.extent * _LAMP), "at": rounded(middle * [1, 1, 0])}


def _camera(model: Any, number: int) -> dict[str, Any]:
    """Return the view of a camera of the scene."""
    name, eye = model.camera(number).name, model.cam_pos0[number]
    forward = -model.cam_mat0[number].reshape(3, 3)[:, 2]
    at = eye + _distance(model, eye, forward) * forward
    return _view(_SEEN_AS.get(name, name), eye, at, float(model.cam_fovy[number]))


def _distance(model: Any, eye: Array, forward: Array) -> float:
    """Return the distance (m) of a camera from the point at which it looks. This is the point where its line of sight
    is as high as the scene's centre.
    """
    drop = eye[2] - model.stat.center[2]
    return float(-drop / forward[2]) if drop > 0 and forward[2] < -0.1 else float(model.stat.extent)


def _overview(model: Any) -> dict[str, Any]:
    """Return a view of the whole scene, for a scene that has no camera for this view."""
    middle = np.array(model.stat.center)
    return _view(ROOM, middle + model.stat.extent * np.array([1.2, 0.7, 0.8]), middle, _LENS)


def tool_points(model: Any) -> list[dict[str, Any]]:
    """Return the tool centre point of each hand in a scene: the name of its `body`, and the position `at` in the frame
    of this body (m).
    """
    return [
        {"body": model.body(model.site_bodyid[site]).name, "at": rounded(model.site_pos[site])}
        for site in _tools(model)
    ]


def _tools(model: Any) -> list[int]:
    """Return the sites at the tool centre points."""
    return [site for site in range(model.nsite) if model.site(site).name.split("/")[-1] == _TOOL]


def _hand(model: Any, site: int) -> dict[str, Any]:
    """Return a view that moves with the hand. The hand is assumed to point down while it works."""
    body = model.site_bodyid[site]
    at = np.array([0.0, 0.0, -_FINGERS * np.linalg.norm(model.site_pos[site])])
    return {**_view("hand", _BESIDE + at, at, _LENS), "body": model.body(body).name}


def _view(name: str, eye: Array, at: Array, angle: float) -> dict[str, Any]:
    return {"name": name, "eye": rounded(eye), "at": rounded(at), "angle": round(angle, 3)}
