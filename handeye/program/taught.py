"""Taught files (TOML). A taught file contains hand positions, which a user stored by moving the arm. It also contains
the parts, the fixtures and the held objects.

[positions.PIN]
at = [18, 44, 3, 0, 90, 0]         # x, y, z in inches, angles O, A, T in degrees
of = "HOLDER"                      # optional: relative to that part

[parts.HOLDER]
at = [18, 44, 0, 0]                # x, y, z in inches, yaw in degrees
face = 1.75                        # height of its upper face, inches
holes = [[0, 0, 2.25]]             # x, y, diameter, inches, largest first

[fixtures.RACK]                    # an obstacle for motions
at = [6, 33, 0, 0]                 # optional: x, y, z in inches, yaw in degrees, of the frame of its boxes
boxes = [[-1, -1, 0, 1, 1, 5]]     # x, y, z from and x, y, z to, inches

[held.DRIVER]                      # an object that the hand carries
positions = ["PIN"]                # held after the hand has closed at one of these
boxes = [[-1, -1, -1, 1, 1, 4]]    # across the fingers, along the finger line, out from the tips: from and to
"""

import re
import tomllib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final, TypeVar

import msgspec

from handeye.core.diagnostics import quoted, suggestion
from handeye.core.errors import BadFile
from handeye.core.obb import Box
from handeye.core.plain_text import counted
from handeye.core.source import Source, read_source
from handeye.core.units import DEGREE, INCH
from handeye.program.program import Fixture, Held, Hole, Part, Position


@dataclass(frozen=True, slots=True, kw_only=True)
class Taught:
    """Taught positions, parts and fixtures by name, in SI units. References between them are resolved."""

    positions: dict[str, Position] = field(default_factory=dict)
    parts: dict[str, Part] = field(default_factory=dict)
    fixtures: dict[str, Fixture] = field(default_factory=dict)
    held: dict[str, Held] = field(default_factory=dict)


class PositionTable(msgspec.Struct, forbid_unknown_fields=True):
    """The table `[positions.NAME]` of a taught file, in inches and degrees."""

    at: tuple[float, float, float, float, float, float]
    of: str | None = None

    def si(self) -> Position:
        x, y, z, o, a, t = self.at
        return Position(at=(x * INCH, y * INCH, z * INCH, o * DEGREE, a * DEGREE, t * DEGREE), of=self.of)


Circle = tuple[float, float, float]


class PartTable(msgspec.Struct, forbid_unknown_fields=True):
    """The table `[parts.NAME]` of a taught file, in inches and degrees."""

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
    """The table `[fixtures.NAME]` of a taught file, in inches and degrees."""

    boxes: tuple[Box, ...]
    at: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)

    def si(self) -> Fixture:
        x, y, z, yaw = self.at
        return Fixture(at=(x * INCH, y * INCH, z * INCH, yaw * DEGREE), boxes=_boxes(self.boxes))


class HeldTable(msgspec.Struct, forbid_unknown_fields=True):
    """The table `[held.NAME]` of a taught file, in inches."""

    positions: tuple[str, ...]
    boxes: tuple[Box, ...]
    thickness: float | None = None

    def si(self) -> Held:
        thick = None if self.thickness is None else self.thickness * INCH
        return Held(positions=self.positions, boxes=_boxes(self.boxes), thickness=thick)


Entry = TypeVar("Entry", PositionTable, PartTable, FixtureTable, HeldTable)


class UnfitEntry(Exception):
    """Raised for an entry of a taught file that cannot be used."""

    def __init__(self, kind: str, name: str, said: str) -> None:
        super().__init__(said)
        self.kind, self.name = kind, name

    @property
    def key(self) -> str:
        """The key of the entry, such as `positions.NAME`."""
        return f"{self.kind}.{self.name}"


def read_tables(
    kind: str, tables: dict[str, dict[str, object]], type: type[Entry]
) -> Iterator[tuple[str, Entry]]:
    """Read the tables of one kind from a taught file, and yield each with its name. Raises UnfitEntry if a table
    cannot be used.
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
    for key in type.__struct_fields__:
        if not all(abs(x) < 1e6 for x in _numbers(getattr(entry, key))):
            raise UnfitEntry(kind, name, f"{key} contains a number of one million or more")
    if isinstance(entry, PartTable):
        for x, y, diameter in (*entry.holes, *entry.screw_holes):
            if diameter <= 0:
                raise UnfitEntry(
                    kind,
                    name,
                    f"the hole at ({x:g}, {y:g}) has the diameter {diameter:g}, which must be above 0",
                )
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
    """Write the part of an error sentence that names the mismatch and its place, as in the message of `msgspec`."""
    said, _, where = str(error).partition(" - at `$")
    where = where.rstrip("`").lstrip(".")
    about = f"{where}: " if where else ""
    if size := re.fullmatch(r"Expected `array` of length (\d+), got (\d+)", said):
        return f"{about}{counted(int(size[2]), 'entry')}, but needs {size[1]}"
    if kinds := re.fullmatch(r"Expected `(\w+)(?: \| null)?`, got `(\w+)`", said):
        wanted, got = (_KINDS.get(kind, kind) for kind in kinds.groups())
        return f"{about}{got} instead of {wanted}"
    if key := re.fullmatch(r"Object missing required field `(.*)`", said, re.DOTALL):
        return f"{about}{quoted(key[1])} is missing"
    if key := re.fullmatch(r"Object contains unknown field `(.*)`", said, re.DOTALL):
        return f"{about}{quoted(key[1])} is not a known key"
    return f"{about}{said[:1].lower()}{said[1:]}"


class _File(msgspec.Struct, forbid_unknown_fields=True):
    positions: dict[str, dict[str, object]] = {}
    parts: dict[str, dict[str, object]] = {}
    fixtures: dict[str, dict[str, object]] = {}
    held: dict[str, dict[str, object]] = {}


MAX_BOXES: Final = 500  # in a file; each box makes the check of motions slower


def load_taught(path: str | Path) -> Taught:
    """Read a taught TOML file (inches and degrees). Raises BadFile with a message that names the wrong key."""
    return read_taught(read_source(path))


def read_taught(source: Source) -> Taught:
    """Parse the text of a taught TOML file (inches and degrees). Raises BadFile with a message that names the wrong
    key.
    """
    path = source.name
    try:
        tables = msgspec.convert(tomllib.loads(source.text), _File)
        return _taught(tables)
    except tomllib.TOMLDecodeError as error:
        said = str(error).replace("Cannot overwrite a value", "a key appears twice")
        raise BadFile(f"{path} is not TOML: {said[:1].lower()}{said[1:]}") from None
    except RecursionError:
        raise BadFile(f"{path} is not TOML: nested too deeply") from None
    except msgspec.ValidationError as error:
        raise BadFile(f"{path}: {unfit(error)}") from None
    except ValueError:  # for a whole number with too many digits for Python
        raise BadFile(f"{path}: a number has too many digits") from None
    except UnfitEntry as fault:
        line = _line(source, fault)
        raise BadFile(f"{path}{'' if line is None else f':{line}'}: {fault.key}: {fault}") from None


def _taught(tables: _File) -> Taught:
    taught = Taught(
        positions={n: t.si() for n, t in read_tables("positions", tables.positions, PositionTable)},
        parts={n: t.si() for n, t in read_tables("parts", tables.parts, PartTable)},
        fixtures={n: t.si() for n, t in read_tables("fixtures", tables.fixtures, FixtureTable)},
        held={n: t.si() for n, t in read_tables("held", tables.held, HeldTable)},
    )
    for fault in _faults(taught):
        raise fault
    return taught


def _line(source: Source, fault: UnfitEntry) -> int | None:
    """Return the line, from 1, on which an entry begins, or None if the entry is not written in the usual form."""
    kind, name = map(re.escape, (fault.kind, fault.name))
    header = rf"\[\s*{kind}\s*\.\s*[\"']?{name}[\"']?\s*\]"
    found = re.search(rf"^[ \t]*(?:{header}|[\"']?{name}[\"']?[ \t]*=)", source.text, re.MULTILINE)
    return None if found is None else source.position(found.end())[0]


def _faults(taught: Taught) -> Iterator[UnfitEntry]:
    """Yield the inconsistencies between entries."""
    for name, position in taught.positions.items():
        if position.of is not None and position.of not in taught.parts:
            meant = suggestion(position.of, taught.parts)
            said = f"there is no part {quoted(position.of)}"
            yield UnfitEntry("positions", name, said if meant is None else f"{said}; {meant}")
    where: dict[str, str] = {}
    for name, held in taught.held.items():
        for at in held.positions:
            if at not in taught.positions:
                yield UnfitEntry("held", name, f"there is no position {quoted(at)} in this file")
            if where.setdefault(at, name) != name:
                yield UnfitEntry("held", name, f"at {at}, the hand already holds {where[at]}")
    count = 0
    for kind, solids in (("fixtures", taught.fixtures), ("held", taught.held)):
        for name, solid in solids.items():
            count += len(solid.boxes)
            if count > MAX_BOXES:
                yield UnfitEntry(kind, name, f"with this entry, the file has more than {MAX_BOXES} boxes")
