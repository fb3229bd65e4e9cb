"""Finds differences between plan and run: where motions ended and why, which goals were shifted and why, and
which searches were made.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from handeye.core.pose import Array
from handeye.core.record import Vector3
from handeye.program.diagnosis.causes import PlacesTried
from handeye.program.events import (
    Adjusted,
    AnyEvent,
    ErrorRaised,
    GuardTripped,
    PartSeen,
    Restored,
    Saved,
    SearchAdvanced,
    StepStarted,
)
from handeye.program.operation import Operation, Use
from handeye.report.recorded import RecordedRun
from handeye.trace.account import ASTRAY
from handeye.trace.stages import DoneStep, done_steps


class EndReason(StrEnum):
    """The reason why a motion ended where it did."""

    PLANNED = "as planned"
    MOVED = "goal moved"
    GUARD = "stopped by a guard"
    CARRIED = "began off its plan"


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionEnd:
    """The end of a motion."""

    time: float  # s since the run began
    step: StepStarted
    off: float  # Distance of the hand from its planned position, m
    why: EndReason


def ends(run: RecordedRun) -> tuple[MotionEnd, ...]:
    """Return the ends of all motions, the earliest first."""
    return tuple(_ends(run))


def _ends(run: RecordedRun) -> Iterator[MotionEnd]:
    before = np.zeros(3)
    for step in done_steps(run.trace.events):
        off = _off(step)
        if off is not None:
            why = _why(step.events, off, before)
            before = off
            time = step.events[-1].time
            yield MotionEnd(time=time, step=step.started, off=float(np.linalg.norm(off)), why=why)


def _off(step: DoneStep) -> Array | None:
    """Return the offset of the hand from the planned end of a step (m, shape (3,)), or None if the step had no
    planned end or did not finish.
    """
    last = step.events[-1] if step.finished else None
    hand, planned = getattr(last, "hand", None), getattr(last, "planned", None)
    return None if hand is None or planned is None else np.subtract(hand, planned)


def _why(events: list[AnyEvent], off: Array, before: Array) -> EndReason:
    if any(isinstance(event, GuardTripped) for event in events):
        return EndReason.GUARD
    if any(isinstance(event, Adjusted) for event in events):
        return EndReason.MOVED
    carried = np.linalg.norm(off) > ASTRAY and np.linalg.norm(off - before) < np.linalg.norm(off)
    return EndReason.CARRIED if carried else EndReason.PLANNED


@dataclass(frozen=True, slots=True, kw_only=True)
class Search:
    """A search that tried more than one place."""

    step: StepStarted  # The step that last advanced the search
    times: tuple[float, ...]  # When the search advanced, s since the run began
    places: tuple[tuple[float, float], ...]  # Places tried, in order: x, y relative to the first place, m
    exhausted: bool


def searches(run: RecordedRun) -> tuple[Search, ...]:
    """Return the searches that tried more than one place, the earliest first."""
    return tuple(_search(run, tries) for tries in _tries(run.trace.events))


def _tries(events: tuple[AnyEvent, ...]) -> Iterator[list[tuple[StepStarted, AnyEvent]]]:
    """For each search, yield the list of steps that advanced the search. Each step comes with the event that reports
    the advance.
    """
    step: StepStarted | None = None
    tries: list[tuple[StepStarted, AnyEvent]] = []
    for event in events:
        if isinstance(event, StepStarted):
            step = event
        if step is None or not (
            isinstance(event, SearchAdvanced)
            or (isinstance(event, ErrorRaised) and isinstance(event.cause, PlacesTried))
        ):
            continue
        if isinstance(event, SearchAdvanced) and event.count == 1 and tries:
            yield tries
            tries = []
        tries.append((step, event))
    if tries:
        yield tries


def _search(run: RecordedRun, tries: list[tuple[StepStarted, AnyEvent]]) -> Search:
    gone_on = [event for _, event in tries if isinstance(event, SearchAdvanced)]
    return Search(
        step=tries[-1][0],
        times=tuple(event.time for event in gone_on),
        places=((0.0, 0.0), *(event.offset for event in gone_on)),
        exhausted=isinstance(tries[-1][1], ErrorRaised),
    )


class Mover(StrEnum):
    """The kinds of reasons for which a goal is shifted: a saved difference, a part that vision located, or a search."""

    SAVE = "saved in"
    LOOK = "seen in"
    SEARCH = "of the search in"


@dataclass(frozen=True, slots=True, kw_only=True)
class Cause:
    """The reason for which a goal was shifted: one saved difference, one part that vision located, or one place to
    which a search advanced.
    """

    name: str
    by: Mover
    place: str  # The line of the SAVE, of the inspection by camera, or of the step that advanced the search
    time: float  # Time of that step, s since the run began


@dataclass(frozen=True, slots=True, kw_only=True)
class Correction:
    """A goal that was shifted from its planned position before the motion began."""

    time: float  # s since the run began
    step: StepStarted
    goal: str
    shift: Vector3  # m
    causes: tuple[Cause, ...]


def corrections(run: RecordedRun) -> tuple[Correction, ...]:
    """Return the goals that were shifted, the earliest first."""
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
                        time=event.time,
                        step=step.started,
                        goal=event.goal,
                        shift=event.shift,
                        causes=tuple(_causes(run, step, event, known, search)),
                    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Search:
    """The present place of a search."""

    offset: tuple[float, float] = (0.0, 0.0)  # Relative to the first place, m
    cause: Cause | None = None  # None: at the first place


def _cause(run: RecordedRun, step: DoneStep, name: str, time: float, by: Mover) -> Cause:
    return Cause(name=name, by=by, place=step.started.place, time=time)


def _causes(
    run: RecordedRun,
    step: DoneStep,
    adjusted: Adjusted,
    known: Mapping[tuple[Mover, str], Cause],
    search: _Search,
) -> Iterator[Cause]:
    """Yield the reasons for which a goal was shifted. These are the saved differences and the search. If they do not
    explain the whole shift, vision must have located the goal's part; this reason then comes first.
    """
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
    """Return True if an operation reads or writes the state of the present search."""
    return any(use.kind == "search" for use in uses)


def _operation(run: RecordedRun, step: DoneStep) -> Operation:
    """Return the operation of a step."""
    return run.program.steps[step.started.step].operation
