"""Kinds of mistakes in the languages of systems. Each kind has a code, an example text and a cure."""

from collections.abc import Callable, Mapping, Sequence
from typing import Final

from handeye.core.codes import Severity
from handeye.core.diagnostics import (
    Diagnostic,
    KnownNames,
    Label,
    SimilarName,
    names_sentence,
    problem,
    render,
)
from handeye.core.record import Record
from handeye.core.source import Source, Span

LONGEST_EXAMPLE: Final = 10  # lines that are shown


class Mistake(Record, frozen=True, kw_only=True):
    """A kind of mistake."""

    meaning: str
    example: str
    cure: str
    severity: Severity = "error"


class Mistakes:
    """The kinds of mistakes of a language. To make a diagnostic, call an object of this class."""

    def __init__(self, *tables: Mapping[str, Mistake]) -> None:
        self._known = {code: known for table in tables for code, known in table.items()}

    def __call__(
        self,
        code: str,
        message: str,
        span: Span,
        *secondary: Label,
        help: str | None = None,
        meant: SimilarName | KnownNames | None = None,
        notes: tuple[str, ...] = (),
    ) -> Diagnostic:
        """Make a diagnostic. The diagnostic has the cure that belongs to its code, unless a more specific cure is
        given.
        """
        known = self._known[code]
        cure = help or names_sentence(meant) or known.cure
        return problem(
            code, message, span, *secondary, help=cure, meant=meant, own=known.severity, notes=notes
        )


def explained_mistake(
    code: str, known: Mistake, ending: str, check: Callable[[Source], Sequence[Diagnostic]]
) -> str:
    """Explain a code: return its meaning, the diagnostic that its example causes, and the cure."""
    source = Source(name=f"example{ending}", text=known.example)
    shown = next(each for each in check(source) if each.code == code)
    example = known.example.strip().split("\n")
    if len(example) > LONGEST_EXAMPLE:
        example = [*example[:2], "...", example[-1]]
    lines = (*example, "", *render(shown, source).split("\n"))
    text = "\n".join(f"    {line}"[:100].rstrip() for line in lines)
    return f"{known.severity}[{code}]: {known.meaning}\ncure: {known.cure}\n\nfor example\n\n{text}"
