"""Goals that were moved off their planned places before motions began, and what moved them."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from handeye.core.record import Vector3
from handeye.program.events import Adjusted, PartSeen, Restored, Saved, SearchAdvanced, StepStarted
from handeye.program.operation import Operation, Use
from handeye.report.recorded import RecordedRun
from handeye.trace.account import ASTRAY
from handeye.trace.stages import DoneStep, done_steps


class Mover(StrEnum):
    """What a goal is moved by."""

    SAVE = "saved in"
    LOOK = "seen in"
    SEARCH = "of the search in"


@dataclass(frozen=True, slots=True, kw_only=True)
class Cause:
    """What moved a goal: a difference that was saved, a part that was seen, or the place that a search was at."""

    name: str
    """Name of the difference, the part, or the place."""
    by: Mover
    place: str
    """The line of its SAVE, of the look, or that sent the search on."""
    time: float
    """When that was, s since the run began."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Correction:
    """A goal that was moved off its planned place before the motion began."""

    time: float
    """s since the run began."""
    step: StepStarted
    goal: str
    shift: Vector3
    """m"""
    causes: tuple[Cause, ...]


def corrections(run: RecordedRun) -> tuple[Correction, ...]:
    """The goals that were moved, in order."""
    return tuple(_corrections(run))


def _corrections(run: RecordedRun) -> Iterator[Correction]:
    known: dict[tuple[Mover, str], Cause] = {}
    search = _Search()
    for step in done_steps(run.trace.events):
        search = _Search() if _concerns_search(_operation(run, step).writes) else search
        for event in step.events:
            match event:
                case Saved():
                    known[Mover.SAVE, event.name] = _cause(run, step, event.name, event.time, Mover.SAVE)
                case PartSeen():
                    known[Mover.LOOK, event.part] = _cause(run, step, event.part, event.time, Mover.LOOK)
                case SearchAdvanced():
                    cause = _cause(run, step, f"place {event.count + 1}", event.time, Mover.SEARCH)
                    search = _Search(offset=event.offset, cause=cause)
                case Adjusted():
                    yield Correction(
                        time=run.seconds(event.time),
                        step=step.started,
                        goal=event.goal,
                        shift=event.shift,
                        causes=tuple(_causes(run, step, event, known, search)),
                    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Search:
    """The place that a search is at."""

    offset: tuple[float, float] = (0.0, 0.0)
    """From its first, m."""
    cause: Cause | None = None
    """None: it is at its first."""


def _cause(run: RecordedRun, step: DoneStep, name: str, time: float, by: Mover) -> Cause:
    return Cause(name=name, by=by, place=step.started.place, time=run.seconds(time))


def _causes(
    run: RecordedRun,
    step: DoneStep,
    adjusted: Adjusted,
    known: Mapping[tuple[Mover, str], Cause],
    search: _Search,
) -> Iterator[Cause]:
    """What moved a goal: the look at its part, for what nothing else explains; differences, and the search."""
    restored = [event for event in step.events if isinstance(event, Restored)]
    rest = np.subtract(adjusted.shift, np.sum([[0, 0, 0], *(event.difference for event in restored)], axis=0))
    searched = _concerns_search(_operation(run, step).reads) and search.cause is not None
    if searched:
        rest = rest - np.array([*search.offset, 0.0])
    position = run.program.positions.get(adjusted.goal)
    if position is not None and position.of is not None and np.linalg.norm(rest) > ASTRAY:
        yield from filter(None, [known.get((Mover.LOOK, position.of))])
    yield from filter(None, (known.get((Mover.SAVE, event.name)) for event in restored))
    if searched and search.cause is not None:
        yield search.cause


def _concerns_search(uses: Iterable[Use]) -> bool:
    """The search that is set up is among what an operation reads or writes."""
    return any(use.kind == "search" for use in uses)


def _operation(run: RecordedRun, step: DoneStep) -> Operation:
    """What a step does."""
    return run.program.steps[step.started.step].operation
