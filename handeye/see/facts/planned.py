"""Planned and found: where motions were to end and where they did, and what moved their goals."""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from handeye.events import (
    Adjusted,
    AnyEvent,
    GuardTripped,
    PartSeen,
    Restored,
    Saved,
    StepStarted,
)
from handeye.pose import Array
from handeye.record import Vector3
from handeye.see.recorded import Recorded
from handeye.trace.account import ASTRAY
from handeye.trace.steps import DoneStep, done_steps


class Why(StrEnum):
    """Why a motion ended where it did."""

    PLANNED = "as planned"
    MOVED = "goal moved"
    GUARD = "stopped by a guard"
    CARRIED = "began off its plan"


@dataclass(frozen=True, slots=True, kw_only=True)
class Ended:
    """The end of a motion."""

    time: float
    """s since the run began."""
    step: StepStarted
    off: float
    """Distance of the hand from where the plan has it, m."""
    why: Why


@dataclass(frozen=True, slots=True, kw_only=True)
class Cause:
    """What moved a goal: a difference that was saved, or a part that was seen."""

    name: str
    """Of the difference, or of the part."""
    seen: bool
    place: str
    """The line of its SAVE, or of the look."""
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


def ends(run: Recorded) -> tuple[Ended, ...]:
    """The ends of the motions, in order."""
    return tuple(_ends(run))


def corrections(run: Recorded) -> tuple[Correction, ...]:
    """The goals that were moved, in order."""
    return tuple(_corrections(run))


def _ends(run: Recorded) -> Iterator[Ended]:
    before = np.zeros(3)
    for step in done_steps(run.trace.events):
        off = _off(step)
        if off is not None:
            why = _why(step.events, off, before)
            before = off
            time = run.seconds(step.events[-1].time)
            yield Ended(time=time, step=step.started, off=float(np.linalg.norm(off)), why=why)


def _off(step: DoneStep) -> Array | None:
    """Where the hand is off its planned end, shape (3,), m; None: the step moved nothing, or did not end."""
    last = step.events[-1] if step.finished else None
    hand, planned = getattr(last, "hand", None), getattr(last, "planned", None)
    return None if hand is None or planned is None else np.subtract(hand, planned)


def _why(events: list[AnyEvent], off: Array, before: Array) -> Why:
    if any(isinstance(event, GuardTripped) for event in events):
        return Why.GUARD
    if any(isinstance(event, Adjusted) for event in events):
        return Why.MOVED
    carried = np.linalg.norm(off) > ASTRAY and np.linalg.norm(off - before) < np.linalg.norm(off)
    return Why.CARRIED if carried else Why.PLANNED


def _corrections(run: Recorded) -> Iterator[Correction]:
    known: dict[tuple[str, bool], Cause] = {}
    for step in done_steps(run.trace.events):
        for event in step.events:
            match event:
                case Saved():
                    known[event.name, False] = _cause(run, step, event.name, event.time, seen=False)
                case PartSeen():
                    known[event.part, True] = _cause(run, step, event.part, event.time, seen=True)
                case Adjusted():
                    causes = tuple(known[key] for key in _moved_by(run, step, event) if key in known)
                    yield Correction(
                        time=run.seconds(event.time),
                        step=step.started,
                        goal=event.goal,
                        shift=event.shift,
                        causes=causes,
                    )


def _cause(run: Recorded, step: DoneStep, name: str, time: float, *, seen: bool) -> Cause:
    return Cause(name=name, seen=seen, place=step.started.place, time=run.seconds(time))


def _moved_by(run: Recorded, step: DoneStep, adjusted: Adjusted) -> Iterator[tuple[str, bool]]:
    """Names of what moved a goal, each with whether it is a part that was seen."""
    restored = [event for event in step.events if isinstance(event, Restored)]
    rest = np.subtract(adjusted.shift, np.sum([[0, 0, 0], *(event.difference for event in restored)], axis=0))
    position = run.program.positions.get(adjusted.goal)
    if position is not None and position.of is not None and np.linalg.norm(rest) > ASTRAY:
        yield position.of, True
    yield from ((event.name, False) for event in restored)
