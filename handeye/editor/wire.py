"""Converts positions and diagnostics to the language server protocol, which counts lines and code units from 0."""

from collections.abc import Callable, Sequence
from typing import Final

from lsprotocol import types as lsp

from handeye.core.diagnostics import Diagnostic
from handeye.core.source import Source, Span

Units = Callable[[str], int]  # number of code units of a text in the agreed encoding
_UNUSED: Final = ("label", "macro", "parameter", "position", "vector")
_UNNECESSARY: Final = {
    "unreachable-code",
    *(f"unused-{kind}" for kind in _UNUSED),
}  # editors show such code in a paler colour


def position(source: Source, offset: int, units: Units) -> lsp.Position:
    """Return an offset as a position of the language server protocol."""
    line, column = source.position(offset)
    return lsp.Position(line=line - 1, character=units(source.text[offset - column + 1 : offset]))


def offset(source: Source, at: lsp.Position, units: Units) -> int:
    """Return the offset of a position of the language server protocol. A position beyond the end of its line is moved
    to the end of the line, and a position beyond the text to the end of the text.
    """
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
    """Return a span as a range of the language server protocol."""
    return lsp.Range(start=position(source, span.start, units), end=position(source, span.end, units))


def diagnostic(
    found: Diagnostic, at: lsp.Range, related: Sequence[tuple[lsp.Location, str]], where: str = ""
) -> lsp.Diagnostic:
    """Return a diagnostic for an editor. The message of the returned diagnostic begins with `where`; the texts of
    labels, notes and help follow as further lines.
    """
    severity = lsp.DiagnosticSeverity.Error if found.severity == "error" else lsp.DiagnosticSeverity.Warning
    said = [found.message, found.primary.text, *found.notes, *([f"help: {found.help}"] if found.help else [])]
    return lsp.Diagnostic(
        range=at,
        message=where + "\n".join(line for line in said if line),
        severity=severity,
        code=found.code,
        source="handeye",
        related_information=[
            lsp.DiagnosticRelatedInformation(location=place, message=text or found.message)
            for place, text in related
        ],
        tags=[lsp.DiagnosticTag.Unnecessary] if found.code in _UNNECESSARY and not where else None,
    )
