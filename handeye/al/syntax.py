"""The syntax tree of an arm program. It has no cycles, so that nobody has to look for them (`gc`)."""

from typing import ClassVar

import msgspec

from handeye.source import Located


class Name(Located, frozen=True, gc=False):
    """A word: the name of something, or a word of the language."""

    what: ClassVar[str] = "a name"
    text: str


class Number(Located, frozen=True, gc=False):
    """A number in the unit of its place."""

    what: ClassVar[str] = "a number"
    value: float


class Vector(Located, frozen=True, gc=False):
    """Numbers in brackets."""

    what: ClassVar[str] = "a vector"
    values: tuple[float, ...]


class Text(Located, frozen=True, gc=False):
    """Words for people; without the quotes."""

    what: ClassVar[str] = "a string"
    text: str


Value = Name | Number | Vector | Text


class Statement(Located, frozen=True, gc=False):
    """A line: labels and perhaps an instruction or the name of a macro; from that to the last operand."""

    labels: tuple[Name, ...]
    word: Name | None
    """The instruction, in capitals, or the macro; None when the line has labels only."""
    line: int
    """In its own text; offsets are of the whole."""
    operands: tuple[Value | None, ...] = ()
    """One for each operand in the definition of the instruction; None where an optional one is left out."""
    broken: bool = False
    """A mistake in it has been reported; `operands` is empty, but for a name it begins with."""


class Macro(msgspec.Struct, frozen=True, gc=False, kw_only=True):
    """`DEFINE name`, statements, and a blank line."""

    name: Name
    """In capitals, as words of the instruction column are."""
    body: tuple[Statement, ...]


class Script(msgspec.Struct, frozen=True, gc=False, kw_only=True):
    """A whole text, with what it requires."""

    statements: tuple[Statement, ...]
    macros: dict[str, Macro]
