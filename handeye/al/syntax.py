"""The syntax tree of an arm program. Trees are equal when they say the same, wherever it stands."""

from dataclasses import dataclass, field
from typing import ClassVar

from handeye.source import Span


@dataclass(frozen=True, slots=True)
class Name:
    """A word: the name of something, or a word of the language."""

    what: ClassVar[str] = "a name"
    text: str
    span: Span = field(compare=False)


@dataclass(frozen=True, slots=True)
class Number:
    """A number in the unit of its place."""

    what: ClassVar[str] = "a number"
    value: float
    span: Span = field(compare=False)


@dataclass(frozen=True, slots=True)
class Vector:
    """Numbers in brackets."""

    what: ClassVar[str] = "a vector"
    values: tuple[float, ...]
    span: Span = field(compare=False)


@dataclass(frozen=True, slots=True)
class Text:
    """Words for people; without the quotes."""

    what: ClassVar[str] = "a string"
    text: str
    span: Span = field(compare=False)


Value = Name | Number | Vector | Text


@dataclass(frozen=True, slots=True, kw_only=True)
class Statement:
    """A line: labels and perhaps an instruction or the name of a macro."""

    labels: tuple[Name, ...]
    word: Name | None
    """The instruction, in capitals, or the macro; None when the line has labels only."""
    operands: tuple[Value | None, ...]
    """One for each operand in the definition of the instruction; None where an optional one is left out."""
    broken: bool
    """A mistake in it has been reported; `operands` is empty."""
    line: int = field(compare=False)
    """In its own text; spans are of the whole."""
    span: Span = field(compare=False)
    """From the instruction to the last operand."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Macro:
    """`DEFINE name`, statements, and a blank line."""

    name: Name
    """In capitals, as words of the instruction column are."""
    body: tuple[Statement, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Script:
    """A whole text, with what it requires."""

    statements: tuple[Statement, ...]
    macros: dict[str, Macro]
