"""Collects the data that the 3D view adds to the picture of the cell: the forces at the hand, the places of searches,
and held objects.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.core.polyline import needed_rows, off_values
from handeye.core.pose import Array
from handeye.planning.grasp_state import GraspState
from handeye.program.guards import GuardKind
from handeye.report.facts.felt import GuardedMotion
from handeye.report.facts.planned import Search
from handeye.report.recorded import RecordedRun
from handeye.tasks import known, known_any
from handeye.tasks.interface import AnyTask
from handeye.trace.forces import Forces
from handeye.trace.stages import done_steps

FORCE: Final = 0.2
"""The report interpolates between some of the recorded forces. This is the greatest error (N) of each component: a
tenth of the smallest force limit that a program gives to a guard.
"""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SensedForce:
    """The force that the hand exerted in one motion, at n moments. Between these moments, the force can be
    interpolated.
    """

    times: Array  # s since the run began, shape (n,)
    forces: Array  # N, in the axes of the world, shape (n, 3)
    limit: float | None  # limit of the guard (N); None if no guard watched a force


@dataclass(frozen=True, slots=True, kw_only=True)
class TriedPlaces:
    """The times at which the hand was at each place of a search."""

    times: tuple[float, ...]  # s since the run began
    found: bool  # the last place was the right one


@dataclass(frozen=True, slots=True, kw_only=True)
class HeldObject:
    """An object that the hand holds, according to the program."""

    name: str
    begin: float  # s since the run began
    end: float


def sensed_forces(run: RecordedRun) -> tuple[SensedForce, ...]:
    """Return the forces of a run, the earliest first. Returns no forces if the trace contains no motion, or if the
    task gives forces in other axes than those of the world.
    """
    task = known_any(run.trace.head.task)
    if not len(run.trace.times) or (task is not None and task.force_axes != AnyTask.force_axes):
        return ()
    return tuple(_thinned(motion) for motion in run.trace.forces().motions())


def _thinned(motion: Forces) -> SensedForce:
    allowed = np.full(len(motion.times), FORCE)
    offs = [off_values(column, motion.times, allowed) for column in motion.force.T]
    rows = needed_rows(lambda *at: np.max([off(*at) for off in offs], axis=0), sorted({0, len(allowed) - 1}))
    watched = motion.limit[np.isin(motion.guard, [GuardKind.FORCE.value, GuardKind.AGAINST.value])]
    limit = float(watched[-1]) if len(watched) else None
    return SensedForce(times=motion.times[rows], forces=motion.force[rows], limit=limit)


def tried_places(searches: Sequence[Search], motions: Sequence[GuardedMotion]) -> tuple[TriedPlaces, ...]:
    """For each search, return the times at which the hand was at the places of the search. For the last place, the
    time is the end of the first guarded motion after the search reached the place. For every other place, the time is
    the end of the last guarded motion before the search left the place.
    """
    ends = np.array([motion.times[-1] for motion in motions])
    return tuple(_tried(search, ends) for search in searches if len(ends) and search.times)


def _tried(search: Search, ends: Array) -> TriedPlaces:
    before = np.searchsorted(ends, search.times, side="right") - 1
    rows = [*before[before >= 0].tolist(), min(int(before[-1]) + 1, len(ends) - 1)]
    return TriedPlaces(times=tuple(ends[sorted(set(rows))].tolist()), found=not search.exhausted)


def held_objects(run: RecordedRun) -> tuple[HeldObject, ...]:
    """Return the objects that the hand held, and when it held them, the earliest first. Returns no objects if the task
    of the run is unknown.
    """
    return tuple(_held(run))


def _held(run: RecordedRun) -> Iterator[HeldObject]:
    task = known(run.trace.head.task)
    if task is None:
        return
    state, since = GraspState(run.program, task.arm.hand), 0.0
    for step in done_steps(run.trace.events):
        before, end = state.held, step.span.end
        state.follow(step.started.step, run.program.steps[step.started.step])
        if state.held == before:
            continue
        if before is not None and since < step.started.time:
            yield HeldObject(name=before, begin=since, end=step.started.time)
        since = min(end, run.ends)
    if state.held is not None:
        yield HeldObject(name=state.held, begin=since, end=run.ends)
