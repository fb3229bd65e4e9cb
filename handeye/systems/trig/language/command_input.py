"""Executes typed lines as commands, from a terminal or a script. An invalid line is refused with a one-sentence
message.

A script has the lines that a user would type at a terminal. Each command is a line. The lines after a command are the
actions on the teach box (`X 0 Y 0 Z 250 RECORD`) and the answers to the command's questions. A line may also begin
with the prompt or the question that the terminal shows. Remarks begin with `;`.
"""

from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Final

from handeye.core.diagnostics import nearest, quoted
from handeye.core.errors import BadArgument, BadFile, InvalidInput, NoSuchName
from handeye.core.units import MILLIMETRE
from handeye.systems.trig.language.arguments import read_arguments
from handeye.systems.trig.language.command_table import COMMANDS, SYNONYMS, TABLE, TrigCommand
from handeye.systems.trig.language.desk import (
    ENDS,
    MARK,
    Button,
    Cancelled,
    Desk,
    Jog,
    Read,
    arrange,
    buttons,
)
from handeye.systems.trig.language.place import AXES, SIZES
from handeye.systems.trig.language.session import Session
from handeye.systems.trig.language.trig_arm import Halted

WITHDRAWN: Final = "cancelled"
TABLE_HELP: Final = (
    "To place objects on the table, as a person would:",
    "  * STACK 20 X 150 Y 0  stack blocks at a place, in mm",
    "  * BUCKET X 140 Y 0    put a bucket at a place",
    "  * CLEAR               remove everything",
)


def hear(session: Session, line: str) -> None:
    """Execute a line. An invalid or cancelled line leaves the program unchanged."""
    word, _, rest = stripped(line).partition(" ")
    if not word:
        return
    if word.startswith(MARK):
        session.desk.tell(arrange(session.table, f"{word} {rest}"))
        return
    if word.upper() in ("HELP", "?"):
        session.desk.tell(help(rest.strip()))
        return
    command = command_of(word)
    try:
        command.act(session, read_arguments(command.usage, command.takes, command.needs, rest.strip()))
    except Cancelled:
        session.desk.tell(WITHDRAWN)
    session.desk.refresh()


def stripped(line: str) -> str:
    """Return the command in a line, without the paper's prompt and without remarks."""
    return " ".join(line.partition(";")[0].split()).removeprefix(">").lstrip()


def command_of(word: str) -> TrigCommand:
    """Return the command for a word in upper or lower case. Raises NoSuchName if the word is not a command."""
    upper = word.upper()
    command = COMMANDS.get(SYNONYMS.get(upper, upper))
    if command is not None:
        return command
    if upper in (*AXES, *ENDS):
        raise BadArgument(
            f"{upper} is a control of the teach box, which works only while M or FREE is waiting"
        )
    near = nearest(upper, [*COMMANDS, *SYNONYMS], max(1, len(upper) // 3)) if len(upper) > 1 else None
    raise NoSuchName(
        f"there is no command {quoted(word)}; "
        + (f"did you mean {near}?" if near else "HELP lists the commands")
    )


def help(word: str) -> str:
    """Return help on all commands, or on one command."""
    if word:
        command = command_of(word)
        return f"{command.usage}: {command.help}"
    lines: list[str] = []
    width = max(len(command.usage) for command in TABLE)
    for group in dict.fromkeys(command.group for command in TABLE):
        rows = [f"  {each.usage:{width}}  {each.help}" for each in TABLE if each.group == group]
        lines += [*([""] if lines else []), f"To {group}:", *rows]
    return "\n".join([*lines, "", *TABLE_HELP])


class Script(Desk):
    """A user interface that reads its input from a text."""

    def __init__(
        self,
        lines: Iterable[str],
        tell: Callable[[str], None] = lambda _: None,
        halted: Halted = lambda: False,
        slip: Callable[[int], float] = lambda _: 0.0,
    ) -> None:
        """Prepare to read `lines`. `slip` returns the teaching error (m) of a jog of X, Y or Z; its argument is the
        number of earlier jogs of X, Y or Z.
        """
        self._lines, self._halted = enumerate(lines, 1), halted
        self._told, self._slip, self._jogs = tell, slip, 0
        self._pressed = deque[Button]()
        self.number = 0  # number of the line read last, from 1

    def next_line(self) -> str | None:
        """Return the next line that is not empty, or None at the end of the text."""
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

    def ask(self, question: str, read: Callable[[str], Read]) -> Read:
        answer = self.answer(question)
        try:
            return read(answer)
        except InvalidInput as error:
            raise BadArgument(f"TRIG asks “{question.strip()}”, but {error}") from None

    def press(self) -> Button:
        while not self._pressed:
            line = self.next_line()
            if line is None:
                raise Cancelled
            self._pressed.extend(buttons(line))
        return self._slipped(self._pressed.popleft())

    def _slipped(self, button: Button) -> Button:
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
    """Raised if a line of a script cannot be executed."""

    def __init__(self, name: str, number: int, why: str) -> None:
        super().__init__(f"{name}, line {number}: {why}")
        self.name, self.number, self.why = name, number, why

    def on(self, arm: str) -> "LineRefused":
        """Return the error with a longer message, which also names the arm on which the script was typed."""
        return LineRefused(self.name, self.number, f"{self.why} (typed on {arm})")


def type_script(session: Session, script: Script, name: str) -> int:
    """Execute the lines of a script until the script leaves the session. Returns the number of commands.
    Messages call the script `name`.
    """
    count = 0
    while not session.over and (line := script.next_line()) is not None:
        try:
            hear(session, line)
        except InvalidInput as error:
            raise LineRefused(name, script.number, str(error)) from None
        count += not line.startswith("*")
    return count
