"""Finds occurrences of names in a text, both definitions and uses."""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

from handeye.al.definition import Instruction, Refers
from handeye.al.heads import heads
from handeye.al.parameters import braced
from handeye.al.scanner import Line, Token, TokenKind, scan
from handeye.al.syntax import Name
from handeye.core.source import Span
from handeye.editor.macro_bodies import Macros, Use, called, ends, uses
from handeye.editor.places import instruction, places

POSITION, PART, PICTURE = Refers.POSITION.value, Refers.PART.value, Refers.PICTURE.value
SAVED, LABEL, MACRO, PARAMETER = Refers.SAVED.value, Refers.LABEL.value, "macro", "parameter"
PARK: Final = "PARK"  # both an instruction and a position
_MAKES: Final = {
    "TRANS": POSITION, "HERE": POSITION, "SAVE": SAVED, "LOOK": PICTURE, "ASSIGN": "counter", "VECT": "vector"
}  # fmt: skip
"""For each instruction that defines a name, the kind of that name."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Occurrence:
    """An occurrence of a name. Names that are spelled alike but are of different kinds count as different names."""

    kind: str
    name: str
    span: Span
    makes: bool  # defined here
    scope: str = ""  # macro to which a label or parameter belongs; empty if there is none
    macro: str = ""  # enclosing macro, if any
    fixed: bool = False  # a word of the language, not to be renamed


def occurrences(text: str, parts: Iterable[str], macros: Macros) -> list[Occurrence]:
    """Return the occurrences of all names in a text, in order. `parts` are the names that denote parts, not
    positions."""
    found = list(_walk(scan(text), macros, set(parts)))
    own = {(o.name, o.scope) for o in found if o.kind == LABEL and o.makes}
    return [
        replace(o, scope="")  # a label that the macro lacks is one of the text outside macros
        if o.kind == LABEL and o.scope and not o.makes and (o.name, o.scope) not in own
        else o
        for o in found
    ]


def same(one: Occurrence, other: Occurrence) -> bool:
    """Return True if both occurrences refer to the same object."""
    return (one.kind, one.name, one.scope) == (other.kind, other.name, other.scope)


def makes(definition: Instruction) -> str | None:
    """Return the kind of name that an instruction defines, or None if it defines none."""
    named = definition.operands and definition.operands[0].refers is Refers.NEW
    return _MAKES.get(definition.op) if named and Name in definition.operands[0].takes else None


def _walk(lines: Sequence[Line], macros: Macros, parts: set[str]) -> Iterator[Occurrence]:
    scope, parameters = "", set[str]()
    for line in lines:
        labels, tokens = line.split()
        for label in labels:
            yield _of(label, LABEL, scope, makes=True)
        if ends(line):
            scope, parameters = "", set()
            for head in heads([line]):
                scope, parameters = head.word, {token.text for token in head.parameters}
                yield Occurrence(kind=MACRO, name=head.word, span=head.name.span, makes=True)
                names = (token for token in reversed(head.parameters) if token.kind is TokenKind.NAME)
                for token in reversed({token.text: token for token in names}.values()):
                    yield _of(token, PARAMETER, scope, makes=True)
        else:
            if tokens and tokens[0].text.upper() in macros:
                word = tokens[0].text.upper()
                yield Occurrence(kind=MACRO, name=word, span=tokens[0].span, makes=False, macro=scope)
            yield from _operands(line, _Context(macros, scope, parameters, parts))


def _of(token: Token, kind: str, macro: str, *, makes: bool) -> Occurrence:
    """Return an occurrence of a label or parameter."""
    return Occurrence(kind=kind, name=token.text, span=token.span, makes=makes, scope=macro, macro=macro)


@dataclass(frozen=True, slots=True)
class _Context:
    """The macro that contains a line, and the names to which the line can refer."""

    macros: Macros
    macro: str
    parameters: set[str]
    parts: set[str]

    def parameter(self, name: str, span: Span) -> Occurrence:
        return Occurrence(
            kind=PARAMETER, name=name, span=span, makes=False, scope=self.macro, macro=self.macro
        )

    def names(self, token: Token, use: Use) -> Iterator[Occurrence]:
        """Yield the name in an operand, or nothing if this operand does not accept a name."""
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


def _operands(line: Line, where: _Context) -> Iterator[Occurrence]:
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


_KINDS: Final = {"positions": POSITION, "parts": PART}
_NAME = r"\"?([A-Za-z_]\w*)\"?"
_HEADER: Final = re.compile(rf"\s*\[\s*(positions|parts)\s*(?:\.\s*{_NAME}\s*)?\]", re.ASCII)
_OTHER: Final = re.compile(r"\s*\[[^\]]*\]\s*(?:#.*)?$")
_KEY: Final = re.compile(rf"\s*{_NAME}\s*=\s*\{{", re.ASCII)
_DOTTED: Final = re.compile(rf"\s*(positions|parts)\s*\.\s*{_NAME}", re.ASCII)
_OF: Final = re.compile(r"(?<![\w.\"'])of\s*=\s*[\"']([A-Za-z_]\w*)[\"']", re.ASCII)
_HELD: Final = re.compile(r"(?<![\w.])positions\s*=\s*\[[^\]]*\]", re.ASCII)
_QUOTED: Final = re.compile(r"[\"']([A-Za-z_]\w*)[\"']", re.ASCII)


def taught_occurrences(text: str) -> list[Occurrence]:
    """Return the occurrences of all names in the text of a taught file."""
    return list(_taught_lines(text))


def _taught_lines(text: str) -> Iterator[Occurrence]:
    table, start = "", 0
    for line in text.split("\n"):
        code = line.split("#", 1)[0]
        if header := _HEADER.match(code):
            table = header[1] if header[2] is None else ""
            if header[2] is not None:
                yield _definition(header[1], header, 2, start)
        elif _OTHER.match(code):
            table = ""
        elif table and (key := _KEY.match(code)):
            yield _definition(table, key, 1, start)
        elif dotted := _DOTTED.match(code):
            yield _definition(dotted[1], dotted, 2, start)
        for of in _OF.finditer(code):
            yield Occurrence(kind=PART, name=of[1], span=_match_span(of, 1, start), makes=False)
        for held in _HELD.finditer(code):
            for at in _QUOTED.finditer(code, held.start(), held.end()):
                yield Occurrence(kind=POSITION, name=at[1], span=_match_span(at, 1, start), makes=False)
        start += len(line) + 1


def _definition(table: str, match: re.Match[str], group: int, start: int) -> Occurrence:
    return Occurrence(
        kind=_KINDS[table], name=match[group], span=_match_span(match, group, start), makes=True
    )


def _match_span(match: re.Match[str], group: int, start: int) -> Span:
    return Span(start=start + match.start(group), end=start + match.end(group))
