"""Shows a run at the terminal while the run goes on. This module limits the pace of the run, prints each step when it
begins, and reads the lines that the user types.
"""

import re
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Final

import msgspec

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument
from handeye.core.plain_text import one_line
from handeye.debugger.formatting import told_row
from handeye.debugger.reply import StepSummary, UnderWay, step_summaries
from handeye.execution.servo import ServoPeriod
from handeye.program.events import AnyEvent, StepStarted
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner

FREE: Final = "free"  # as fast as possible
SLOWEST: Final = 0.25
FASTEST: Final = 100.0
_LATE_S: Final = 0.1  # a run that is later than this (after a picture, for example) does not catch up


@dataclass(slots=True, eq=False)
class Pace(Observer):
    """Limits the pace of a run: waits whenever the run would be faster than `factor` times real time. Waiting does not
    change what the run does.
    """

    factor: float | None = None  # simulated seconds per second; None for as fast as possible
    clock: Callable[[], float] = time.monotonic
    sleep: Callable[[float], None] = time.sleep
    _kept: tuple[float, float, float] | None = field(default=None, init=False)
    """The factor that limits the pace, and the moment (s) from which this factor applies. The moment is given twice:
    in wall-clock time, then in cell time.
    """

    def __str__(self) -> str:
        if self.factor is None:
            return "as fast as possible"
        return "real time" if self.factor == 1 else f"{self.factor:g} times real time"

    def tick(self, period: ServoPeriod) -> None:
        if self.factor is None:
            self._kept = None
        else:
            self._keep(self.factor, period.sensed.time)

    def _keep(self, factor: float, time: float) -> None:
        """Wait until the host's clock has caught up with the cell's time."""
        now = self.clock()
        if self._kept is None or self._kept[0] != factor or time < self._kept[2]:
            self._kept = factor, now, time
        _, since, begun = self._kept
        early = since + (time - begun) / factor - now
        if early > 0:
            self.sleep(early)
        elif early < -_LATE_S:
            self._kept = factor, now, time


def factor(text: str) -> float | None:
    """Parse a pace, such as `1x`, `4x`, `.5x` or `free`. Returns None for `free`. Raises InvalidInput if the text is
    not a pace.
    """
    if text.casefold() == FREE:
        return None
    number = re.fullmatch(r"([0-9]{1,3}(?:\.[0-9]{1,6})?|\.[0-9]{1,6})x?", text.casefold())
    if number is None or not SLOWEST <= float(number[1]) <= FASTEST:
        raise BadArgument(
            f"`pace` takes `1x`, `4x`, another number from {SLOWEST:g}x to {FASTEST:g}x, or `{FREE}`, "
            f"not {quoted(text)}"
        )
    return float(number[1])


_OUTCOME_INDENT: Final = 8  # columns, if the outcome has a line of its own


@dataclass(frozen=True, slots=True, kw_only=True)
class Live:
    """The terminal as a run uses it: reads typed lines, and writes text."""

    typed: Callable[[], str | None]  # returns a line that has been typed, or None if there is none
    put: Callable[[str], None]  # prints a piece of a line
    width: int


@dataclass(slots=True, eq=False)
class LineInput(Observer):
    """Reads the lines that the user types during a run. The reader checks for new lines in every servo period and at
    every step.
    """

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
    """Prints each step when it begins, as a JSON object on one line."""

    runner: Runner
    write: Callable[[str], None]

    def event(self, event: AnyEvent) -> None:
        if isinstance(event, StepStarted):
            self.write(msgspec.json.encode({"under_way": under_way(self.runner, event)}).decode())


@dataclass(slots=True, eq=False)
class LiveText(Observer):
    """Prints each step when it begins. The step's outcome is printed when the next step begins, on the same
    line if there is space."""

    runner: Runner
    write: Callable[[str], None]  # prints a line, given without its newline
    put: Callable[[str], None]  # prints a piece of a line
    width: int
    told: int = 0  # events printed so far
    _open: str = ""  # text of a line that has not ended

    def begin(self) -> None:
        """Start to print: only events that happen from now on are shown."""
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
        """End an unfinished line. If `ended` is True, the user's Enter key has already ended the line."""
        if self._open and not ended:
            self.put("\n")
        self._open = ""

    def end(self) -> None:
        """Print the remaining events. The line of a step that was rolled back is left unchanged."""
        self._tell(self.runner.events[self.told :])
        self.leave_line()
        self.begin()

    def _tell(self, events: list[AnyEvent]) -> None:
        """Print the outcomes of complete steps."""
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
    stage = runner.listing.steps[event.step].stage
    return UnderWay(
        position=runner.position,
        time=runner.time,
        stage=runner.listing.stages[stage],
        stage_number=stage + 1,
        step=event.step,
        line=event.line,
        text=event.text,
        script=event.file,
    )
