"""Occurrences of names in a text: what they name, and whether they define or use it."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final

from handeye.al.definition import Instruction, Refers
from handeye.al.scanner import Line, TokenKind, scan
from handeye.al.syntax import Name
from handeye.editor.places import instruction, places
from handeye.source import Span

POSITION, PART, PICTURE = Refers.POSITION.value, Refers.PART.value, Refers.PICTURE.value
SAVED, LABEL, MACRO = Refers.SAVED.value, Refers.LABEL.value, "macro"
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
    """The macro within which a label is known; empty: the text."""
    fixed: bool = False
    """A word of the language, which cannot be renamed."""


def occurrences(text: str, parts: Iterable[str] = (), macros: Iterable[str] = ()) -> list[Occurrence]:
    """Every name in a text, in its order.

    Args:
        parts: tells parts from positions where either may stand.
        macros: those made elsewhere.
    """
    lines = scan(text)
    known = {o.name for o in _macros(lines)} | set(macros)
    found = list(_walk(lines, known, set(parts)))
    own = {(o.name, o.scope) for o in found if o.kind == LABEL and o.makes}
    return [_in_scope(occurrence, own) for occurrence in found]


def macros_of(text: str) -> set[str]:
    """The macros that a text makes."""
    return {macro.name for macro in _macros(scan(text))}


def same(one: Occurrence, other: Occurrence) -> bool:
    """True if both name the same thing."""
    return (one.kind, one.name, one.scope) == (other.kind, other.name, other.scope)


def makes(definition: Instruction) -> str | None:
    """The kind of thing an instruction with a new name makes."""
    named = definition.operands and definition.operands[0].refers is Refers.NEW
    return _MAKES.get(definition.op) if named and Name in definition.operands[0].takes else None


def _macros(lines: Sequence[Line]) -> Iterator[Occurrence]:
    for line in lines:
        _, tokens = instruction(line)
        if len(tokens) > 1 and tokens[0].text.upper() == "DEFINE" and tokens[1].kind is TokenKind.NAME:
            yield Occurrence(kind=MACRO, name=tokens[1].text.upper(), span=tokens[1].span, makes=True)


def _walk(lines: Sequence[Line], macros: set[str], parts: set[str]) -> Iterator[Occurrence]:
    scope = ""
    for line in lines:
        heads, tokens = line.split()
        for head in heads:
            yield Occurrence(kind=LABEL, name=head.text, span=head.span, makes=True, scope=scope)
        if line.is_blank:
            scope = ""
        elif tokens and tokens[0].text.upper() == "DEFINE":
            made = list(_macros([line]))
            scope = made[0].name if made else ""
            yield from made
        elif tokens and tokens[0].text.upper() in macros:
            yield Occurrence(kind=MACRO, name=tokens[0].text.upper(), span=tokens[0].span, makes=False)
        else:
            yield from _operands(line, scope, parts)


def _operands(line: Line, scope: str, parts: set[str]) -> Iterator[Occurrence]:
    definition, tokens = instruction(line)
    if definition is None:
        return
    if definition.op == PARK:
        yield Occurrence(kind=POSITION, name=PARK, span=tokens[0].span, makes=False, fixed=True)
    for place in places(definition, tokens[1:]):
        operand, token = place.operand, place.token
        if operand is None or token.kind is not TokenKind.NAME or Name not in operand.takes:
            continue
        if token.text.upper() == operand.word:
            continue
        kind = operand.refers.value
        if operand.refers is Refers.NEW:
            kind = makes(definition) or ""
        elif operand.refers is Refers.TARGET:
            kind = PART if token.text in parts else POSITION
        if kind:
            new = operand.refers is Refers.NEW
            label_scope = scope if kind == LABEL else ""
            yield Occurrence(kind=kind, name=token.text, span=token.span, makes=new, scope=label_scope)


def _in_scope(occurrence: Occurrence, own: set[tuple[str, str]]) -> Occurrence:
    """A jump in a macro to a label that the macro does not have goes to one of the text."""
    inside = occurrence.kind == LABEL and occurrence.scope and not occurrence.makes
    if not inside or (occurrence.name, occurrence.scope) in own:
        return occurrence
    return Occurrence(kind=LABEL, name=occurrence.name, span=occurrence.span, makes=False)
