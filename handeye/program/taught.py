"""Given from outside a program: what the teacher stored by moving the arm, and the cell around it, as TOML.

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

import re
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

import msgspec

from handeye.core.diagnostics import quoted, suggestion
from handeye.core.errors import BadFile
from handeye.core.source import Source, read_source
from handeye.program.program import Fixture, Held, Part, Position
from handeye.program.taught_tables import (
    FixtureTable,
    HeldTable,
    PartTable,
    PositionTable,
    UnfitEntry,
    read_tables,
    unfit,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Taught:
    """Positions, parts and fixtures by name, in SI units. Parts and positions that are referred to are there."""

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
    return read_taught(read_source(path))


def read_taught(source: Source) -> Taught:
    """What a text in TOML teaches (inches and degrees).

    Raises:
        InvalidInput: what is in it cannot be used; the sentence names the key.
    """
    path = source.name
    try:
        tables = msgspec.convert(tomllib.loads(source.text), _File)
        return _taught(tables)
    except tomllib.TOMLDecodeError as error:
        raise BadFile(f"{path} is not TOML: {_spoilt(error)}") from None
    except RecursionError:
        raise BadFile(f"{path} is not TOML: nested too deeply") from None
    except msgspec.ValidationError as error:
        raise BadFile(f"{path}: {unfit(error)}") from None
    except ValueError:  # of a whole number that Python does not read
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


def _spoilt(error: tomllib.TOMLDecodeError) -> str:
    """The words of a TOML reader, as the rest of a sentence."""
    said = str(error).replace("Cannot overwrite a value", "a name is used twice")
    return said[:1].lower() + said[1:]


def _line(source: Source, fault: UnfitEntry) -> int | None:
    """The line, from 1, on which an entry begins, if it is written as people write it."""
    kind, name = map(re.escape, (fault.kind, fault.name))
    header = rf"\[\s*{kind}\s*\.\s*[\"']?{name}[\"']?\s*\]"
    found = re.search(rf"^[ \t]*(?:{header}|[\"']?{name}[\"']?[ \t]*=)", source.text, re.MULTILINE)
    return None if found is None else source.position(found.end())[0]


def _faults(taught: Taught) -> Iterator[UnfitEntry]:
    """Faults between the entries of a file."""
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
                yield UnfitEntry("held", name, f"at {at} the hand already holds {where[at]}")
    count = 0
    for kind, solids in (("fixtures", taught.fixtures), ("held", taught.held)):
        for name, solid in solids.items():
            count += len(solid.boxes)
            if count > MOST_BOXES:
                yield UnfitEntry(kind, name, f"more than {MOST_BOXES} boxes, the limit")
