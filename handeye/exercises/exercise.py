"""Defines an exercise: a job for a student's program, and the cases in which the program is judged. Each case is a
world, or stands for every order in which the program's tasks can run.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final, Literal, Self

from handeye.core.errors import BadArgument
from handeye.core.record import Record
from handeye.core.resources import plans
from handeye.core.source import read_source

if TYPE_CHECKING:
    from handeye.core.diagnostics import Diagnostic
    from handeye.core.source import Source

FOLDER: Final = "exercises"  # of the starting programs, in the folder of plans
Standing = Literal["right", "wrong", "silent"]


class Verdict(Record, frozen=True, kw_only=True):
    """The verdict on a program in one case: in one world, or in every order in which the program's tasks can run."""

    case: str  # such as `seed 3`
    standing: Standing
    """`silent`: the program reported success, and its work is wrong."""
    outcome: str  # what the program did, in words
    reason: str = ""  # why the work is wrong; empty if it is right
    error: int | None = None  # number of the error with which the program called the operator
    again: str = ""  # the command that repeats the case


class Grade(Record, frozen=True, kw_only=True):
    """The grade of a program."""

    exercise: str
    verdicts: tuple[Verdict, ...]
    hints: tuple[str, ...] = ()

    @property
    def right(self) -> int:
        """Number of cases in which the program is right."""
        return sum(each.standing == "right" for each in self.verdicts)

    @property
    def failures(self) -> tuple[Verdict, ...]:
        """The cases in which the program is not right, silent failures first."""
        silent = [each for each in self.verdicts if each.standing == "silent"]
        return (*silent, *(each for each in self.verdicts if each.standing == "wrong"))

    @property
    def silent(self) -> int:
        """Number of silent failures."""
        return sum(each.standing == "silent" for each in self.verdicts)

    @property
    def by_outcome(self) -> dict[str, list[Verdict]]:
        """The failures by outcome, silent failures first."""
        found: dict[str, list[Verdict]] = {}
        for each in self.failures:
            found.setdefault(each.outcome, []).append(each)
        return found

    @property
    def exit_code(self) -> int:
        """0 if the program is right in every case; 1 if it fails in some case, but never silently; 3 if it fails
        silently in some case.
        """
        if not self.failures:
            return 0
        return 3 if self.failures[0].standing == "silent" else 1


@dataclass(frozen=True, slots=True, kw_only=True)
class Submission:
    """A student's program, and how to judge it."""

    source: Source
    taught: Source | None  # the taught file next to the program
    seeds: Sequence[int]  # worlds to try, out of those of the exercise; empty: all
    jobs: int  # processes that work at the same time
    told: Callable[[Verdict], None]  # is called for each verdict, in any order


@dataclass(frozen=True, slots=True, kw_only=True)
class Exercise(ABC):
    """An exercise."""

    name: str
    session: int  # of the course, docs/course.md
    title: str
    brief: str  # what to do, in a paragraph
    start: str  # file of the program from which the student starts
    hints: tuple[tuple[str, str], ...]
    """Hints. Each is a pair of texts. If the outcome of the first failed case begins with the first text, the second
    text is shown.
    """

    @property
    def program(self) -> Source:
        """The program from which the student starts."""
        return read_source(plans() / FOLDER / self.start)

    @property
    def positions(self) -> Source | None:
        """The taught file that belongs to the program, if there is one."""
        return None

    @property
    @abstractmethod
    def cases(self) -> str:
        """A text that describes the cases in which a program is judged."""

    @property
    @abstractmethod
    def rules(self) -> tuple[str, ...]:
        """What a program must and must not do, each as a sentence."""

    @property
    @abstractmethod
    def seeds(self) -> tuple[int, ...]:
        """Seeds of the worlds in which a program is judged; empty if there are no worlds."""

    def beginning_at(self, first: int) -> Self:
        """Return this exercise with other worlds, whose smallest seed is `first`. An exercise without worlds stays as
        it is.
        """
        return self

    @abstractmethod
    def diagnostics(self, given: Submission) -> list[Diagnostic]:
        """Check a program. Returns the diagnostics in the words of the program's language."""

    @abstractmethod
    def broken_rules(self, given: Submission) -> list[str]:
        """Return the rules that a program breaks, each as a sentence. The program must be free of errors."""

    @abstractmethod
    def verdicts(self, given: Submission) -> list[Verdict]:
        """Judge a program that has no errors and breaks no rule."""

    def grade(self, given: Submission) -> Grade:
        """Judge a program that has no errors. A program that breaks a rule is not run."""
        broken = self.broken_rules(given)
        if broken:
            found = [
                Verdict(case="the rules", standing="wrong", outcome="broke a rule", reason=each)
                for each in broken
            ]
            return Grade(exercise=self.name, verdicts=tuple(found))
        judged = Grade(exercise=self.name, verdicts=tuple(self.verdicts(given)))
        return Grade(exercise=self.name, verdicts=judged.verdicts, hints=tuple(self._hints(judged)))

    def _hints(self, judged: Grade) -> list[str]:
        """Return hints on the first failed case."""
        if not judged.failures:
            return []
        first = judged.failures[0]
        found = [hint for begins, hint in self.hints if first.outcome.startswith(begins)]
        if first.error is not None:
            found.append(f"`handeye explain {first.error}` explains the error of this case.")
        return found

    def read(self, file: Path) -> Source:
        """Read a student's program. Raises InvalidInput if the program cannot be read, or is not in the right
        language.
        """
        ending = Path(self.start).suffix
        if file.suffix.lower() != ending:
            raise BadArgument(f"{file}: the exercise {self.name} needs a program whose name ends in {ending}")
        return self._read(file)

    def _read(self, file: Path) -> Source:
        return read_source(file)
