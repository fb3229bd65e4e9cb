"""Offsets of our texts and positions of the language server protocol, which count code units from 0."""

from collections.abc import Callable

from lsprotocol import types as lsp

from handeye.diagnostics import Diagnostic, Label
from handeye.source import Source, Span

Units = Callable[[str], int]
"""How many code units of the agreed encoding a text has."""


def position(source: Source, offset: int, units: Units) -> lsp.Position:
    """The position of an offset."""
    line, column = source.position(offset)
    return lsp.Position(line=line - 1, character=units(source.text[offset - column + 1 : offset]))


def offset(source: Source, at: lsp.Position, units: Units) -> int:
    """The offset of a position; one beyond the end of its line is that end, one beyond the text the end of that."""
    lines = source.text.split("\n")
    if at.line >= len(lines):
        return len(source.text)
    before, text = sum(len(line) + 1 for line in lines[: at.line]), lines[at.line]
    seen = 0
    for column, character in enumerate(text):
        if seen >= at.character:
            return before + column
        seen += units(character)
    return before + len(text)


def range_(source: Source, span: Span, units: Units) -> lsp.Range:
    """The range of a span."""
    return lsp.Range(start=position(source, span.start, units), end=position(source, span.end, units))


def diagnostic(source: Source, uri: str, found: Diagnostic, units: Units) -> lsp.Diagnostic:
    """A diagnostic as editors show it: what is said beside the mark, notes and help are lines of the message."""
    severity = lsp.DiagnosticSeverity.Error if found.severity == "error" else lsp.DiagnosticSeverity.Warning
    said = [found.message, found.primary.text, *found.notes, *([f"help: {found.help}"] if found.help else [])]
    unused = found.code.startswith("unused-") or found.code == "unreachable-code"

    def related(label: Label) -> lsp.DiagnosticRelatedInformation:
        place = lsp.Location(uri=uri, range=range_(source, label.span, units))
        return lsp.DiagnosticRelatedInformation(location=place, message=label.text or found.message)

    return lsp.Diagnostic(
        range=range_(source, found.primary.span, units),
        message="\n".join(line for line in said if line),
        severity=severity,
        code=found.code,
        source="handeye",
        related_information=[related(label) for label in found.secondary],
        tags=[lsp.DiagnosticTag.Unnecessary] if unused else None,
    )
