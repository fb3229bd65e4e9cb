"""The syntax tree of an arm program. It has no cycles, so that nobody has to look for them (`gc`)."""

from typing import ClassVar, Final

import msgspec

from handeye.al.scanner import Token
from handeye.core.source import Located, Span

LONGEST_LINE: Final = 1000
"""Characters. Steps, plans and traces repeat the line they come from, for each call of a macro."""


class Operand(Located, frozen=True, gc=False, kw_only=True):
    """What stands at an operand."""

    use: Span | None = None
    """The parameter of a macro in whose place it stands; None: it stands where it is written."""


class Name(Operand, frozen=True, gc=False):
    """A word: the name of something, or a word of the language."""

    what: ClassVar[str] = "a name"
    text: str


class Number(Operand, frozen=True, gc=False):
    """A number in the unit of its place."""

    what: ClassVar[str] = "a number"
    value: float


class Vector(Operand, frozen=True, gc=False):
    """Numbers in brackets."""

    what: ClassVar[str] = "a vector"
    values: tuple[float, ...]


class Text(Operand, frozen=True, gc=False):
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
    tokens: tuple[Token, ...] = ()
    """Its operands before they are read: of a call, and of every line of a macro with parameters."""
    open: bool = False
    """A parameter stands in it: only a call tells its operands, which are not read yet."""


class Macro(msgspec.Struct, frozen=True, gc=False, kw_only=True):
    """`DEFINE name parameter ...`, statements, and a blank line."""

    name: Name
    """In capitals, as words of the instruction column are."""
    parameters: tuple[Name, ...] = ()
    body: tuple[Statement, ...]


class Script(msgspec.Struct, frozen=True, gc=False, kw_only=True):
    """A whole text, with what it requires."""

    statements: tuple[Statement, ...]
    macros: dict[str, Macro]
