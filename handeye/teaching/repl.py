"""The two modes of the arm program of 1973: functions typed in are collected; `DO` carries out."""

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Final

import msgspec

from handeye.al.includes import sewn
from handeye.core.diagnostics import has_errors
from handeye.core.errors import Refused
from handeye.core.source import Source, read_source
from handeye.program.events import Choice
from handeye.teaching.answers import Answer
from handeye.teaching.functions import TYPED, is_open, mistakes
from handeye.teaching.plan_and_run import about, answer, carry_out, done
from handeye.teaching.workplace import Workplace

MOST: Final = 500
"""Lines that are collected at most: all of them are checked again with each that is added."""
_ANSWERS: Final = "PROCEED, RETRY or SKIP continues from there; a new function abandons it"


@dataclass(slots=True, kw_only=True)
class Repl:
    """Somebody at the arm program: a cell, and the functions collected so far."""

    workplace: Workplace
    folder: Path
    """Where programs are looked for by name."""
    called: str = _ANSWERS
    """Words that are said when the operator was called."""
    functions: list[str] = field(default_factory=list)
    """The lines collected."""
    over: bool = False

    def collect(self, line: str) -> Answer:
        """Add a line to what is collected, if nothing is wrong with it that a further line could not put right.

        Raises:
            InvalidInput: too many are collected already.
        """
        if not line.strip() and not is_open(self.functions):
            return answer(self.workplace)
        if len(self.functions) >= MOST:
            raise Refused(f"at most {MOST} lines; write a script for more")
        lines = [*self.functions, line]
        checked = self.workplace.plan(self.typed("\n".join(lines)))
        found = mistakes(checked, len(lines))
        if not has_errors(found):
            self.functions = lines
        return about(self.workplace, checked, found)

    def typed(self, text: str) -> Source:
        """Make a source of what was typed, with the files it requires."""
        return sewn(Source(name=TYPED, text=text), lambda key: read_source(self.folder / key).text)

    def carry_out(self, source: Source, *, alone: bool = False) -> Answer:
        """Plan a text and carry it out; what there is to say to a stop is told."""
        return self._advised(carry_out(self.workplace, source, alone=alone))

    def go_on(self, choice: Choice) -> Answer:
        """Answer for the operator, who was called.

        Raises:
            InvalidInput: nobody has called.
        """
        happened = len(self.workplace.runner.events)
        said = done(self.workplace, self.workplace.answer(choice), happened)
        return self._advised(Answer(time=self.workplace.elapsed, said=said))

    def _advised(self, given: Answer) -> Answer:
        advices = {"operator": self.called, "panic": "the interrupted step is undone"}
        advice = advices.get(given.stopped or "")
        return (
            given if advice is None else replace(given, said=msgspec.structs.replace(given.said, said=advice))
        )
