"""Extracts the forces and moments at the hand in the guarded motions of a run."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from handeye.core.pose import Array
from handeye.program.events import GuardTripped, StageStarted, StepStarted
from handeye.program.guards import GuardKind
from handeye.report.recorded import RecordedRun
from handeye.trace.forces import Forces
from handeye.trace.stages import DoneStep, done_steps


class MetGuard(NamedTuple):
    """A guard that has tripped."""

    time: float  # s since the run began
    value: float  # N, N m, or finger switches as a mask
    limit: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class GuardedMotion:
    """A guarded motion of n servo periods, with the value that its guard watched in each period."""

    stage: str
    step: StepStarted
    guard: GuardKind
    times: Array  # Ends of the periods, shape (n,), s since the run began
    values: Array
    """The quantity that the guard measures, shape (n,). The kind of guard, `guard`, determines the quantity: force
    along the guard's axis (N), moment about this axis (N m), torque of the screwdriver (N m), or finger switches.
    """
    limit: float  # N, N m, or switches
    trip: MetGuard | None


def guarded_motions(run: RecordedRun) -> tuple[GuardedMotion, ...]:
    """Return the guarded motions of a run, the earliest first."""
    if not len(run.trace.times):
        return ()
    forces = run.trace.forces()
    return tuple(_motions(run, forces))


def lost_trips(run: RecordedRun, motions: Sequence[GuardedMotion]) -> int:
    """Return the number of guards that tripped in motions that the trace does not contain."""
    met = sum(isinstance(event, GuardTripped) for event in run.trace.events)
    return met - sum(motion.trip is not None for motion in motions)


def _motions(run: RecordedRun, forces: Forces) -> Iterator[GuardedMotion]:
    stage_of = _stages(run)
    for step in done_steps(run.trace.events):
        rows = step.span.rows(forces.times)
        watched = rows.start + np.flatnonzero(forces.guard[rows] != "")
        if len(watched):
            yield _motion(run, forces, step, watched, stage_of[step.started.time, step.started.step])


def _motion(run: RecordedRun, forces: Forces, step: DoneStep, watched: Array, stage: str) -> GuardedMotion:
    """Return the guarded motion of a step, over the servo periods in which a guard was active."""
    kind = GuardKind(str(forces.guard[watched[0]]))
    met = next((event for event in step.events if isinstance(event, GuardTripped)), None)
    return GuardedMotion(
        stage=stage,
        step=step.started,
        guard=kind,
        times=forces.times[watched],
        values=forces.value[watched],
        limit=float(forces.limit[watched[-1]]),
        trip=None if met is None else MetGuard(met.time, met.value, met.limit),
    )


def _stages(run: RecordedRun) -> dict[tuple[float, int], str]:
    """Return the stage of each step that began. The keys are the time and the number of the step."""
    found: dict[tuple[float, int], str] = {}
    stage = ""
    for event in run.trace.events:
        if isinstance(event, StageStarted):
            stage = event.stage
        elif isinstance(event, StepStarted):
            found[event.time, event.step] = stage
    return found
