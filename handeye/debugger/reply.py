"""Defines the stepper's reply to a command. The reply is a record for programs and people, with a summary of each
executed step.
"""

from collections.abc import Iterable, Sequence
from typing import Final

from msgspec import UNSET, UnsetType

from handeye.core.plain_text import one_line
from handeye.core.record import Record
from handeye.core.units import Measures
from handeye.debugger.listing import SourceLine
from handeye.debugger.view_records import RunViews, TaskView
from handeye.program import events as happened
from handeye.program.events import AnyEvent
from handeye.runs.advance import AnyStop, Pause
from handeye.runs.system import Listing
from handeye.trace.sentences import sentence

_BETWEEN: Final = (
    happened.StageStarted,
    happened.OperatorAnswered,
    happened.ExperimentMade,
    happened.PeriodsCommanded,
    happened.LineTyped,
    happened.UndoOrdered,
)  # events between two steps
_SILENT: Final = (happened.StepStarted, happened.StepFinished, happened.CameraBusy)


class StepSummary(Record, frozen=True, kw_only=True):
    """An executed step, or an event between two steps."""

    line: int | None  # line of the source; None between steps
    file: str = ""  # the required file that contains this line; empty for the script itself
    text: str
    outcome: str


def step_summaries(
    events: Iterable[AnyEvent], program: Listing, measures: Measures
) -> tuple[StepSummary, ...]:
    groups: list[list[AnyEvent]] = [[]]
    for event in events:
        if isinstance(event, (happened.StepStarted, *_BETWEEN)):
            groups.append([event])
        elif not isinstance(event, (happened.StageFinished, happened.UndoEnded)):
            groups[-1].append(event)
    return tuple(_summary(group, program, measures) for group in groups[1:])


def _summary(group: Sequence[AnyEvent], program: Listing, measures: Measures) -> StepSummary:
    first = group[0]
    if isinstance(first, happened.StepStarted):
        outcome, text = _outcome(group, first, program, measures), one_line(first.text)
        if isinstance(first, happened.UndoStarted):
            text = f"undo {text}"
        return StepSummary(line=first.line, file=first.file, text=text, outcome=outcome)
    return StepSummary(line=None, text=sentence(first, measures), outcome="")


def _outcome(
    group: Sequence[AnyEvent], step: happened.StepStarted, program: Listing, measures: Measures
) -> str:
    said = []
    for event in group:
        if isinstance(event, happened.ErrorTested):
            ways = program.steps[step.step].ways
            onward = ways[-1] if event.occurred else ways[0]
            where = "to the end" if onward is None else f"continue at line {program.steps[onward].place}"
            said.append(f"{sentence(event)}: {where}")
        elif isinstance(event, happened.OperatorCalled) and event.error is not None:
            said.append("the program calls the operator")
        elif not isinstance(event, _SILENT):
            said.append(sentence(event, measures))
    busy = sum(event.seconds for event in group if isinstance(event, happened.CameraBusy))
    if busy:
        said.append(f"the camera took {busy:.1f} s")
    return "; ".join(said) or _end(group, step, program, measures)


def _end(group: Sequence[AnyEvent], step: happened.StepStarted, program: Listing, measures: Measures) -> str:
    """Return the place of the hand, or the gap of the fingers, at the end of a step in which nothing else happened.
    The text is empty if the step took no time.
    """
    last = next((event for event in group if isinstance(event, happened.StepFinished)), None)
    if last is None or last.time == step.time:
        return ""
    if program.steps[step.step].needs == "hand" and last.gap is not None:
        return f"gap {measures.distance(last.gap)}"
    return "" if last.hand is None else f"hand at {measures.place(last.hand)}"


class Break(Record, frozen=True, kw_only=True):
    """A breakpoint, with the number by which the user can delete it."""

    number: int
    stop: AnyStop


class CommandResult(Record, frozen=True, kw_only=True):
    """The result of a command. Fields without content are left out."""

    said: str | UnsetType = UNSET
    pause: Pause | None = None  # why the run pauses, if the command continued it
    source: tuple[SourceLine, ...] | UnsetType = UNSET  # lines around the present one, or the requested lines
    show: RunViews | UnsetType = UNSET
    breaks: tuple[Break, ...] | UnsetType = UNSET
    file: str | UnsetType = UNSET  # file that was written


class UnderWay(Record, frozen=True, kw_only=True):
    """A step that has just begun. The field names are those of `Reply`."""

    position: int
    time: float
    stage: str
    stage_number: int
    step: int
    line: int
    text: str
    script: str = ""


class Reply(CommandResult, frozen=True, kw_only=True):
    """The reply to a command: where the run is now, and the result of the command."""

    command: str
    position: int  # steps done
    time: float  # s since the working phase began
    stage: str | None  # present or next; None after the last
    stage_number: int | None  # from 1
    step: int | None  # the step to be done next; None if the run cannot continue alone
    line: int | None
    text: str | None  # its statement
    script: str = ""  # the required file that contains this line; empty for the script itself
    tasks: tuple[TaskView, ...] | UnsetType = UNSET  # places of the tasks, if there are several
    did: tuple[StepSummary, ...] = ()  # steps that were done, in words
    events: tuple[AnyEvent, ...] = ()  # events that have happened, in full
    error: str | None = None  # why the command was not executed
