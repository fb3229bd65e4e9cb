"""Planned and found: where motions were to end, where they did, and why."""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from handeye.core.pose import Array
from handeye.program.events import (
    Adjusted,
    AnyEvent,
    GuardTripped,
    StepStarted,
)
from handeye.report.recorded import RecordedRun
from handeye.trace.account import ASTRAY
from handeye.trace.stages import DoneStep, done_steps


class EndReason(StrEnum):
    """Why a motion ended where it did."""

    PLANNED = "as planned"
    MOVED = "goal moved"
    GUARD = "stopped by a guard"
    CARRIED = "began off its plan"


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionEnd:
    """The end of a motion."""

    time: float
    """s since the run began."""
    step: StepStarted
    off: float
    """Distance of the hand from where the plan has it, m."""
    why: EndReason


def ends(run: RecordedRun) -> tuple[MotionEnd, ...]:
    """The ends of the motions, in order."""
    return tuple(_ends(run))


def _ends(run: RecordedRun) -> Iterator[MotionEnd]:
    before = np.zeros(3)
    for step in done_steps(run.trace.events):
        off = _off(step)
        if off is not None:
            why = _why(step.events, off, before)
            before = off
            time = run.seconds(step.events[-1].time)
            yield MotionEnd(time=time, step=step.started, off=float(np.linalg.norm(off)), why=why)


def _off(step: DoneStep) -> Array | None:
    """Where the hand is off its planned end, shape (3,), m; None: the step moved nothing, or did not end."""
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
