"""Reads the heads of macros: their names and parameters."""

from collections.abc import Iterable, Iterator, Sequence
from typing import Final

import msgspec

from handeye.al.definition import AXES, Instruction, Operand
from handeye.al.instructions import DEFINE, INSTRUCTIONS, OPERAND_WORDS, RUN
from handeye.al.scanner import NAME, Line, Token
from handeye.al.syntax import Name, Number, Text, Vector
from handeye.core.diagnostics import quoted

_CALL_OPERANDS: Final = (Name, Number, Vector, Text)  # the lines of the macro may accept less


class MacroHead(msgspec.Struct, frozen=True, gc=False):
    """A `DEFINE` line with a name. The rest of the line may be wrong."""

    name: Token
    parameters: tuple[Token, ...]

    @property
    def word(self) -> str:
        """The name in capitals, as it appears in the column of instructions."""
        return self.name.text.upper()

    @property
    def usage(self) -> Instruction | None:
        """The macro as an instruction; None if a parameter of the macro occurs twice or has a name that is not
        allowed.
        """
        free = (t.text for t in self.parameters if t.kind is NAME and taken(t.text) is None)
        names = dict.fromkeys(free)
        return as_instruction(self.word, [*names]) if len(names) == len(self.parameters) else None


def heads(lines: Iterable[Line]) -> Iterator[MacroHead]:
    """Yield the heads of all macros in a text."""
    for line in lines:
        tokens = line.split()[1]
        if len(tokens) > 1 and tokens[0].text.upper() == DEFINE.op and tokens[1].kind is NAME:
            yield MacroHead(tokens[1], tuple(token for token in tokens[2:] if token.text != ","))


def as_instruction(word: str, parameters: Sequence[str]) -> Instruction:
    """Make an instruction from a macro, with its parameters as operands."""
    operands = tuple(Operand(name=name, takes=_CALL_OPERANDS) for name in parameters)
    return Instruction(op=word, group=RUN, help="", operands=operands)


def taken(parameter: str) -> str | None:
    """Return the reason why a name cannot be a parameter, or None if the name can be a parameter."""
    if parameter.upper() in (*INSTRUCTIONS, DEFINE.op):
        return f"{quoted(parameter)} is an instruction"
    if parameter.upper() in OPERAND_WORDS:
        return f"{quoted(parameter)} is a word of the language"
    return f"{quoted(parameter)} is an axis of the table" if parameter in AXES else None
