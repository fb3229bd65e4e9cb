"""Languages as values. The ending of a file determines its language. The rest of handeye uses these values, and
depends on no particular language.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path, PurePath

from handeye.core.diagnostics import Diagnostic
from handeye.core.entries import entries, entry_of_file, loaded, refusal
from handeye.core.record import Record
from handeye.core.source import Source
from handeye.program.diagnosis.plan_findings import PlanFinding
from handeye.program.diagnosis.reach import NamedArm
from handeye.program.program import Program
from handeye.program.taught import Taught

Compiled = tuple[
    Program | None, list[Diagnostic]
]  # returns a program (None if there are errors) and diagnostics


class Language(Record, frozen=True, kw_only=True):
    """A language for scripts."""

    name: str  # name that is stored in programs and plans
    read: Callable[[Path], Source]  # reads a script with all it requires; raises InvalidInput
    compile: Callable[[Source, Taught], Compiled]
    phrase: Callable[[Program, NamedArm, Iterable[PlanFinding]], list[Diagnostic]]
    """Function that turns each planning finding into a diagnostic, at the place in the text that the finding concerns.
    """


class OwnLanguage(ABC):
    """A system's own language for its files. The language checks a text, and answers the questions that commands and
    editors ask about the text.
    """

    system: str

    @abstractmethod
    def check(self, source: Source) -> list[Diagnostic]:
        """Check a text without executing it. Returns its diagnostics."""

    def formatted(self, text: str) -> str:
        """Return the text in the standard format of the language. Raises Refused if the language has no standard
        format.
        """
        raise refusal(self.system, "format")

    def explanation(self, word: str) -> str | None:
        """Explain a word of this language, or the code of one of its diagnostics. Returns None if `word` is
        neither.
        """
        return None

    def words(self, source: Source, offset: int) -> Sequence[tuple[str, str]]:
        """Return the words that are allowed at an offset, each with its meaning."""
        return ()


def own_language(file: str) -> OwnLanguage | None:
    """Return the language of a file, if a system has a language of its own for files with this ending. Returns None if
    the file is a script for a planned program.
    """
    entry, ending = entry_of_file(file)
    if entry is None:
        return None
    language: OwnLanguage = loaded(entry.languages[ending])
    return language


def own_languages() -> Iterator[OwnLanguage]:
    """Yield the languages of all systems, each once."""
    for place in dict.fromkeys(place for entry in entries().values() for place in entry.languages.values()):
        yield loaded(place)


def language_of(file: PurePath, languages: Mapping[str, Language]) -> Language:
    """Return the language that the ending of a file determines. If no language has this ending, return the first
    language.
    """
    found = languages.get(file.suffix.lower())
    return next(iter(languages.values())) if found is None else found
