"""One trial of a batch, from a seed to the row that is kept of it."""

import hashlib
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Final

import msgspec

from handeye.core.host_time import HostTimer
from handeye.core.variation import WorldSpec
from handeye.planfile.plan import Plan
from handeye.program.events import AnyEvent, StepStarted, to_line
from handeye.program.senses import Sense
from handeye.runs.host_seconds import Meter
from handeye.runs.observer import Observer
from handeye.runs.operator import NOBODY, parse_policy
from handeye.runs.runner import Runner
from handeye.tasks import task
from handeye.trials.assembly import Finished, run_plan
from handeye.trials.batch.contacts import contacts, searches
from handeye.trials.batch.row import Ended, Row
from handeye.trials.workers import Answer

SIMULATED_LIMIT_S: Final = 3600.0
"""Of the cell's clock: five times what a whole pump takes."""
WALL_LIMIT_S: Final = 1800.0
"""Of the host's: thirty times what a whole pump takes."""
GRACE: Final = 1.1
"""After so many times the limit, the process is ended from outside: it hangs where nobody asks for the time."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Job:
    """A trial to be carried out."""

    trial: int
    world: WorldSpec


@dataclass(frozen=True, slots=True, kw_only=True)
class Trial:
    """Carries out trials of one plan."""

    plan: Plan
    camera: str = "auto"
    without: tuple[Sense, ...] = ()
    """Senses that the program does without."""
    on_stop: str = "abort"
    """How calls of the operator are answered: a policy, as `parse_policy` knows it, that asks nobody."""
    simulated_limit_s: float = SIMULATED_LIMIT_S
    wall_limit_s: float = WALL_LIMIT_S

    @property
    def work(self) -> str:
        """What is done in each, where that is not to assemble."""
        return ""

    def __call__(self, job: Job) -> Row:
        """Carry one out. An exception is a result: of a thousand trials, none is worth the others."""
        timer, watch = HostTimer(), Watch(simulated_s=self.simulated_limit_s, wall_s=self.wall_limit_s)
        row = Row(trial=job.trial, seed=job.world.seed, ended="raised")
        try:
            found = self._facts(job.world, timer, watch)
        except Exception as error:
            found = (
                {"raised": f"{type(error).__name__}: {error}"}
                if watch.ended == "ended"
                else {"ended": watch.ended}
            )
        spent = {"wall_s": round(timer.wall_s, 3), "cpu_s": round(timer.cpu_s, 3)}
        return msgspec.structs.replace(row, **found, **spent)

    def _facts(self, world: WorldSpec, timer: HostTimer, watch: "Watch") -> dict[str, object]:
        """What a row tells of a trial that no exception broke off."""
        done = run_plan(
            self.plan,
            world=world,
            camera=self.camera,
            meter=Meter(timer=timer),
            observers=watch.looking_on,
            halt=watch.over,
            without=self.without,
            operator=parse_policy(self.on_stop, self.plan.program.stages) or NOBODY,
        )
        program, where = self.plan.program, task(done.runner.setup.task).contacts
        return facts(done, watch.ended) | {
            "contacts": tuple(contacts(program, done.runner.events, where, completed=done.result.completed)),
            "searches": tuple(searches(program, done.runner.events)),
        }


def row_of(answer: Answer[Job, Row]) -> Row:
    """The row of a trial, also of one that was lost with its process.

    Raises:
        BaseException: what carried it out, and not the trial itself, has failed.
    """
    if answer.error is not None:
        raise answer.error
    if answer.value is not None:
        return msgspec.structs.replace(answer.value, killed=answer.killed)
    ended: Ended = "wall limit" if answer.overdue else "killed"
    return Row(
        trial=answer.item.trial,
        seed=answer.item.world.seed,
        ended=ended,
        killed=answer.killed,
        wall_s=round(answer.wall_s, 3),
    )


def events_digest(events: list[AnyEvent]) -> str:
    """Sixteen hexadecimal digits that stand for what happened."""
    digest = hashlib.sha256()
    for event in events:
        digest.update(to_line(event))
    return digest.hexdigest()[:16]


def facts(done: Finished, ended: Ended) -> dict[str, object]:
    """What a row tells of any run."""
    steps = [event for event in done.runner.events if isinstance(event, StepStarted)]
    return {
        "ended": ended,
        "result": done.result,
        "line": None if done.result.completed or not steps else steps[-1].place,
        "events": events_digest(done.runner.events),
    }


@dataclass(slots=True, kw_only=True)
class Watch:
    """Ends a run that takes too long, as the panic button does."""

    simulated_s: float
    wall_s: float
    ended: Ended = "ended"
    begun: float = field(default_factory=time.monotonic)
    clock: Callable[[], float] = lambda: 0.0

    def looking_on(self, runner: Runner) -> tuple[Observer, ...]:
        """Read the clock of a run from now on; nobody looks on."""
        self.clock = lambda: runner.time
        return ()

    def over(self) -> bool:
        """Tell whether it has taken too long."""
        if self.clock() > self.simulated_s:
            self.ended = "simulated limit"
        elif time.monotonic() - self.begun > self.wall_s:
            self.ended = "wall limit"
        return self.ended != "ended"
