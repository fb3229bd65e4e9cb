"""The two modes of the arm program of 1973: functions typed in are collected; `DO` carries out."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from msgspec import UNSET

from handeye.diagnostics import Diagnostic, has_errors
from handeye.doing.answers import Answer, Said
from handeye.doing.functions import TYPED, Planned, is_open, mistakes
from handeye.doing.workplace import Workplace
from handeye.errors import InvalidInput
from handeye.stepping.advance import Pause
from handeye.stepping.telling import deeds
from handeye.work.executor import Choice

MOST: Final = 500
"""Lines that are collected at most: all of them are checked again with each that is added."""

_ADVICE: Final = {
    "operator": "PROCEED, RETRY or SKIP goes on from there; a function leaves it",
    "panic": "the step that was broken off is undone",
}


@dataclass(slots=True, kw_only=True)
class Repl:
    """Somebody at the arm program: a cell, and the functions collected so far."""

    workplace: Workplace
    folder: Path
    """Where programs are looked for by name."""
    functions: list[str] = field(default_factory=list)
    """The lines collected."""
    over: bool = False

    def collect(self, line: str) -> Answer:
        """Add a line to what is collected, if nothing is wrong with it that a further line could not put right."""
        if not line.strip() and not is_open(self.functions):
            return self.answer(line)
        if len(self.functions) >= MOST:
            raise InvalidInput(f"no more than {MOST} lines are collected; write a script for more")
        lines = [*self.functions, line]
        checked = self.workplace.plan("\n".join(lines))
        found = mistakes(checked, len(lines))
        if not has_errors(found):
            self.functions = lines
        return self.answer(line, checked=checked, found=found)

    def carry_out(self, typed: str, text: str, *, name: str = TYPED, alone: bool = False) -> Answer:
        """Plan a text, and carry the plan out if there is one.

        Args:
            name: what frames of diagnostics call the text.
            alone: it is only a part of what is done, and need not make sense by itself.
        """
        checked = self.workplace.plan(text, name=name, alone=alone)
        said = Said() if checked.plan is None else self._done(self.workplace.carry_out(checked.plan))
        return self.answer(typed, said, checked=checked, found=checked.diagnostics)

    def go_on(self, choice: Choice) -> Answer:
        """Answer for the operator, who was called."""
        happened = len(self.workplace.runner.events)
        return self.answer(choice, self._done(self.workplace.answer(choice), happened))

    def _done(self, pause: Pause, happened: int = 0) -> Said:
        runner = self.workplace.runner
        told = deeds(runner.events[happened:], runner.setup.plan.program)
        did = tuple(deed for deed in told if deed.line is not None)
        return Said(did=did, pause=pause, said=_ADVICE.get(pause.kind, UNSET if did else pause.sentence))

    def answer(
        self,
        typed: str,
        said: Said | None = None,
        *,
        checked: Planned | None = None,
        found: Sequence[Diagnostic] = (),
    ) -> Answer:
        """An answer to a line, with what was found in a text."""
        time, said = self.workplace.runner.run.time, said or Said()
        if checked is None:
            return Answer(typed=typed, time=time, said=said)
        return Answer(typed=typed, time=time, said=said, source=checked.source, diagnostics=tuple(found))
