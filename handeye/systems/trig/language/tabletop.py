"""The table: objects that a user arranges between commands."""

from abc import ABC, abstractmethod
from typing import Final

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument
from handeye.core.units import MILLIMETRE
from handeye.systems.trig.language.desk import number

MARK: Final = "*"  # first character of lines about the table
MAX_STACK: Final = 25  # blocks
TABLE_RADIUS_MM: Final = 200.0
_HELP: Final = "write `* STACK 20 X 150 Y 0`, `* BUCKET X 140 Y 0`, or `* CLEAR`"


class Tabletop(ABC):
    """The objects in front of an arm."""

    @property
    @abstractmethod
    def count(self) -> int:
        """Number of blocks."""

    @abstractmethod
    def stack(self, count: int, x: float, y: float) -> None:
        """Stack blocks at a place (m)."""

    @abstractmethod
    def bucket(self, x: float, y: float) -> None:
        """Put a bucket at a place (m)."""

    @abstractmethod
    def clear(self) -> None:
        """Remove everything."""


def arrange(table: Tabletop, line: str) -> str:
    """Carry out a line about the table; returns its content in words. Raises BadArgument."""
    words = line.removeprefix(MARK).upper().split()
    match words:
        case ["STACK", count, "X", x, "Y", y] if count.isdecimal() and 0 < int(count[:9]) <= MAX_STACK:
            table.stack(int(count), _at(x), _at(y))
        case ["STACK", count, "X", _, "Y", _]:
            raise BadArgument(f"a stack has 1 to {MAX_STACK} blocks, not {quoted(count)}")
        case ["BUCKET", "X", x, "Y", y]:
            table.bucket(_at(x), _at(y))
        case ["CLEAR"]:
            table.clear()
        case _:
            raise BadArgument(f"{quoted(' '.join(words))} cannot be done with a table; {_HELP}")
    return f"blocks on the table: {table.count}"


def _at(word: str) -> float:
    """A table coordinate, m."""
    if abs(number(word)) > TABLE_RADIUS_MM:
        raise BadArgument(f"a table ends {TABLE_RADIUS_MM:g} mm from its middle, before {quoted(word)}")
    return number(word) * MILLIMETRE
