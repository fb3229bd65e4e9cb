"""Positions and parts given from outside a program: what the teacher stored by moving the arm, as TOML.

[positions.PIN]
at = [18, 44, 3, 0, 90, 0]         # x, y, z in inches, angles O, A, T in degrees
of = "HOLDER"                      # optional: relative to that part

[parts.HOLDER]
at = [18, 44, 0, 0]                # x, y, z in inches, yaw in degrees
face = 1.75                        # height of its upper face, inches
holes = [[0, 0, 2.25]]             # x, y, diameter, inches, largest first
"""

import re
import tomllib
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

import msgspec

from handeye.errors import InvalidInput
from handeye.plan.program import Hole, Part, Position
from handeye.source import read_source
from handeye.units import DEGREE, INCH


@dataclass(frozen=True, slots=True, kw_only=True)
class Taught:
    """Positions and parts by name, in SI units. Parts that positions refer to are there."""

    positions: dict[str, Position] = field(default_factory=dict)
    parts: dict[str, Part] = field(default_factory=dict)


class _Position(msgspec.Struct, forbid_unknown_fields=True):
    at: tuple[float, float, float, float, float, float]
    of: str | None = None

    def si(self) -> Position:
        x, y, z, o, a, t = self.at
        return Position(at=(x * INCH, y * INCH, z * INCH, o * DEGREE, a * DEGREE, t * DEGREE), of=self.of)


Circle = tuple[float, float, float]


class _Part(msgspec.Struct, forbid_unknown_fields=True):
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


class _File(msgspec.Struct, forbid_unknown_fields=True):
    positions: dict[str, dict[str, object]] = {}
    parts: dict[str, dict[str, object]] = {}


def load_taught(path: str | Path) -> Taught:
    """Read positions and parts from a TOML file (inches and degrees).

    Raises:
        InvalidInput: the file cannot be read, or what is in it cannot be used; the sentence names the key.
    """
    source = read_source(path)
    try:
        tables = msgspec.convert(tomllib.loads(source.text), _File)
    except tomllib.TOMLDecodeError as error:
        raise InvalidInput(f"{path} is not TOML: {_lower(error)}") from None
    except RecursionError:
        raise InvalidInput(f"{path} is not TOML: nested too deeply") from None
    except msgspec.ValidationError as error:
        raise InvalidInput(f"{path}: {_lower(error)}") from None
    parts = {n: _read(path, f"parts.{n}", t, _Part).si() for n, t in tables.parts.items()}
    positions = {n: _read(path, f"positions.{n}", t, _Position).si() for n, t in tables.positions.items()}
    for name, position in positions.items():
        if position.of is not None and position.of not in parts:
            raise InvalidInput(f"{path}: positions.{name}: of = {position.of!r}, but there is no such part")
    return Taught(positions=positions, parts=parts)


_Entry = TypeVar("_Entry", _Position, _Part)


def _read(path: str | Path, key: str, table: dict[str, object], kind: type[_Entry]) -> _Entry:
    if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", key.split(".", 1)[1]):
        raise InvalidInput(
            f"{path}: {key}: a name consists of letters, digits and _, and starts with no digit"
        )
    try:
        entry: _Entry = msgspec.convert(table, kind)
    except msgspec.ValidationError as error:
        raise InvalidInput(f"{path}: {key}: {_lower(error)}") from None
    for name in kind.__struct_fields__:
        if not all(abs(x) < 1e6 for x in _numbers(getattr(entry, name))):
            raise InvalidInput(f"{path}: {key}: {name} has a number that is not below a million")
    if isinstance(entry, _Part):
        for x, y, diameter in (*entry.holes, *entry.screw_holes):
            if diameter <= 0:
                raise InvalidInput(f"{path}: {key}: the hole at ({x:g}, {y:g}) has diameter {diameter:g}")
    return entry


def _numbers(value: object) -> Iterable[float]:
    if isinstance(value, tuple):
        for item in value:
            yield from _numbers(item)
    elif isinstance(value, float):
        yield value


def _holes(circles: Iterable[Circle]) -> tuple[Hole, ...]:
    return tuple(Hole(x=x * INCH, y=y * INCH, diameter=d * INCH) for x, y, d in circles)


def _lower(error: Exception) -> str:
    text = str(error)
    return text[:1].lower() + text[1:]
