"""Desk: where somebody sits who teaches, with a keyboard, a screen, and the teach box of the arm."""

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


class Withdrawn(Exception):
    """Nobody answers: the question has been waved away."""


@dataclass(frozen=True, slots=True)
class Jog:
    """The buttons of one axis: it moves by an amount, or to a value, m or rad."""

    axis: int
    amount: float
    by: bool = True


Button = Jog | Literal["record", "kill"]
ENDS: Final[dict[str, Button]] = {"RECORD": "record", "SAVE": "record", "KILL": "kill"}
"""Buttons that end what is done with the teach box, by their words."""


class Desk(ABC):
    """What a session asks of the person, and tells."""

    @abstractmethod
    def answer(self, question: str) -> str:
        """An answer, as typed.

        Raises:
            Withdrawn: there is none.
        """

    @abstractmethod
    def press(self) -> Button:
        """The next thing that is done with the teach box.

        Raises:
            Withdrawn: nothing more is done with it.
        """

    @abstractmethod
    def tell(self, sentence: str) -> None:
        """Tell what has happened."""

    @abstractmethod
    def wrong(self, error: InvalidInput) -> None:
        """Tell that an answer, or a button, was of no use, before the next is waited for; or raise it."""

    def halted(self) -> bool:
        """True if somebody has struck a key since it was asked last."""
        return False

    def refresh(self) -> None:  # noqa: B027 - a desk without a screen has nothing to do
        """The program, its cursor or the arm has changed."""

    def ask(self, question: str, read: Callable[[str], Read]) -> Read:
        """An answer that can be used.

        Raises:
            Withdrawn: there is none.
        """
        while True:
            try:
                return read(self.answer(question))
            except InvalidInput as error:
                self.wrong(error)


def number(word: str) -> float:
    """A number as typed.

    Raises:
        InvalidInput: it is none.
    """
    if not _NUMBER.fullmatch(word):
        raise BadArgument(f"{quoted(word)} is not a number")
    return float(word)


def yes(word: str) -> bool:
    """Yes or no, as typed.

    Raises:
        InvalidInput: it is neither.
    """
    answer = word.strip().rstrip(".!").casefold()
    if answer not in ("y", "yes", "n", "no"):
        raise BadArgument(f"{quoted(word.strip())} is no answer; type Yes or No")
    return answer[0] == "y"


def buttons(line: str) -> list[Button]:
    """What is done with the teach box, as scripts have it: `X -30 Z BY 12 RECORD`, in mm and deg.

    Raises:
        InvalidInput: it is something else.
    """
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
    """How one axis moves."""
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
