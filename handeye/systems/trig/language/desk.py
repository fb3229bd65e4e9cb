"""The teacher's desk: keyboard, screen, and the arm's teach box."""

import re
from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, Literal, TypeVar

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, InvalidInput
from handeye.systems.trig.language.place import AXES, SIZES

Read = TypeVar("Read")
_NUMBER: Final = re.compile(r"[+-]?(\d{1,9}\.?\d{0,9}|\.\d{1,9})", re.ASCII)


class Cancelled(Exception):
    """The question was cancelled."""


@dataclass(frozen=True, slots=True)
class Jog:
    """A jog of one axis by an amount, or to a value, m or rad."""

    axis: int
    amount: float
    by: bool = True


Button = Jog | Literal["record", "kill"]
ENDS: Final[dict[str, Button]] = {"RECORD": "record", "SAVE": "record", "KILL": "kill"}


class Desk(ABC):
    """The session's interface to the user."""

    @abstractmethod
    def answer(self, question: str) -> str:
        """The answer to a question, as typed."""

    @abstractmethod
    def press(self) -> Button:
        """The next action on the teach box."""

    @abstractmethod
    def tell(self, sentence: str) -> None:
        """Report a sentence."""

    @abstractmethod
    def wrong(self, error: InvalidInput) -> None:
        """Report an unusable answer or button before the next is awaited; or raise it."""

    def halted(self) -> bool:
        """True if a key was struck since the last call."""
        return False

    def refresh(self) -> None:  # noqa: B027 - a desk without a screen has nothing to do
        """Redraw after a change of program, cursor or arm."""

    def ask(self, question: str, read: Callable[[str], Read]) -> Read:
        """Ask until an answer can be read."""
        while True:
            try:
                return read(self.answer(question))
            except InvalidInput as error:
                self.wrong(error)


def number(word: str) -> float:
    """A number as typed; raises BadArgument."""
    if not _NUMBER.fullmatch(word):
        raise BadArgument(f"{quoted(word)} is not a number")
    return float(word)


def yes(word: str) -> bool:
    """Yes or no, as typed; raises BadArgument."""
    answer = word.strip().rstrip(".!").casefold()
    if answer not in ("y", "yes", "n", "no"):
        raise BadArgument(f"{quoted(word.strip())} is no answer; type Yes or No")
    return answer[0] == "y"


def buttons(line: str) -> list[Button]:
    """Teach box actions as scripts have them: `X -30 Z BY 12 RECORD`, in mm and deg."""
    found: list[Button] = []
    words = deque(line.upper().split())
    while words:
        word = words.popleft()
        if word not in ENDS:
            found.append(_jog(word, words))
            continue
        if words:
            raise BadArgument(
                f"{word} ends what is done with the teach box; {quoted(words[0])} comes too late"
            )
        found.append(ENDS[word])
    return found


def _jog(word: str, words: deque[str]) -> Jog:
    """The jog of one axis."""
    if word not in AXES:
        raise BadArgument(
            f"{quoted(word)} is nothing on the teach box; write `X -30`, `Z BY 12`, `RECORD` or `KILL`"
        )
    by = bool(words) and words[0] == "BY"
    if by:
        words.popleft()
    if not words:
        raise BadArgument(f"{word} moves where? `{word} 30` is a place, `{word} BY 30` a way")
    axis = AXES.index(word)
    return Jog(axis, number(words.popleft()) * SIZES[axis], by)
