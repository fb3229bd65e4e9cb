"""A recorded run, with all data for its report."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadFile
from handeye.planfile.plan import Plan
from handeye.program.program import Program
from handeye.results.result import Result
from handeye.tasks import known, known_any
from handeye.tasks.interface import HistoricalTiming
from handeye.trace.reading import plan_of
from handeye.trace.trace import Trace


@dataclass(frozen=True, kw_only=True, eq=False)
class RecordedRun:
    """A recorded run. Times are in seconds since the run began."""

    trace: Trace
    whole: bool = True  # The trace was read to its end; False: its file was cut short
    result: Result | None = None  # The result of the run; None if it left none
    end: bytes | None = None
    """The saved picture of the run's end, a PNG or WebP file; None if there is none."""
    remarks: tuple[str, ...] = ()

    @cached_property
    def plan(self) -> Plan:
        return plan_of(self.trace)

    @property
    def program(self) -> Program:
        return self.plan.program

    @property
    def period(self) -> HistoricalTiming | None:
        """The times of 1973, or None if this program was not timed in 1973."""
        task = known(self.trace.head.task)
        then = None if task is None else task.period
        return then if then is not None and then.program == self.trace.head.program else None

    @property
    def begins(self) -> float:
        """Time at which the recording of motions begins (s). The time is 0, unless the run was resumed from a
        checkpoint.
        """
        return self.trace.begins

    @property
    def ends(self) -> float:
        """Time of the last event (s)."""
        return self.trace.events[-1].time


def check_scene(run: RecordedRun) -> None:
    """Raise InvalidInput if a body that moved in the run is missing from the task's scene in this installation of
    handeye.
    """
    scene = run.trace.scene
    there = {scene.body(number).name for number in range(scene.nbody)}
    for begin in run.trace.times[:1]:
        for name in run.trace.at(float(begin)).poses:
            if name not in there:
                raise BadFile(
                    f"{run.trace.name} belongs to another scene: the scene shown here has no {quoted(name)}"
                )


def told_faults(run: RecordedRun) -> Iterator[tuple[str, str]]:
    """Yield each injected fault in the form in which users type it, and a sentence on its effect. The sentence
    is empty if the task is unknown."""
    world = run.trace.head.world
    task = known_any(run.trace.head.task)
    for fault in world.faults:
        if task is None:
            yield str(fault), ""
        else:
            catalogue = task.faults(world)
            yield catalogue.written(fault), catalogue.kind(fault.name).meaning
