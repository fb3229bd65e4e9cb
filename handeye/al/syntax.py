"""The syntax tree of an arm program. The tree has no reference cycles, so its classes are made with `gc=False`."""

from typing import ClassVar, Final

import msgspec

from handeye.al.scanner import Token
from handeye.core.source import Located, Span

LONGEST_LINE: Final = 1000  # characters; steps, plans and traces repeat it for each macro call


class Operand(Located, frozen=True, gc=False, kw_only=True):
    """An operand. `use` is the span of the macro parameter that the operand replaces, if any."""

    use: Span | None = None


class Name(Operand, frozen=True, gc=False):
    """The name of an object, or a keyword."""

    what: ClassVar[str] = "a name"
    text: str


class Number(Operand, frozen=True, gc=False):
    """A number in the unit of its operand."""

    what: ClassVar[str] = "a number"
    value: float


class Vector(Operand, frozen=True, gc=False):
    """Numbers in brackets."""

    what: ClassVar[str] = "a vector"
    values: tuple[float, ...]


class Text(Operand, frozen=True, gc=False):
    """A text without its quotes."""

    what: ClassVar[str] = "a string"
    text: str


Value = Name | Number | Vector | Text


class Statement(Located, frozen=True, gc=False):
    """A line: labels, and an instruction or a macro call. A line may have only labels, or no labels."""

    labels: tuple[Name, ...]
    word: Name | None  # instruction in capitals, or macro; None if there are only labels
    line: int  # in its own file
    operands: tuple[Value | None, ...] = ()  # as in the definition; None where left out
    broken: bool = False  # an error was reported; at most a first name in `operands`
    tokens: tuple[Token, ...] = ()  # unread operands, kept for calls and lines of macros with parameters
    open: bool = False  # has a parameter: operands are read at each call


class Macro(msgspec.Struct, frozen=True, gc=False, kw_only=True):
    """A macro: `DEFINE name parameter ...`, statements, and a blank line."""

    name: Name  # in capitals
    parameters: tuple[Name, ...] = ()
    body: tuple[Statement, ...]


class Script(msgspec.Struct, frozen=True, gc=False, kw_only=True):
    """A whole script, including the texts that it requires."""

    statements: tuple[Statement, ...]
    macros: dict[str, Macro]
