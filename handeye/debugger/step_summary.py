"""Summary of a run: a line for each step, with its place in the source and its outcome."""

from collections.abc import Iterable, Sequence
from typing import Final

from handeye.core.plain_text import one_line
from handeye.core.record import Record
from handeye.core.units import Measures
from handeye.program import events as happened
from handeye.program.events import AnyEvent
from handeye.runs.system import Listing
from handeye.trace.sentences import sentence

_BETWEEN: Final = (
    happened.StageStarted,
    happened.OperatorAnswered,
    happened.ExperimentMade,
    happened.LineTyped,
    happened.UndoOrdered,
)
"""Events between two steps."""
_SILENT: Final = (happened.StepStarted, happened.StepFinished, happened.CameraBusy)
"""Events in a step that are summarized differently, or not at all."""


class StepSummary(Record, frozen=True, kw_only=True):
    """A step that was done, or something else between two steps."""

    line: int | None
    """Line of the source; None between steps."""
    file: str = ""
    """The required file that line is in; empty: the script itself."""
    text: str
    outcome: str


def step_summaries(
    events: Iterable[AnyEvent], program: Listing, measures: Measures
) -> tuple[StepSummary, ...]:
    """Summarize some events, whole steps."""
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
    """The outcome of a step, in words."""
    said = []
    for event in group:
        if isinstance(event, happened.ErrorTested):
            said.append(f"{sentence(event)}: {_onward(event, step, program)}")
        elif isinstance(event, happened.OperatorCalled) and event.error is not None:
            said.append("the operator is called")
        elif not isinstance(event, _SILENT):
            said.append(sentence(event, measures))
    busy = sum(event.seconds for event in group if isinstance(event, happened.CameraBusy))
    if busy:
        said.append(f"the camera took {busy:.1f} s")
    return "; ".join(said) or _end(group, step, program, measures)


def _onward(event: happened.ErrorTested, step: happened.StepStarted, program: Listing) -> str:
    """Next line after a test."""
    ways = program.steps[step.step].ways
    onward = ways[-1] if event.occurred else ways[0]
    return "to the end" if onward is None else f"continue at line {program.steps[onward].place}"


def _end(group: Sequence[AnyEvent], step: happened.StepStarted, program: Listing, measures: Measures) -> str:
    """End of a step without other events; empty for one that took no time."""
    last = next((event for event in group if isinstance(event, happened.StepFinished)), None)
    if last is None or last.time == step.time:
        return ""
    if program.steps[step.step].needs == "hand" and last.gap is not None:
        return f"gap {measures.distance(last.gap)}"
    return "" if last.hand is None else f"hand at {measures.place(last.hand)}"
