"""Occurrences of names in a text: what they name, and whether they define or use it."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

from handeye.al.definition import Instruction, Refers
from handeye.al.heads import MacroHead, heads
from handeye.al.parameters import braced
from handeye.al.scanner import Line, Token, TokenKind, scan
from handeye.al.syntax import Name
from handeye.core.source import Span
from handeye.editor.macro_bodies import Macros, Use, called, ends, uses
from handeye.editor.places import instruction, places

POSITION, PART, PICTURE = Refers.POSITION.value, Refers.PART.value, Refers.PICTURE.value
SAVED, LABEL, MACRO, PARAMETER = Refers.SAVED.value, Refers.LABEL.value, "macro", "parameter"
PARK: Final = "PARK"
"""The instruction whose word is the name of a position."""
_MAKES: Final = {
    "TRANS": POSITION, "HERE": POSITION, "SAVE": SAVED, "LOOK": PICTURE, "ASSIGN": "counter", "VECT": "vector"
}  # fmt: skip
"""Kinds of names that instructions define."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Occurrence:
    """A name at a place."""

    kind: str
    """`position`, `part`, `label`, ...: names of different kinds do not meet."""
    name: str
    span: Span
    makes: bool
    """It is defined here."""
    scope: str = ""
    """The macro within which a label or a parameter is known; empty: the text."""
    macro: str = ""
    """The macro it stands in; empty: none."""
    fixed: bool = False
    """A word of the language, which cannot be renamed."""


def occurrences(text: str, parts: Iterable[str], macros: Macros) -> list[Occurrence]:
    """Every name in a text, in its order.

    Args:
        parts: tells parts from positions where either may stand.
        macros: those made here or elsewhere.
    """
    found = list(_walk(scan(text), macros, set(parts)))
    own = {(o.name, o.scope) for o in found if o.kind == LABEL and o.makes}
    return [_in_scope(occurrence, own) for occurrence in found]


def same(one: Occurrence, other: Occurrence) -> bool:
    """True if both name the same thing."""
    return (one.kind, one.name, one.scope) == (other.kind, other.name, other.scope)


def makes(definition: Instruction) -> str | None:
    """The kind of thing an instruction with a new name makes."""
    named = definition.operands and definition.operands[0].refers is Refers.NEW
    return _MAKES.get(definition.op) if named and Name in definition.operands[0].takes else None


def _walk(lines: Sequence[Line], macros: Macros, parts: set[str]) -> Iterator[Occurrence]:
    scope, parameters = "", set[str]()
    for line in lines:
        labels, tokens = line.split()
        for label in labels:
            yield Occurrence(
                kind=LABEL, name=label.text, span=label.span, makes=True, scope=scope, macro=scope
            )
        if ends(line):
            scope, parameters = "", set()
            for head in heads([line]):
                scope, parameters = head.word, {token.text for token in head.parameters}
                yield from _head(head)
        else:
            if tokens and tokens[0].text.upper() in macros:
                word = tokens[0].text.upper()
                yield Occurrence(kind=MACRO, name=word, span=tokens[0].span, makes=False, macro=scope)
            yield from _operands(line, _Where(macros, scope, parameters, parts))


def _head(head: MacroHead) -> Iterator[Occurrence]:
    yield Occurrence(kind=MACRO, name=head.word, span=head.name.span, makes=True)
    first = {token.text: token for token in reversed(head.parameters) if token.kind is TokenKind.NAME}
    for token in reversed(first.values()):
        yield Occurrence(
            kind=PARAMETER, name=token.text, span=token.span, makes=True, scope=head.word, macro=head.word
        )


@dataclass(frozen=True, slots=True)
class _Where:
    """The macro that a line stands in, and what tells names there."""

    macros: Macros
    macro: str
    parameters: set[str]
    parts: set[str]

    def parameter(self, name: str, span: Span) -> Occurrence:
        return Occurrence(
            kind=PARAMETER, name=name, span=span, makes=False, scope=self.macro, macro=self.macro
        )

    def names(self, token: Token, use: Use) -> Iterator[Occurrence]:
        """What a word names where it comes to stand."""
        operand = use.operand
        if Name not in operand.takes or token.text.upper() == operand.word:
            return
        new = operand.refers is Refers.NEW
        kind = (makes(use.definition) or "") if new else operand.refers.value
        if operand.refers is Refers.TARGET:
            kind = PART if token.text in self.parts else POSITION
        if kind:
            scope = self.macro if kind == LABEL else ""
            yield Occurrence(
                kind=kind, name=token.text, span=token.span, makes=new, scope=scope, macro=self.macro
            )


def _operands(line: Line, where: _Where) -> Iterator[Occurrence]:
    definition, tokens = instruction(line)
    if definition is not None and definition.op == PARK:
        yield Occurrence(
            kind=POSITION, name=PARK, span=tokens[0].span, makes=False, fixed=True, macro=where.macro
        )
    usage = definition or called(line, where.macros)
    for place in places(usage, tokens[1:]) if usage is not None else ():
        operand, token = place.operand, place.token
        if token.kind is not TokenKind.NAME or (operand is not None and operand.free):
            for name, span in braced(token):
                if name in where.parameters:
                    yield where.parameter(name, Span(start=span.start + 1, end=span.end - 1))
        elif token.text in where.parameters:
            yield where.parameter(token.text, token.span)
        elif operand is not None and usage is not None:
            found = [Use(definition=usage, operand=operand)]
            if definition is None:
                found = list(uses(where.macros, usage.op, operand.name))
            yield from dict.fromkeys(name for use in found for name in where.names(token, use))


def _in_scope(occurrence: Occurrence, own: set[tuple[str, str]]) -> Occurrence:
    """A jump in a macro to a label that the macro does not have goes to one of the text."""
    inside = occurrence.kind == LABEL and occurrence.scope and not occurrence.makes
    if not inside or (occurrence.name, occurrence.scope) in own:
        return occurrence
    return replace(occurrence, scope="")
