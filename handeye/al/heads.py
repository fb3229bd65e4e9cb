"""Heads of macros: what they are called, and what they take."""

from collections.abc import Iterable, Iterator, Sequence
from typing import Final

import msgspec

from handeye.al.definition import AXES, Instruction, Operand
from handeye.al.instructions import DEFINE, INSTRUCTIONS, RUN
from handeye.al.scanner import NAME, Line, Token
from handeye.al.syntax import Name, Number, Text, Vector
from handeye.al.word_groups import OPERAND_WORDS
from handeye.core.diagnostics import quoted

_ANY: Final = (Name, Number, Vector, Text)
"""What a call may give; the lines that it comes to take less."""


class Head(msgspec.Struct, frozen=True, gc=False):
    """A line with a `DEFINE` and a name, whatever else is wrong with it."""

    name: Token
    parameters: tuple[Token, ...]

    @property
    def word(self) -> str:
        """The name in capitals, as words of the instruction column are."""
        return self.name.text.upper()

    @property
    def usage(self) -> Instruction | None:
        """The macro as an instruction; None if its parameters are not names, each its own."""
        free = (t.text for t in self.parameters if t.kind is NAME and taken(t.text) is None)
        names = dict.fromkeys(free)
        return as_instruction(self.word, [*names]) if len(names) == len(self.parameters) else None


def heads(lines: Iterable[Line]) -> Iterator[Head]:
    """The heads of a text."""
    for line in lines:
        tokens = line.split()[1]
        if len(tokens) > 1 and tokens[0].text.upper() == DEFINE.op and tokens[1].kind is NAME:
            yield Head(tokens[1], tuple(token for token in tokens[2:] if token.text != ","))


def as_instruction(word: str, parameters: Sequence[str]) -> Instruction:
    """A macro as an instruction that takes what its calls give."""
    operands = tuple(Operand(name=name, takes=_ANY) for name in parameters)
    return Instruction(op=word, group=RUN, help="", operands=operands)


def taken(parameter: str) -> str | None:
    """What a name is already that no parameter can have; None: it is free."""
    if parameter.upper() in (*INSTRUCTIONS, DEFINE.op):
        return f"{quoted(parameter)} is an instruction"
    if parameter.upper() in OPERAND_WORDS:
        return f"{quoted(parameter)} is a word of the language"
    return f"{quoted(parameter)} is an axis of the table" if parameter in AXES else None
