"""The user interface for terminals without a full screen: the user types lines, and TRIG prints lines."""

import sys
from collections import deque
from collections.abc import Callable, Iterable

from handeye.cli.common import say, screen
from handeye.cli.panic_button import PanicButton
from handeye.cli.prompt import typed_lines
from handeye.core.errors import InvalidInput
from handeye.core.signals import ToldToEnd
from handeye.systems.trig.language.command_input import hear, stripped
from handeye.systems.trig.language.command_table import COMMANDS
from handeye.systems.trig.language.desk import Button, Cancelled, Desk, buttons
from handeye.systems.trig.language.display import full_display, partial_display
from handeye.systems.trig.language.place import is_named, told_place
from handeye.systems.trig.language.session import Session
from handeye.systems.trig.language.styled import plain, symbols_for

PROMPT = ">"
BOX_PROMPT = "teach box (X 30, Z BY -5, RECORD, KILL)> "
ROWS = 12  # number of rows of the partial display


class LineDesk(Desk):
    """Reads typed lines. Some lines stand for actions on the teach box."""

    def __init__(self, panic: PanicButton) -> None:
        self._panic = panic
        self._pressed = deque[Button]()
        self.words: Callable[[], Iterable[str]] = lambda: COMMANDS

    def line(self, prompt: str) -> str | None:
        """Return a typed line, or None at the end of the input."""
        return next(typed_lines(prompt, self._panic.aside, self.words, droppable=prompt == PROMPT), None)

    def answer(self, question: str) -> str:
        try:
            line = self.line(question)
        except ToldToEnd:
            raise
        except KeyboardInterrupt:
            raise Cancelled from None
        if not line:
            raise Cancelled
        return line

    def press(self) -> Button:
        while not self._pressed:
            try:
                self._pressed.extend(buttons(stripped(self.answer(BOX_PROMPT))))
            except InvalidInput as error:
                self.wrong(error)
        return self._pressed.popleft()

    def tell(self, sentence: str) -> None:
        say(sentence)

    def wrong(self, error: InvalidInput) -> None:
        self._pressed.clear()
        say(str(error), style="red")

    def halted(self) -> bool:
        return self._panic()


def converse(session: Session, panic: PanicButton) -> None:
    """Execute lines until the user leaves. After each change, show both displays."""
    session.desk = desk = LineDesk(panic)
    desk.words = lambda: (*COMMANDS, *_names(session))
    shown = ""
    while not session.over:
        if (picture := _picture(session)) != shown:
            say(picture, whole=True)
            shown = picture
        line = desk.line(PROMPT)
        if line is None:
            return
        try:
            hear(session, line)
        except InvalidInput as error:
            desk.wrong(error)


def _names(session: Session) -> Iterable[str]:
    steps = (node.name for node in session.program.graph.nodes.values() if node.name)
    return (*filter(is_named, session.program.positions), *steps)


def _picture(session: Session) -> str:
    """Return both displays, and the place of the arm, as text."""
    symbols, width = symbols_for(sys.stdout.encoding), screen.width
    lines = [*full_display(session.program, width, ROWS, symbols), []]
    lines += partial_display(session.program, width, ROWS, symbols)
    hand = "closed" if session.arm.closed else "open"
    return f"\n{plain(lines)}\n\n{told_place(session.arm.here())}, hand {hand}"
