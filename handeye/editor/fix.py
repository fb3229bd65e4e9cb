"""Defines fixes for diagnostics, and helpers for making them."""

from dataclasses import dataclass

from handeye.al.definition import Operand
from handeye.al.scanner import Line, Token
from handeye.al.syntax import Vector
from handeye.core.diagnostics import Diagnostic
from handeye.core.source import Span
from handeye.editor.document import Document
from handeye.editor.navigation import Edit
from handeye.editor.places import instruction, places


@dataclass(frozen=True, slots=True, kw_only=True)
class Fix:
    """A fix for a diagnostic. `choice` is True if the fix is one of several equally plausible ones."""

    title: str
    edits: tuple[Edit, ...]
    choice: bool = False


def cured(text: str, fix: Fix) -> str:
    """Return the text of a script after a fix."""
    for edit in sorted(fix.edits, key=lambda edit: edit.span, reverse=True):
        text = text[: edit.span.start] + edit.text + text[edit.span.end :]
    return text


def replace(span: Span, text: str, title: str, *, choice: bool = False) -> Fix:
    """Return a fix that replaces one span."""
    return Fix(title=title, edits=(Edit(span=span, text=text),), choice=choice)


def insert(at: int, text: str, title: str) -> Fix:
    """Return a fix that inserts a text."""
    return replace(Span(start=at, end=at), text, title)


def at(offset: int) -> Span:
    """Return the empty span at an offset."""
    return Span(start=offset, end=offset)


def line_of(document: Document, diagnostic: Diagnostic) -> Line:
    """Return the line at which a diagnostic begins."""
    return document.line_of(diagnostic.primary.span.start)


def word_of(line: Line) -> str:
    """Return the instruction word of a line."""
    return line.split()[1][0].text.upper()


def operand_of(line: Line, diagnostic: Diagnostic) -> tuple[Operand | None, Token | None]:
    """Return the operand to which a diagnostic refers, and the operand's token. The token is None if the
    operand is a vector."""
    definition, tokens = instruction(line)
    if definition is not None:
        for place in places(definition, tokens[1:]):
            if place.token.start == diagnostic.primary.span.start:
                single = place.operand is None or Vector not in place.operand.takes or place.token.text != "["
                return place.operand, place.token if single else None
    return None, None


def with_blanks_before(document: Document, span: Span) -> Span:
    """Extend a span so that it includes the blanks before it."""
    start = span.start
    while start and document.text[start - 1] in " \t":
        start -= 1
    return Span(start=start, end=span.end)
