"""A run while it goes: its steps are printed as they begin, and lines typed meanwhile are answered at once."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import msgspec

from handeye.core.plain_text import one_line
from handeye.debugger.formatting import told_row
from handeye.debugger.reply import UnderWay
from handeye.debugger.step_summary import StepSummary, step_summaries
from handeye.execution.servo import ServoPeriod
from handeye.program.events import AnyEvent, StepStarted
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner

_OUTCOME_INDENT: Final = 8  # columns, where it has a line of its own


@dataclass(frozen=True, slots=True, kw_only=True)
class Live:
    """The terminal of a run while it goes."""

    typed: Callable[[], str | None]
    """A line that was typed already; None: there is none."""
    put: Callable[[str], None]
    """Puts out a piece of a line."""
    width: int
    """Columns of a line."""


@dataclass(slots=True, eq=False)
class LineInput(Observer):
    """Takes lines typed while a run goes, at every servo period and step."""

    typed: Callable[[], str | None]
    answer: Callable[[str], None]

    def tick(self, period: ServoPeriod) -> None:
        self._hear()

    def event(self, event: AnyEvent) -> None:
        if isinstance(event, StepStarted):
            self._hear()

    def _hear(self) -> None:
        while (line := self.typed()) is not None:
            if line.strip():
                self.answer(line)


@dataclass(slots=True, eq=False)
class LiveJson(Observer):
    """Prints each step as it begins, as a JSON object on one line."""

    runner: Runner
    write: Callable[[str], None]

    def event(self, event: AnyEvent) -> None:
        if isinstance(event, StepStarted):
            self.write(msgspec.json.encode({"under_way": under_way(self.runner, event)}).decode())


@dataclass(slots=True, eq=False)
class LiveText(Observer):
    """Prints each step as it begins, and its outcome when the next begins, on the same line where there is room."""

    runner: Runner
    write: Callable[[str], None]
    """Puts out a line, without its end."""
    put: Callable[[str], None]
    """Puts out a piece of a line."""
    width: int
    told: int = 0
    """Events printed so far."""
    _open: str = ""
    """Text of a line that has not ended."""

    def begin(self) -> None:
        """Print what happens from now on."""
        self.told = len(self.runner.events)

    def event(self, event: AnyEvent) -> None:
        if isinstance(event, StepStarted):
            happened = len(self.runner.events) - 1
            self._tell(self.runner.events[self.told : happened])
            self.told = happened
            begun = StepSummary(line=event.line, file=event.file, text=one_line(event.text), outcome="")
            self._open = told_row(begun)
            self.put(self._open)

    def leave_line(self, *, ended: bool = False) -> None:
        """End a line that is open; `ended`: the user's typing has ended it."""
        if self._open and not ended:
            self.put("\n")
        self._open = ""

    def end(self) -> None:
        """Print what is left; a step that was rolled back leaves its line as it is."""
        self._tell(self.runner.events[self.told :])
        self.leave_line()
        self.begin()

    def _tell(self, events: list[AnyEvent]) -> None:
        """Print whole steps."""
        for summary in step_summaries(events, self.runner.listing, self.runner.task.measures):
            row = told_row(summary)
            outcome = row.removeprefix(self._open)
            if self._open and len(row) <= self.width:
                self.put(outcome)
                outcome = ""
            elif self._open:
                outcome = f"{'':{_OUTCOME_INDENT}}{outcome.strip()}"
            self.leave_line()
            if outcome:
                self.write(outcome)


def under_way(runner: Runner, event: StepStarted) -> UnderWay:
    """The step that an event begins."""
    stage = runner.listing.steps[event.step].stage
    return UnderWay(
        position=runner.position,
        time=runner.elapsed,
        stage=runner.stages[stage],
        stage_number=stage + 1,
        step=event.step,
        line=event.line,
        text=event.text,
        script=event.file,
    )
