"""Languages as values, chosen by file ending, so that no skill knows a language."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path, PurePath

from handeye.core.diagnostics import Diagnostic
from handeye.core.source import Source
from handeye.program.findings import PlanningFinding
from handeye.program.program import Program
from handeye.program.reason_text import NamedArm
from handeye.program.taught import Taught

Compiled = tuple[Program | None, list[Diagnostic]]
"""A program, None if there are errors, and diagnostics."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Language:
    """A scripting language."""

    name: str  # as stored in programs and plans
    read: Callable[[Path], Source]
    """Reads a script with all it requires; raises InvalidInput."""
    compile: Callable[[Source, Taught], Compiled]
    phrase: Callable[[Program, NamedArm, Iterable[PlanningFinding]], list[Diagnostic]]
    """Diagnostics for planning findings, at their places in the text."""


def language_of(file: PurePath, languages: Mapping[str, Language]) -> Language:
    """The language of a file's ending; the first one if none has that ending."""
    found = languages.get(file.suffix.lower())
    return next(iter(languages.values())) if found is None else found
