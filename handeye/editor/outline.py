"""The stages of a script, and what is in them."""

import re
from dataclasses import dataclass, field

from handeye.al.scanner import TokenKind
from handeye.core.source import Span
from handeye.editor.document import Document
from handeye.editor.occurrences import MACRO, PARAMETER, Occurrence
from handeye.editor.places import instruction

STAGE = "stage"
FIRST = "program"
"""The stage of what stands before the first STAGE."""


@dataclass(slots=True, kw_only=True)
class Symbol:
    """Something with a name, and the text it reaches over."""

    name: str
    kind: str
    """`stage`, or that of a name."""
    span: Span
    at: Span
    """Its name."""
    parts: list["Symbol"] = field(default_factory=list)


def outline(document: Document) -> list[Symbol]:
    """Stages and macros, with the labels, positions, pictures and differences made in them."""
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
    """The line in which something stands."""
    line = document.line_at(at.start)
    assert line is not None
    return Span(start=line.start, end=max(line.end, at.end))


def _macro(document: Document, name: Occurrence) -> Symbol:
    """A macro, from its head to the blank line that ends it."""
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
            _close(found, line.start)
            found.append(
                Symbol(
                    name=quoted or STAGE,
                    kind=STAGE,
                    span=Span(start=line.start, end=len(document.text)),
                    at=tokens[1].span,
                )
            )
    return found


def _close(stages: list[Symbol], end: int) -> None:
    if stages:
        stages[-1].span = Span(start=stages[-1].span.start, end=end)
