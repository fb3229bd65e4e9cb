"""Finds macros in unfinished texts, and the instructions in which the operands of macro calls are used."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from handeye.al.definition import Instruction, Operand
from handeye.al.heads import MacroHead, heads
from handeye.al.scanner import Line, TokenKind, scan
from handeye.editor.places import instruction, places


@dataclass(frozen=True, slots=True, kw_only=True)
class MacroBody:
    """The head and the lines of a macro."""

    head: MacroHead
    lines: Sequence[Line]

    @property
    def parameters(self) -> set[str]:
        """Names of the macro's parameters."""
        return {token.text for token in self.head.parameters}


@dataclass(frozen=True, slots=True, kw_only=True)
class Use:
    """An instruction's operand that gets its value from an operand of a macro call."""

    definition: Instruction
    operand: Operand


Macros = Mapping[str, MacroBody]


def macros_of(text: str) -> dict[str, MacroBody]:
    """Return the macros of a text by name."""
    found: dict[str, MacroBody] = {}
    lines = scan(text)
    for number, line in enumerate(lines):
        for head in heads([line]):
            end = next((at for at in range(number + 1, len(lines)) if ends(lines[at])), len(lines))
            found.setdefault(head.word, MacroBody(head=head, lines=lines[number + 1 : end]))
    return found


def ends(line: Line) -> bool:
    """Return True if a line ends a macro. A macro ends at a blank line, or at the head of another macro."""
    return line.is_blank or any(token.text.upper() == "DEFINE" for token in line.split()[1][:1])


def called(line: Line, macros: Macros) -> Instruction | None:
    """Return the macro that a line calls, as an instruction. Returns None if the line calls no macro, or if the
    macro's head has an error."""
    tokens = line.split()[1]
    macro = macros.get(tokens[0].text.upper()) if tokens else None
    return None if macro is None else macro.head.usage


def uses(macros: Macros, macro: str, parameter: str, seen: frozenset[str] = frozenset()) -> Iterator[Use]:
    """Yield each instruction's operand that gets its value from a parameter of a macro, directly or through nested
    calls.
    """
    if macro in seen or macro not in macros:
        return
    for line in macros[macro].lines:
        definition, tokens = instruction(line)
        call = called(line, macros)
        usage = definition or call
        if usage is None:
            continue
        for place in places(usage, tokens[1:]):
            given = place.token.kind is TokenKind.NAME and place.token.text == parameter
            if place.operand is None or not given:
                continue
            if call is None:
                yield Use(definition=usage, operand=place.operand)
            else:
                yield from uses(macros, usage.op, place.operand.name, seen | {macro})
