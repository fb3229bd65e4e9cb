"""The macros of texts in the making, and what becomes of the operands of their calls."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from handeye.al.definition import Instruction, Operand
from handeye.al.heads import MacroHead, heads
from handeye.al.scanner import Line, TokenKind, scan
from handeye.editor.places import instruction, places


@dataclass(frozen=True, slots=True, kw_only=True)
class MacroBody:
    """A macro as it stands in its text."""

    head: MacroHead
    lines: Sequence[Line]

    @property
    def parameters(self) -> set[str]:
        """Names that stand for operands in its lines."""
        return {token.text for token in self.head.parameters}


@dataclass(frozen=True, slots=True, kw_only=True)
class Use:
    """A place where an operand of a call comes to stand."""

    definition: Instruction
    operand: Operand


Macros = Mapping[str, MacroBody]


def macros_of(text: str) -> dict[str, MacroBody]:
    """The macros that a text makes, by name."""
    found: dict[str, MacroBody] = {}
    lines = scan(text)
    for number, line in enumerate(lines):
        for head in heads([line]):
            end = next((at for at in range(number + 1, len(lines)) if ends(lines[at])), len(lines))
            found.setdefault(head.word, MacroBody(head=head, lines=lines[number + 1 : end]))
    return found


def ends(line: Line) -> bool:
    """True if no macro goes on here: a blank line, or the beginning of another."""
    return line.is_blank or any(token.text.upper() == "DEFINE" for token in line.split()[1][:1])


def called(line: Line, macros: Macros) -> Instruction | None:
    """The macro that a line calls, as an instruction; None if it calls none, or one with a wrong head."""
    tokens = line.split()[1]
    macro = macros.get(tokens[0].text.upper()) if tokens else None
    return None if macro is None else macro.head.usage


def uses(macros: Macros, macro: str, parameter: str, seen: frozenset[str] = frozenset()) -> Iterator[Use]:
    """The instructions that an operand comes to, through whatever calls, and where it stands in them."""
    if macro in seen or macro not in macros:
        return
    for line in macros[macro].lines:
        definition, tokens = instruction(line)
        call = called(line, macros)
        usage = definition or call
        if usage is None:
            continue
        for place in places(usage, tokens[1:]):
            if (
                place.operand is None
                or place.token.kind is not TokenKind.NAME
                or place.token.text != parameter
            ):
                continue
            if call is None:
                yield Use(definition=usage, operand=place.operand)
            else:
                yield from uses(macros, usage.op, place.operand.name, seen | {macro})
