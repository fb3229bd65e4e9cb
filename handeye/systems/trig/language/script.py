"""Scripts: a user's input as lines of text.

The lines are those of a terminal: commands, with or without the prompt; after a command the buttons of the teach box
(`X 0 Y 0 Z 250 RECORD`) and the answers to its questions, with or without the question. Remarks begin with `;`.
"""

from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import replace

from handeye.core.errors import BadFile, InvalidInput
from handeye.core.units import MILLIMETRE
from handeye.systems.trig.language.desk import Button, Cancelled, Desk, Jog, buttons
from handeye.systems.trig.language.hearing import hear, stripped
from handeye.systems.trig.language.place import SIZES
from handeye.systems.trig.language.session import Session
from handeye.systems.trig.language.teachable import Halted


class Script(Desk):
    """A desk that reads from a text."""

    def __init__(
        self,
        lines: Iterable[str],
        tell: Callable[[str], None] = lambda _: None,
        halted: Halted = lambda: False,
        slip: Callable[[int], float] = lambda _: 0.0,
    ) -> None:
        """`slip` is the error (m) of a teach box move of X, Y or Z, by the number of such moves before."""
        self._lines, self._halted = enumerate(lines, 1), halted
        self._told, self._slip, self._jogs = tell, slip, 0
        self._pressed = deque[Button]()
        self.number = 0
        """Number of the line read last, from 1."""

    def next_line(self) -> str | None:
        """The next line that is not empty, or None."""
        for number, line in self._lines:
            self.number = number
            if text := stripped(line):
                return text
        return None

    def answer(self, question: str) -> str:
        line = self.next_line()
        if line is None:
            raise Cancelled
        return line.removeprefix(question.strip()).strip()

    def press(self) -> Button:
        while not self._pressed:
            line = self.next_line()
            if line is None:
                raise Cancelled
            self._pressed.extend(buttons(line))
        return self._slipped(self._pressed.popleft())

    def _slipped(self, button: Button) -> Button:
        """A button with the user's error added."""
        if not isinstance(button, Jog) or SIZES[button.axis] != MILLIMETRE:
            return button
        self._jogs += 1
        return replace(button, amount=button.amount + self._slip(self._jogs - 1))

    def tell(self, sentence: str) -> None:
        self._told(sentence)

    def halted(self) -> bool:
        return self._halted()

    def wrong(self, error: InvalidInput) -> None:
        self._pressed.clear()
        raise error


class LineRefused(BadFile):
    """A line of a script cannot be carried out."""

    def __init__(self, name: str, number: int, why: str) -> None:
        super().__init__(f"{name}, line {number}: {why}")
        self.number, self.why = number, why


def type_script(session: Session, script: Script, name: str) -> int:
    """Carry out the lines of a script until it leaves; returns the number of commands. `name` is for messages."""
    count = 0
    while not session.over and (line := script.next_line()) is not None:
        try:
            hear(session, line)
        except InvalidInput as error:
            raise LineRefused(name, script.number, str(error)) from None
        count += not line.startswith("*")
    return count
