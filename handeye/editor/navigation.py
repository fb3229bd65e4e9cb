"""Finds the definitions and references of names, and renames them."""

import re
from dataclasses import dataclass, field
from typing import Final

from handeye.al.definition import AXES
from handeye.al.includes import key_of, own_key, required_by
from handeye.al.instructions import INSTRUCTIONS, OPERAND_WORDS
from handeye.al.scanner import TokenKind
from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, Refused
from handeye.core.source import Span
from handeye.editor.document import Document
from handeye.editor.occurrences import LABEL, MACRO, PARAMETER, PARK, PART, POSITION, Occurrence, same
from handeye.editor.places import instruction

_NAME: Final = re.compile(r"[A-Za-z_]\w*", re.ASCII)


@dataclass(frozen=True, slots=True, kw_only=True)
class Place:
    """A span in the script, in the taught file, or in the required file that `file` names."""

    span: Span
    taught: bool = False
    file: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Edit(Place):
    """A replacement of a span."""

    text: str


def definition(document: Document, offset: int) -> list[Place]:
    """Return the definitions of the name at an offset. If the name is that of a difference, each SAVE of this
    difference is a definition. The definition of a required file is the start of that file.
    """
    for file in required_by(document.text):
        key = key_of(file.text, own_key(document.source))
        if file.span.start <= offset <= file.span.end:
            there = [text for text in document.whole.required if text.key == key and not text.problem]
            return [Place(span=Span(start=0, end=0), file=text.key) for text in there]
    name = document.name_at(offset)
    return [] if name is None else [f for o, f in _all(document, name) if o.makes]


def references(document: Document, offset: int) -> list[Place]:
    """Return the occurrences of the name at an offset."""
    name = document.name_at(offset)
    return [] if name is None else [found for _, found in _all(document, name)]


def renamable(document: Document, offset: int) -> Occurrence:
    """Return the name at an offset. Raises Refused if the name cannot be changed."""
    name = document.name_at(offset)
    if name is None:
        raise Refused("there is no name here")
    places = [occurrence for occurrence, _ in _all(document, name)]
    if any(place.fixed for place in places) or (name.kind, name.name) == (POSITION, PARK):
        raise Refused(f"{quoted(name.name)} is a word of the language, which cannot be renamed")
    if not any(place.makes for place in places):
        where = "in the taught file" if name.name in document.taught_of(name.kind) else "anywhere"
        raise Refused(f"the definition of {name.kind} {quoted(name.name)} is not found {where}")
    return name


def rename(document: Document, offset: int, new: str) -> list[Edit]:
    """Return the edits that replace the name at an offset by the name `new`, in all files. Raises BadArgument if the
    new name is invalid.
    """
    name = renamable(document, offset)
    if _NAME.fullmatch(new) is None:
        raise BadArgument(
            f"{quoted(new)} is not a name: names consist of letters, digits and `_`, and do not start with a digit"
        )
    if (
        name.kind in (MACRO, LABEL, PARAMETER) and new.upper() in (*INSTRUCTIONS, "DEFINE")
    ) or new.upper() in OPERAND_WORDS:
        raise BadArgument(f"{quoted(new)} is a word of the language; choose another name")
    if name.kind == PARAMETER and new in AXES:
        raise BadArgument(f"{quoted(new)} is an axis of the table; choose another name")
    others = [*document.names, *document.taught_names, *(o for _, o in document.required_names)]
    if new != name.name and any(_meets(other, name, new) for other in others):
        raise Refused(f"there is already a {name.kind} {quoted(new)}")
    used = {other.macro for other in others if same(other, name)} - {""}
    for other in others if new != name.name else ():
        if other.name == new and other.macro in used and PARAMETER in (other.kind, name.kind):
            raise Refused(f"{quoted(new)} already has another meaning in macro {quoted(other.macro)}")
    return [Edit(span=f.span, text=new, taught=f.taught, file=f.file) for _, f in _all(document, name)]


def _meets(other: Occurrence, name: Occurrence, new: str) -> bool:
    """Return True if a name would clash with the new name. A position and a part must not get the same name,
    because AIM accepts both.
    """
    if name.kind == PARAMETER:
        return False
    if name.kind == LABEL:
        return other.kind == LABEL and other.name == new
    kinds = (POSITION, PART) if name.kind in (POSITION, PART) else (name.kind,)
    called = new.upper() if name.kind == MACRO else new
    return other.kind in kinds and other.name == called and not same(other, name)


def _all(document: Document, name: Occurrence) -> list[tuple[Occurrence, Place]]:
    """Return every occurrence of a name, with its place."""
    own = [(o, Place(span=o.span)) for o in document.names]
    taught = [(o, Place(span=o.span, taught=True)) for o in document.taught_names]
    required = [(o, Place(span=o.span, file=text.key)) for text, o in document.required_names]
    return [place for place in (*own, *taught, *required) if same(place[0], name)]


STAGE = "stage"
FIRST = "program"  # the stage before the first STAGE


@dataclass(slots=True, kw_only=True)
class Symbol:
    """A named range of the text. `kind` is `stage`, or else the kind of the name. `at` is the span of the name."""

    name: str
    kind: str
    span: Span
    at: Span
    parts: list["Symbol"] = field(default_factory=list)


def outline(document: Document) -> list[Symbol]:
    """Return the stages and macros, with the labels, positions, pictures and differences that they define."""
    found = [name for name in document.names if name.makes and name.kind != PARAMETER]
    stages, macros = _stages(document), [_macro(document, name) for name in found if name.kind == MACRO]
    for name in found:
        if name.kind == MACRO:
            continue
        symbol = Symbol(name=name.name, kind=name.kind, span=_line(document, name.span), at=name.span)
        macro = next((m for m in macros if m.span.start <= name.span.start < m.span.end), None)
        home = macro or next((s for s in reversed(stages) if s.span.start <= name.span.start), None)
        if home is None:
            home = Symbol(name=FIRST, kind=STAGE, span=symbol.span, at=name.span)
            stages.insert(0, home)
        home.parts.append(symbol)
        home.span = Span(start=home.span.start, end=max(home.span.end, symbol.span.end))
    return sorted([*stages, *macros], key=lambda symbol: symbol.span.start)


def _line(document: Document, at: Span) -> Span:
    """Return the span of the line in which a name begins, extended to the end of the name if necessary."""
    line = document.line_of(at.start)
    return Span(start=line.start, end=max(line.end, at.end))


def _macro(document: Document, name: Occurrence) -> Symbol:
    """Return the symbol of a macro. Its range is from the macro's head to the blank line that ends the macro."""
    head = _line(document, name.span)
    blank = re.compile(r"\n[ \t]*(?=\r?\n|\Z)").search(document.text, head.end)
    end = len(document.text) if blank is None else blank.start()
    return Symbol(name=name.name, kind=MACRO, span=Span(start=head.start, end=end), at=name.span)


def _stages(document: Document) -> list[Symbol]:
    found: list[Symbol] = []
    for line in document.lines:
        definition, tokens = instruction(line)
        if definition is not None and definition.op == "STAGE" and len(tokens) > 1:
            quoted = tokens[1].text.strip('"') if tokens[1].kind is TokenKind.STRING else tokens[1].text
            if found:
                found[-1].span = Span(start=found[-1].span.start, end=line.start)
            span = Span(start=line.start, end=len(document.text))
            found.append(Symbol(name=quoted or STAGE, kind=STAGE, span=span, at=tokens[1].span))
    return found
