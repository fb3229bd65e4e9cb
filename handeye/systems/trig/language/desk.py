"""Defines the user interface of a session: keyboard, screen, teach box, and the table on which the user places
objects.
"""

import re
from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, Literal, TypeVar

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, InvalidInput
from handeye.core.units import MILLIMETRE
from handeye.systems.trig.language.place import AXES, SIZES

Read = TypeVar("Read")
_NUMBER: Final = re.compile(r"[+-]?(\d{1,9}\.?\d{0,9}|\.\d{1,9})", re.ASCII)


class Cancelled(Exception):
    """Raised when the user cancels a question."""


@dataclass(frozen=True, slots=True)
class Jog:
    """A jog of one axis, by an amount or to a value (m or rad)."""

    axis: int
    amount: float
    by: bool = True


Button = Jog | Literal["record", "kill"]
ENDS: Final[dict[str, Button]] = {"RECORD": "record", "SAVE": "record", "KILL": "kill"}


class Desk(ABC):
    """The user interface of a session."""

    @abstractmethod
    def answer(self, question: str) -> str:
        """Ask a question, and return the answer as typed."""

    @abstractmethod
    def press(self) -> Button:
        """Return the next action on the teach box."""

    @abstractmethod
    def tell(self, sentence: str) -> None:
        """Show the user a sentence."""

    @abstractmethod
    def wrong(self, error: InvalidInput) -> None:
        """Report that the user's answer or action is invalid, before the next answer or action is read. A user
        interface that cannot ask again raises the error instead.
        """

    def halted(self) -> bool:
        """Return True if a key was pressed since the last call."""
        return False

    def refresh(self) -> None:  # noqa: B027 - a desk without a screen has nothing to do
        """Redraw the displays after a change of program, cursor or arm."""

    def ask(self, question: str, read: Callable[[str], Read]) -> Read:
        """Ask a question again and again until the answer is valid."""
        while True:
            try:
                return read(self.answer(question))
            except InvalidInput as error:
                self.wrong(error)


def number(word: str) -> float:
    """Parse a number. Raises BadArgument if the word is not a number."""
    if not _NUMBER.fullmatch(word):
        raise BadArgument(f"{quoted(word)} is not a number")
    return float(word)


def yes(word: str) -> bool:
    """Parse yes or no. Raises BadArgument if the word is neither."""
    answer = word.strip().rstrip(".!").casefold()
    if answer not in ("y", "yes", "n", "no"):
        raise BadArgument(f"{quoted(word.strip())} is not an answer; type Yes or No")
    return answer[0] == "y"


def buttons(line: str) -> list[Button]:
    """Parse a script's line with actions on the teach box, such as `X -30 Z BY 12 RECORD`. Its numbers are in mm and
    degrees.
    """
    found: list[Button] = []
    words = deque(line.upper().split())
    while words:
        word = words.popleft()
        if word not in ENDS:
            found.append(_jog(word, words))
            continue
        if words:
            raise BadArgument(f"{word} ends the work with the teach box; remove {quoted(words[0])} after it")
        found.append(ENDS[word])
    return found


def _jog(word: str, words: deque[str]) -> Jog:
    if word not in AXES:
        raise BadArgument(
            f"{quoted(word)} is not a control of the teach box; type `X -30`, `Z BY 12`, `RECORD` or `KILL`"
        )
    by = bool(words) and words[0] == "BY"
    if by:
        words.popleft()
    if not words:
        raise BadArgument(f"{word} needs a number: `{word} 30` means a place, `{word} BY 30` a distance")
    axis = AXES.index(word)
    return Jog(axis, number(words.popleft()) * SIZES[axis], by)


MARK: Final = "*"  # first character of lines about the table
MAX_STACK: Final = 25  # blocks
TABLE_RADIUS_MM: Final = 200.0
_HELP: Final = "type `* STACK 20 X 150 Y 0`, `* BUCKET X 140 Y 0`, or `* CLEAR`"


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
    """Execute a line that describes the table. Returns a sentence that says what is then on the table. Raises
    BadArgument if the line has another form, or if a number in it is out of range.
    """
    words = line.removeprefix(MARK).upper().split()
    match words:
        case ["STACK", count, "X", x, "Y", y] if count.isdecimal() and 0 < int(count[:9]) <= MAX_STACK:
            table.stack(int(count), _at(x), _at(y))
        case ["STACK", count, "X", _, "Y", _]:
            raise BadArgument(f"a stack must have 1 to {MAX_STACK} blocks, not {quoted(count)}")
        case ["BUCKET", "X", x, "Y", y]:
            table.bucket(_at(x), _at(y))
        case ["CLEAR"]:
            table.clear()
        case _:
            raise BadArgument(f"{quoted(' '.join(words))} is not an action on the table; {_HELP}")
    return f"blocks on the table: {table.count}"


def _at(word: str) -> float:
    if abs(number(word)) > TABLE_RADIUS_MM:
        raise BadArgument(
            f"{quoted(word)} is beyond the table, which ends {TABLE_RADIUS_MM:g} mm from its centre"
        )
    return number(word) * MILLIMETRE
