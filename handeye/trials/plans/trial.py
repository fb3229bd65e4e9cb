"""Executes one trial, and returns the row for the batch. A trial executes a planned program, or dismantles the product
of the program.
"""

import hashlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import ClassVar, Final

import msgspec

from handeye.core.host_time import HostTimer
from handeye.core.plain_text import counted
from handeye.core.variation import WorldSpec
from handeye.judge.finding import all_right
from handeye.planfile.plan import Plan
from handeye.program.events import AnyEvent, StepStarted, UndoFinished, to_line
from handeye.results.finishing import finished
from handeye.results.judging import findings
from handeye.runs.advance import AfterStage, advance
from handeye.runs.host_seconds import Meter
from handeye.runs.observer import Observer
from handeye.runs.operator import NOBODY, parse_policy
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.tasks import task
from handeye.trials.assembly import FinishedRun, run_plan
from handeye.trials.folder import Head, head_of
from handeye.trials.plans.distributions import details, margin_details
from handeye.trials.plans.row import APART, OUTCOMES, Row, contacts, searches
from handeye.trials.sweep import Case, Ended, Sweep

SIMULATED_LIMIT_S: Final = 3600.0  # Seconds on the cell's clock: five times what a whole pump takes
CPU_LIMIT_S: Final = 1800.0  # Seconds of CPU time: thirty times what a whole pump takes


@dataclass(frozen=True, slots=True, kw_only=True)
class Trial:
    """Executes trials of one plan."""

    row: ClassVar[type[Row]] = Row

    plan: Plan
    world: WorldSpec  # The worlds without their seeds
    camera: str = "auto"
    without: tuple[str, ...] = ()
    on_stop: str = "abort"
    """The rule that answers calls to the operator, as text for `parse_policy`. A rule that asks a person is not
    allowed.
    """
    simulated_limit_s: float = SIMULATED_LIMIT_S
    cpu_limit_s: float = CPU_LIMIT_S

    def head(self, sweep: Sweep[Row], seeds: tuple[int, ...] = ()) -> Head:
        """Return the head of a batch of these trials. `seeds` are needed only if the seeds of the trials are
        not consecutive."""
        return head_of(
            sweep, self.world, self.plan, self.settings, camera=self.camera, without=self.without,
            on_stop=self.on_stop, simulated_limit_s=self.simulated_limit_s, seeds=seeds,
        )  # fmt: skip

    @property
    def settings(self) -> dict[str, str]:
        """Settings of this kind of trial, by name. The trials depend on these settings and on the other fields of the
        head.
        """
        return {}

    def __call__(self, case: Case) -> list[Row]:
        """Execute one trial."""
        timer, watch = HostTimer(), Watch(simulated_s=self.simulated_limit_s, cpu_s=self.cpu_limit_s)
        (number,) = case.trials
        try:
            found = self._facts(self._world(case), timer, watch)
        except Exception:
            if watch.ended == "ended":
                raise
            found = {"ended": watch.ended}
        return [self.row(trial=number, seed=case.seed, condition=case.condition, **found)]  # type: ignore[arg-type]

    def _world(self, case: Case) -> WorldSpec:
        """Return the world of a trial."""
        return msgspec.structs.replace(self.world, seed=case.seed)

    def _facts(self, world: WorldSpec, timer: HostTimer, watch: "Watch") -> dict[str, object]:
        """Return the fields of a trial's row, if the trial raised no exception."""
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


def events_digest(events: list[AnyEvent]) -> str:
    """Return sixteen hexadecimal digits that identify the events of a run."""
    digest = hashlib.sha256()
    for event in events:
        digest.update(to_line(event))
    return digest.hexdigest()[:16]


def facts(done: FinishedRun, ended: Ended) -> dict[str, object]:
    """Return the fields that every row has, whatever the kind of its run."""
    steps = [event for event in done.runner.events if isinstance(event, StepStarted)]
    return {
        "ended": ended,
        "result": done.result,
        "place": None if done.result.completed or not steps else steps[-1].place,
        "events": events_digest(done.runner.events),
    }


@dataclass(slots=True, kw_only=True)
class Watch:
    """Stops a run that takes too long, as the panic button would. Only simulated time and CPU time count, so it
    makes no difference if the computer is paused or busy with other work.
    """

    simulated_s: float
    cpu_s: float  # Seconds of the processor
    ended: Ended = "ended"
    timer: HostTimer = field(default_factory=HostTimer)
    clock: Callable[[], float] = lambda: 0.0

    def looking_on(self, runner: Runner) -> tuple[Observer, ...]:
        """Use the clock of this run from now on. Returns no observers."""
        self.clock = lambda: runner.time
        return ()

    def over(self) -> bool:
        """Return True if the run has taken too long."""
        if self.clock() > self.simulated_s:
            self.ended = "simulated limit"
        elif self.timer.cpu_s > self.cpu_s:
            self.ended = "processor limit"
        return self.ended != "ended"


def answered(rows: Sequence[Row]) -> int:
    """Return the number of trials in which calls to the operator were answered, no matter how the trials ended."""
    return sum(row.result is not None and bool(row.result.interventions) for row in rows)


def _summary(rows: Sequence[Row]) -> list[str]:
    count = answered(rows)
    return (
        [f"in {counted(count, 'trial')}, the program called the operator and got an answer"] if count else []
    )


ASSEMBLY: Final = Sweep(
    kind="assembly",
    row=Row,
    outcomes=OUTCOMES,
    success="assembled",
    narrated=True,
    summary=_summary,
    more=lambda rows: {"answered": answered(rows)},
    details=details,
)
"""Sweep of programs that are executed and judged."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DismantlingTrial(Trial):
    """Executes a plan, lets the arm undo all its work, and lets the referee judge whether every part is back in
    its place.
    """

    to: str = ""  # The stage after which it begins to undo; empty: after the last

    @property
    def settings(self) -> dict[str, str]:
        return {"stage to undo from": self.to}

    def _facts(self, world: WorldSpec, timer: HostTimer, watch: Watch) -> dict[str, object]:
        setup = Setup(plan=self.plan, world=world, camera=self.camera, without=self.without, judged=True)
        runner = Runner(Checkpoint(setup=setup), observers=watch.looking_on, halt=watch.over)
        stages = self.plan.program.stages
        stops = [AfterStage(stage=stages.index(self.to), name=self.to)] if self.to else []
        pause = advance(runner, stops)
        built = pause.kind == "break" or (pause.kind == "end" and all_right(findings(runner, pause)))
        if built:
            runner.order_reversal(0, halts=True)
            pause = advance(runner)
        done = FinishedRun(result=finished(runner, pause, Meter(timer=timer), judged=True), runner=runner)
        ended = "not built" if not built and watch.ended == "ended" else watch.ended
        met = [event.force for event in runner.events if isinstance(event, UndoFinished)]
        return facts(done, ended) | {"force": max(met, default=None)}


DISMANTLING: Final = Sweep(
    kind="dismantling",
    row=Row,
    outcomes=APART,
    success="apart",
    narrated=True,
    details=lambda rows: (margin_details([row for row in rows if row.verdict != "not built"]),),
)
"""Sweep of programs: each is executed, and then the arm undoes the work."""
