"""Positions, named or of a single step."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument
from handeye.systems.trig.language.place import Place

LONGEST: Final = 40  # characters of a name
NAME: Final = re.compile(r"[A-Z][A-Z0-9_-]*", re.ASCII)
_UNNAMED: Final = "_"  # prefix of positions without a name


@dataclass(slots=True, kw_only=True)
class Position:
    """An absolute place, or a relative offset from wherever the arm is."""

    relative: bool
    init: Place  # as defined; a run from the top starts with it
    data: Place  # present value, which SAVPOS changes
    unread: Mapping[str, object] = field(default_factory=dict)  # file fields unknown to this version


Positions = dict[str, Position]
"""By name; those of single steps by names that cannot be typed."""


def name_of(word: str) -> str:
    """A name in capitals; raises BadArgument."""
    if len(word) > LONGEST:
        raise BadArgument(f"{quoted(word)} has {len(word)} characters; a name has {LONGEST} at most")
    if not NAME.fullmatch(word.upper()) or not word.isascii():
        raise BadArgument(f"{quoted(word)} is not a name: a letter, then letters, digits, `-` and `_`")
    return word.upper()


def is_named(name: str) -> bool:
    """True if the name was given by a user."""
    return not name.startswith(_UNNAMED)


def free_name(positions: Positions) -> str:
    """A name for an unnamed position."""
    number = 1 + max((int(name[1:]) for name in positions if not is_named(name)), default=0)
    return f"{_UNNAMED}{number}"
