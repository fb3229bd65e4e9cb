"""The syntax tree of a MAL program."""

from dataclasses import dataclass
from typing import Literal, NamedTuple

from handeye.core.source import Span
from handeye.systems.sigma.mal.scanner import Token

MAIN = "MAIN"  # the task of the lines before the first TASK


class Number(NamedTuple):
    """A number."""

    value: float


class Variable(NamedTuple):
    """A variable that is read."""

    name: Token


class Unary(NamedTuple):
    """`-` or NOT before an operand."""

    operator: str
    operand: "Expression"


class Binary(NamedTuple):
    """An operator between two operands."""

    operator: str
    left: "Expression"
    right: "Expression"


class Call(NamedTuple):
    """A call of a function. The argument is an expression, an axis or None."""

    function: str
    argument: "Expression | Token | None"


Expression = Number | Variable | Unary | Binary | Call


class Text(NamedTuple):
    """A quoted text in a PRINT or STOP statement."""

    text: str


class AxisGoal(NamedTuple):
    """An axis with its goal or distance."""

    axis: Token
    mode: Literal["TO", "BY"]
    distance: Expression


@dataclass(frozen=True, slots=True, kw_only=True)
class Statement:
    """A statement. The word of the statement determines, according to the grammar, which fields are set."""

    word: str
    span: Span
    names: tuple[Token, ...] = ()  # variable, flags, tasks, axes or device
    values: tuple[Expression, ...] = ()
    target: Token | None = None  # a line number
    then: "Statement | None" = None  # of IF
    otherwise: "Statement | None" = None
    goals: tuple[AxisGoal, ...] = ()
    slow: Expression | None = None
    straight: bool = False  # LINE
    waits: bool = True  # False with NOWAIT
    items: tuple["Text | Expression | str", ...] = ()  # of PRINT and STOP; separators as they are


@dataclass(frozen=True, slots=True, kw_only=True)
class Line:
    """A numbered line."""

    number: int
    task: str
    statement: Statement
    row: int  # row in the text, from 1
    text: str  # the statement as it is written
    span: Span  # span of the line number
