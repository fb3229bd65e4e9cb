"""What is given from outside a program: what the teacher stored by moving the arm, and the cell around it, as TOML.

[positions.PIN]
at = [18, 44, 3, 0, 90, 0]         # x, y, z in inches, angles O, A, T in degrees
of = "HOLDER"                      # optional: relative to that part

[parts.HOLDER]
at = [18, 44, 0, 0]                # x, y, z in inches, yaw in degrees
face = 1.75                        # height of its upper face, inches
holes = [[0, 0, 2.25]]             # x, y, diameter, inches, largest first

[fixtures.RACK]                    # what no motion may lead through
at = [6, 33, 0, 0]                 # optional: x, y, z in inches, yaw in degrees, of the frame of its boxes
boxes = [[-1, -1, 0, 1, 1, 5]]     # x, y, z from and x, y, z to, inches

[held.DRIVER]                      # what the hand carries
positions = ["PIN"]                # when it has closed at one of these
boxes = [[-1, -1, -1, 1, 1, 4]]    # across the fingers, along the finger line, out from the tips: from and to
"""

import tomllib
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

import msgspec

from handeye.errors import InvalidInput
from handeye.plan.program import Fixture, Held, Part, Position
from handeye.plan.tables import FixtureTable, HeldTable, PartTable, PositionTable, lower_first, read_tables
from handeye.source import read_source


@dataclass(frozen=True, slots=True, kw_only=True)
class Taught:
    """What is taught, by name, in SI units. Parts and positions that are referred to are there."""

    positions: dict[str, Position] = field(default_factory=dict)
    parts: dict[str, Part] = field(default_factory=dict)
    fixtures: dict[str, Fixture] = field(default_factory=dict)
    held: dict[str, Held] = field(default_factory=dict)


class _File(msgspec.Struct, forbid_unknown_fields=True):
    positions: dict[str, dict[str, object]] = {}
    parts: dict[str, dict[str, object]] = {}
    fixtures: dict[str, dict[str, object]] = {}
    held: dict[str, dict[str, object]] = {}


MOST_BOXES: Final = 500
"""Of a file. The check of the motions takes time for each of them."""


def load_taught(path: str | Path) -> Taught:
    """Read what is taught from a TOML file (inches and degrees).

    Raises:
        InvalidInput: the file cannot be read, or what is in it cannot be used; the sentence names the key.
    """
    source = read_source(path)
    try:
        tables = msgspec.convert(tomllib.loads(source.text), _File)
    except tomllib.TOMLDecodeError as error:
        raise InvalidInput(f"{path} is not TOML: {lower_first(error)}") from None
    except RecursionError:
        raise InvalidInput(f"{path} is not TOML: nested too deeply") from None
    except msgspec.ValidationError as error:
        raise InvalidInput(f"{path}: {lower_first(error)}") from None
    except ValueError:  # of a whole number that Python does not read
        raise InvalidInput(f"{path}: a number has too many digits") from None
    name = str(path)
    positions = {n: t.si() for n, t in read_tables(name, "positions", tables.positions, PositionTable)}
    parts = {n: t.si() for n, t in read_tables(name, "parts", tables.parts, PartTable)}
    fixtures = {n: t.si() for n, t in read_tables(name, "fixtures", tables.fixtures, FixtureTable)}
    held = {n: t.si() for n, t in read_tables(name, "held", tables.held, HeldTable)}
    taught = Taught(positions=positions, parts=parts, fixtures=fixtures, held=held)
    for fault in _faults(taught):
        raise InvalidInput(f"{path}: {fault}")
    return taught


def _faults(taught: Taught) -> Iterator[str]:
    """What is wrong between the entries of a file."""
    for name, position in taught.positions.items():
        if position.of is not None and position.of not in taught.parts:
            yield f"positions.{name}: of = {position.of!r}, but there is no such part"
    where: dict[str, str] = {}
    for name, held in taught.held.items():
        for at in held.positions:
            if at not in taught.positions:
                yield f"held.{name}: there is no position {at!r} in this file"
            if where.setdefault(at, name) != name:
                yield f"held.{name}: at {at} the hand already holds {where[at]}"
    solids: list[Fixture | Held] = [*taught.fixtures.values(), *taught.held.values()]
    count = sum(len(solid.boxes) for solid in solids)
    if count > MOST_BOXES:
        yield f"it has {count} boxes; at most {MOST_BOXES} can be looked after"
