"""TOML tables of positions, parts, fixtures and held things: inches, degrees, corners of boxes."""

import re
from collections.abc import Iterable, Iterator
from typing import Final, TypeVar

import msgspec

from handeye.core.diagnostics import quoted
from handeye.core.obb import Box
from handeye.core.units import DEGREE, INCH
from handeye.program.program import Fixture, Held, Hole, Part, Position


class PositionTable(msgspec.Struct, forbid_unknown_fields=True):
    """`[positions.NAME]`"""

    at: tuple[float, float, float, float, float, float]
    of: str | None = None

    def si(self) -> Position:
        x, y, z, o, a, t = self.at
        return Position(at=(x * INCH, y * INCH, z * INCH, o * DEGREE, a * DEGREE, t * DEGREE), of=self.of)


Circle = tuple[float, float, float]


class PartTable(msgspec.Struct, forbid_unknown_fields=True):
    """`[parts.NAME]`"""

    at: tuple[float, float, float, float]
    face: float = 0.0
    holes: tuple[Circle, ...] = ()
    screw_holes: tuple[Circle, ...] = ()
    region: tuple[float, float] | None = None
    outline: tuple[float, float, float, float] | None = None

    def si(self) -> Part:
        x, y, z, yaw = self.at
        box = self.outline
        return Part(
            at=(x * INCH, y * INCH, z * INCH, yaw * DEGREE),
            face=self.face * INCH,
            holes=_holes(self.holes),
            screw_holes=_holes(self.screw_holes),
            region=None if self.region is None else (self.region[0] * INCH, self.region[1] * INCH),
            outline=None if box is None else (box[0] * INCH, box[1] * INCH, box[2] * INCH, box[3] * INCH),
        )


class FixtureTable(msgspec.Struct, forbid_unknown_fields=True):
    """`[fixtures.NAME]`"""

    boxes: tuple[Box, ...]
    at: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)

    def si(self) -> Fixture:
        x, y, z, yaw = self.at
        return Fixture(at=(x * INCH, y * INCH, z * INCH, yaw * DEGREE), boxes=_boxes(self.boxes))


class HeldTable(msgspec.Struct, forbid_unknown_fields=True):
    """`[held.NAME]`"""

    positions: tuple[str, ...]
    boxes: tuple[Box, ...]

    def si(self) -> Held:
        return Held(positions=self.positions, boxes=_boxes(self.boxes))


Entry = TypeVar("Entry", PositionTable, PartTable, FixtureTable, HeldTable)


class UnfitEntry(Exception):
    """A fault of an entry."""

    def __init__(self, kind: str, name: str, said: str) -> None:
        super().__init__(said)
        self.kind, self.name = kind, name

    @property
    def key(self) -> str:
        """`positions.NAME`"""
        return f"{self.kind}.{self.name}"


def read_tables(
    kind: str, tables: dict[str, dict[str, object]], type: type[Entry]
) -> Iterator[tuple[str, Entry]]:
    """The tables of a kind by name, as they are written.

    Raises:
        UnfitEntry: what is in one cannot be used.
    """
    for name, table in tables.items():
        if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", name):
            said = "a name consists of letters, digits and _, and does not start with a digit"
            raise UnfitEntry(kind, name, said)
        yield name, _read(kind, name, table, type)


def _read(kind: str, name: str, table: dict[str, object], type: type[Entry]) -> Entry:
    try:
        entry: Entry = msgspec.convert(table, type)
    except msgspec.ValidationError as error:
        raise UnfitEntry(kind, name, unfit(error)) from None
    for field in type.__struct_fields__:
        if not all(abs(x) < 1e6 for x in _numbers(getattr(entry, field))):
            raise UnfitEntry(kind, name, f"{field} has a number that is not below a million")
    if isinstance(entry, PartTable):
        for x, y, diameter in (*entry.holes, *entry.screw_holes):
            if diameter <= 0:
                raise UnfitEntry(kind, name, f"the hole at ({x:g}, {y:g}) has diameter {diameter:g}")
    if isinstance(entry, FixtureTable | HeldTable):
        for box in entry.boxes:
            if not all(low < high for low, high in zip(box[:3], box[3:], strict=True)):
                corners = " to ".join(f"({x:g}, {y:g}, {z:g})" for x, y, z in (box[:3], box[3:]))
                raise UnfitEntry(kind, name, f"the box from {corners} is empty")
    return entry


def _numbers(value: object) -> Iterable[float]:
    if isinstance(value, tuple):
        for item in value:
            yield from _numbers(item)
    elif isinstance(value, float):
        yield value


def _holes(circles: Iterable[Circle]) -> tuple[Hole, ...]:
    return tuple(Hole(x=x * INCH, y=y * INCH, diameter=d * INCH) for x, y, d in circles)


def _boxes(boxes: Iterable[Box]) -> tuple[Box, ...]:
    return tuple((a * INCH, b * INCH, c * INCH, d * INCH, e * INCH, f * INCH) for a, b, c, d, e, f in boxes)


_KINDS: Final = {
    "array": "a list", "object": "a table", "str": "a text", "float": "a number", "int": "a whole number",
    "bool": "true or false", "null": "nothing",
}  # fmt: skip


def unfit(error: msgspec.ValidationError) -> str:
    """Say what does not fit, and where, as the rest of a sentence.

    It is read off the sentence of `msgspec`, which tells it in no other way.
    """
    said, _, where = str(error).partition(" - at `$")
    where = where.rstrip("`").lstrip(".")
    about = f"{where}: " if where else ""
    if size := re.fullmatch(r"Expected `array` of length (\d+), got (\d+)", said):
        return f"{about}{size[2]} entries, and needs {size[1]}"
    if kinds := re.fullmatch(r"Expected `(\w+)(?: \| null)?`, got `(\w+)`", said):
        wanted, got = (_KINDS.get(kind, kind) for kind in kinds.groups())
        return f"{about}{got} instead of {wanted}"
    if key := re.fullmatch(r"Object missing required field `(.*)`", said, re.DOTALL):
        return f"{about}{quoted(key[1])} is missing"
    if key := re.fullmatch(r"Object contains unknown field `(.*)`", said, re.DOTALL):
        return f"{about}{quoted(key[1])} is not a key of it"
    return f"{about}{said[:1].lower()}{said[1:]}"
