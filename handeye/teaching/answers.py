"""Plans and executes typed texts, and answers typed lines with text and JSON."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Final, Protocol

import msgspec
from msgspec import UNSET, UnsetType

from handeye.core.diagnostics import Diagnostic, as_json, has_errors, render
from handeye.core.record import Record
from handeye.core.source import Source
from handeye.debugger.formatting import shown_lines, summary_lines
from handeye.debugger.reply import StepSummary, step_summaries
from handeye.debugger.view_records import RunViews
from handeye.planning.planner import PlannedScript
from handeye.results.pauses import pause_sentence
from handeye.runs.advance import Pause
from handeye.teaching.workplace import Workplace


class LineResult(Record, frozen=True, kw_only=True):
    """The result of a line. Fields without content are left out."""

    said: str | UnsetType = UNSET  # one or more sentences
    did: tuple[StepSummary, ...] | UnsetType = UNSET  # steps that were done, in words
    pause: Pause | UnsetType = UNSET  # why the arm pauses, if it has moved
    show: RunViews | UnsetType = UNSET
    lines: tuple[str, ...] | UnsetType = UNSET  # lines that are collected, or listed
    file: str | UnsetType = UNSET  # file that was written
    error: str | UnsetType = UNSET  # why the line was refused


NOTHING: Final = LineResult()
NO_TEXT: Final = Source(name="", text="")


@dataclass(frozen=True, slots=True, kw_only=True)
class Answer:
    """The answer to a line."""

    time: float  # simulated seconds since the camera was set up
    typed: str = ""
    said: LineResult = NOTHING
    source: Source = NO_TEXT
    diagnostics: Sequence[Diagnostic] = ()  # findings in the source

    @property
    def refused(self) -> bool:
        """True if the line was refused."""
        return self.said.error is not UNSET or has_errors(self.diagnostics)

    @property
    def stopped(self) -> str | None:
        """The kind of pause if the arm stopped early; None if the line was completed, or if the arm did not
        move."""
        pause = self.said.pause
        return None if pause is UNSET or pause.kind == "end" else pause.kind


def json_line(answer: Answer) -> str:
    """Return the answer as a JSON object on one line."""
    found = [as_json(diagnostic, answer.source) for diagnostic in answer.diagnostics]
    told = msgspec.to_builtins(answer.said)
    if answer.said.pause is not UNSET:
        told["pause"] |= {"sentence": pause_sentence(answer.said.pause)}
    fields = {"typed": answer.typed, "time": answer.time, **({"diagnostics": found} if found else {}), **told}
    return msgspec.json.encode(fields).decode()


def text(answer: Answer) -> str:
    """Return the answer as text, without a final newline. The text is empty if there is nothing to report."""
    said = answer.said
    lines = [render(diagnostic, answer.source) for diagnostic in answer.diagnostics]
    lines += [] if said.did is UNSET else summary_lines(said.did)
    lines += [] if said.show is UNSET else shown_lines(said.show)
    lines += [] if said.lines is UNSET else said.lines
    if said.pause is not UNSET and answer.stopped in ("panic", "trouble"):
        lines.append(pause_sentence(said.pause))
    lines += [sentence for sentence in (said.said, said.error) if isinstance(sentence, str)]
    return "\n".join(lines)


def carry_out(workplace: Workplace, source: Source, *, alone: bool = False) -> Answer:
    """Plan a text and, if there are no errors, execute it. If `alone` is True, the text is executed alone, as a part
    of the work, and need not be complete.

    Raises InvalidInput if the text takes pictures and the camera was not set up.
    """
    checked = workplace.plan(source, alone=alone)
    said = NOTHING if checked.plan is None else done(workplace, workplace.carry_out(checked.plan))
    return about(workplace, checked, checked.diagnostics, said)


def done(workplace: Workplace, pause: Pause, happened: int = 0) -> LineResult:
    """Report the steps that the arm did after event number `happened` of the present plan."""
    runner = workplace.runner
    told = step_summaries(runner.events[happened:], runner.listing, runner.task.measures)
    did = tuple(step for step in told if step.line is not None)
    return LineResult(did=did, pause=pause, said=UNSET if did else pause_sentence(pause))


def about(
    workplace: Workplace, checked: PlannedScript, found: Sequence[Diagnostic], said: LineResult = NOTHING
) -> Answer:
    """Return an answer with the diagnostics of a text."""
    return Answer(time=workplace.time, said=said, source=checked.source, diagnostics=tuple(found))


def answer(workplace: Workplace, **fields: Any) -> Answer:
    """Return an answer whose result is a `LineResult` with the given `fields`."""
    return Answer(time=workplace.time, said=LineResult(**fields))


class Listener(Protocol):
    """Executes typed lines."""

    @property
    def over(self) -> bool:
        """True if no more lines are accepted."""

    def hear(self, line: str) -> Answer:
        """Execute a line. An invalid line changes nothing."""


def converse(
    listener: Listener,
    lines: Iterator[str],
    write: Callable[[str], None],
    *,
    json: bool = False,
    strict: bool = False,
) -> Answer | None:
    """Execute lines until the last one, or until the listener accepts no more. If `strict` is True, stop at the first
    line that fails.

    If a line was refused, or its execution stopped, returns the answer to this line. If all lines succeeded, returns
    None. `write` is called with each answer: lines of text or, if `json` is True, one JSON object on one line. The
    answer has no final newline.
    """
    failed = None
    while not listener.over:
        line = next(lines, None)
        if line is None:
            break
        answer = listener.hear(line)
        said = json_line(answer) if json else text(answer)
        if said:
            write(said)
        if failed is None and (answer.refused or answer.stopped is not None):
            failed = answer
        if strict and failed is not None:
            break
    return failed
