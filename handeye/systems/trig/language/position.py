"""Position: what a name, or one step alone, goes to."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument
from handeye.systems.trig.language.place import Place

LONGEST: Final = 40
"""Characters of a name."""
NAME: Final = re.compile(r"[A-Z][A-Z0-9_-]*", re.ASCII)
_UNNAMED: Final = "_"
"""How the positions begin that no one can name."""


@dataclass(slots=True, kw_only=True)
class Position:
    """A place to go to, or (relative) a way to go from wherever the arm is."""

    relative: bool
    init: Place
    """As it was defined; what a run from the top begins with."""
    data: Place
    """As it is now: SAVPOS changes it."""
    unread: Mapping[str, object] = field(default_factory=dict)
    """What a file says of it that this version does not know."""


Positions = dict[str, Position]
"""By their names; those of steps alone by names that nobody can type."""


def name_of(word: str) -> str:
    """A name as it is kept, in capitals.

    Raises:
        InvalidInput: it is none.
    """
    if len(word) > LONGEST:
        raise BadArgument(f"{quoted(word)} has {len(word)} characters; a name has {LONGEST} at most")
    if not NAME.fullmatch(word.upper()) or not word.isascii():
        raise BadArgument(f"{quoted(word)} is not a name: a letter, then letters, digits, `-` and `_`")
    return word.upper()


def is_named(name: str) -> bool:
    """Whether somebody has given this name."""
    return not name.startswith(_UNNAMED)


def free_name(positions: Positions) -> str:
    """A name for a position that no one names."""
    number = 1 + max((int(name[1:]) for name in positions if not is_named(name)), default=0)
    return f"{_UNNAMED}{number}"
