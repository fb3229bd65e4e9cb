"""Tabletop: what somebody does with the things on the table, between two commands."""

from abc import ABC, abstractmethod
from typing import Final

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument
from handeye.core.units import MILLIMETRE
from handeye.systems.trig.language.desk import number

MARK: Final = "*"
"""How a line begins that is about the table."""
MOST: Final = 25
"""Blocks of a stack."""
FARTHEST: Final = 200.0
"""mm from the middle of the table."""
_HELP: Final = "write `* STACK 20 X 150 Y 0`, `* BUCKET X 140 Y 0`, or `* CLEAR`"


class Tabletop(ABC):
    """What lies before an arm, as far as somebody puts it there."""

    @property
    @abstractmethod
    def count(self) -> int:
        """How many blocks there are."""

    @abstractmethod
    def stack(self, count: int, x: float, y: float) -> None:
        """Put blocks on each other at a place (m)."""

    @abstractmethod
    def bucket(self, x: float, y: float) -> None:
        """Put a bucket at a place (m).

        Raises:
            InvalidInput: there is one already.
        """

    @abstractmethod
    def clear(self) -> None:
        """Take everything away."""


def arrange(table: Tabletop, line: str) -> str:
    """Do what a line says with the things on the table.

    Returns:
        What lies there now, in words.

    Raises:
        InvalidInput: it says nothing that can be done.
    """
    words = line.removeprefix(MARK).upper().split()
    match words:
        case ["STACK", count, "X", x, "Y", y] if count.isdecimal() and 0 < int(count[:9]) <= MOST:
            table.stack(int(count), _at(x), _at(y))
        case ["STACK", count, "X", _, "Y", _]:
            raise BadArgument(f"a stack has 1 to {MOST} blocks, not {quoted(count)}")
        case ["BUCKET", "X", x, "Y", y]:
            table.bucket(_at(x), _at(y))
        case ["CLEAR"]:
            table.clear()
        case _:
            raise BadArgument(f"{quoted(' '.join(words))} cannot be done with a table; {_HELP}")
    return f"blocks on the table: {table.count}"


def _at(word: str) -> float:
    """A place on the table, m.

    Raises:
        InvalidInput: it is no number, or lies beyond the table.
    """
    if abs(number(word)) > FARTHEST:
        raise BadArgument(f"a table ends {FARTHEST:g} mm from its middle, before {quoted(word)}")
    return number(word) * MILLIMETRE
