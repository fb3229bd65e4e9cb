"""Statements of ML, and their standard text. From this text, the parser makes the same statements again."""

from typing import Final

from handeye.core.record import Record
from handeye.core.source import Span
from handeye.systems.ml.language.commands import COMMANDS, TABLE_NAMES

LAST: Final = 5000  # greatest sequence number
VARIABLES: Final = 256
DEEPEST: Final = 6  # greatest number of ampersands of a reference
MOTORS: Final = 12
FINGERS: Final = 11  # the first of the two motors of the fingers

Point = tuple[int, ...]  # positions of the 12 motors


class Reference(Record, frozen=True):
    """A reference to a variable: `&17` is the value of variable 17, and `&&17` is the value of the variable whose
    number is in variable 17.
    """

    index: int
    depth: int = 1
    negative: bool = False

    def __str__(self) -> str:
        return f"{'-' * self.negative}{'&' * self.depth}{self.index}"


Parameter = int | Reference | str  # a text names a file


class Statement(Record, frozen=True):
    """A command with its parameters. `point` has the positions that a listing gives for a POINT."""

    code: str
    parameters: tuple[Parameter, ...] = ()
    point: Point = ()

    def __str__(self) -> str:
        return statement_text(self.code, self.parameters, self.point)


class Line(Record, frozen=True, kw_only=True):
    """A line of a text. `spans` are the places of the command and of each parameter."""

    number: int | None  # None: the line is executed at once
    statement: Statement
    row: int
    span: Span  # the span of the sequence number or, without one, of the command
    spans: tuple[Span, ...]

    def place(self, parameter: int) -> Span:
        """Return the span of the parameter with this number, counted from 0. If the statement has no parameter with
        this number, return the span of the command.
        """
        return self.spans[parameter + 1] if parameter + 1 < len(self.spans) else self.spans[0]


def statement_text(code: str, parameters: tuple[Parameter, ...], point: Point = ()) -> str:
    """Write a statement. Where a parameter must be a table, the text has the name of the table."""
    words = [code]
    for number, each in enumerate(parameters):
        if isinstance(each, int) and COMMANDS[code].kind(number) == "table":
            words.append(TABLE_NAMES.get(each, str(each)))
        else:
            words.append(str(each))
    if point:
        words += ["*", *map(str, point)]
    return " ".join(words)
