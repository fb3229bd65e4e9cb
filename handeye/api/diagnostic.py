"""Diagnostics for Python programs, with their place in the script and a readable display."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Self

from handeye.core import diagnostics
from handeye.core.codes import Severity
from handeye.core.errors import InvalidInput
from handeye.core.source import Source


@dataclass(frozen=True, slots=True, kw_only=True)
class Diagnostic:
    """One error or warning in a script. `print` shows the diagnostic with its line of the script.

    >>> try:
    ...     handeye.plan("OPNE 1\\n")
    ... except handeye.ScriptError as error:
    ...     found = error.diagnostics[0]
    >>> found.code, found.line, found.help
    ('unknown-instruction', 1, 'did you mean `OPEN`?')
    """

    code: str  # code of the diagnostic, which `handeye explain` explains
    severity: Severity  # `error` or `warning`
    message: str
    file: str  # name of the script, or of the required file, that has the mistake
    line: int  # line of the mistake, counted from 1
    column: int  # column of the first character, counted from 1
    end: int  # column after the last character
    help: str | None  # a suggestion for correcting the mistake
    shown: str = field(repr=False)  # the diagnostic as text, with the line of the script

    def __str__(self) -> str:
        return self.shown

    @classmethod
    def of(cls, found: diagnostics.Diagnostic, source: Source) -> Self:
        """Make a `Diagnostic` from a diagnostic of the compiler, with its place in the source."""
        span = found.primary.span
        text, offset = source.find(span.start)
        line, column = text.position(offset)
        return cls(
            code=found.code,
            severity=found.severity,
            message=found.message,
            file=text.name,
            line=line,
            column=column,
            end=column + span.end - span.start,
            help=found.help,
            shown=diagnostics.render(found, source),
        )


class ScriptError(InvalidInput):
    """Raised when a script has errors and cannot be planned. `str` shows all the errors with their lines.

    >>> try:
    ...     handeye.plan("OPEN 1\\nMOVE NOWHERE\\n")
    ... except handeye.ScriptError as error:
    ...     print(len(error.diagnostics), error.diagnostics[0].message)
    1 position `NOWHERE` is not in the taught file, and no `TRANS` defines it
    """

    diagnostics: tuple[Diagnostic, ...]
    """Errors and warnings, in the order of the script."""

    def __init__(self, found: Iterable[Diagnostic]) -> None:
        self.diagnostics = tuple(found)
        super().__init__("\n\n".join(map(str, self.diagnostics)))

    def _render_traceback_(self) -> list[str]:
        """Return the traceback for notebooks. It shows each error with its place in the script, and no stack frames of
        handeye.
        """
        return str(self).splitlines()
