"""Languages as values: what reads a script, makes a program of it, and puts into its words what a planner finds.

Whoever loads scripts is given languages by the endings of their files, so that no skill knows a
language, and no language another.
"""

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
"""A program, and what there is to say about its text; there is none if any of that is an error."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Language:
    """A language that scripts are written in."""

    name: str
    """As programs and plans say it."""
    read: Callable[[Path], Source]
    """The script in a file with all that belongs to it; raises InvalidInput if it cannot be read."""
    compile: Callable[[Source, Taught], Compiled]
    phrase: Callable[[Program, NamedArm, Iterable[PlanningFinding]], list[Diagnostic]]
    """Diagnostics for what a planner found against a program for an arm, at their places in the text."""


def language_of(file: PurePath, languages: Mapping[str, Language]) -> Language:
    """The language of a script by the ending of its file; the first there is, if no language has that ending."""
    found = languages.get(file.suffix.lower())
    return next(iter(languages.values())) if found is None else found
