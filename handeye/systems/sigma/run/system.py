"""Builds the runs of MAL programs, and provides the texts with which the stepper describes a run."""

from collections.abc import Mapping
from typing import Final

from handeye.core.resources import plans
from handeye.core.source import read_source
from handeye.program.events import Choice
from handeye.program.numbered import encode
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.system import Listing, RunCallbacks, StepperWords, System
from handeye.systems.sigma import ENTRY
from handeye.systems.sigma.run.jobs import PROGRAMS, job_plan, job_task
from handeye.systems.sigma.run.plan import MalPlan, decode, listing, sound
from handeye.systems.sigma.run.running import RunningMal
from handeye.systems.sigma.run.state import MalState
from handeye.tasks import any_task

OWN: Final = "handover.mal"  # the program that is run if none is named


class SigmaSystem(System):
    """The system that executes a MAL program on the machine that the plan names."""

    name = ENTRY.name
    plan = MalPlan
    state = MalState
    words = StepperWords(
        about=(
            "A step is one statement of the task whose turn it is. Each task has its own position; the arrow",
            "points to the statement that comes next. `back` takes all tasks back together.",
        ),
        places=(
            "PLACE is the number of a line (160), a task (FEEDER), or the first word of a statement (TAKE).",
            "WHAT is one of",
        ),
        units="millimetres, newtons, seconds",
        commands={
            "proceed": "continue after the statement at which the program has stopped",
            "retry": "execute the statement again",
            "skip": "end the program here",
        },
    )

    def encode(self, plan: MalPlan) -> bytes:
        return encode(plan)

    def decode(self, data: bytes, name: str) -> MalPlan:
        return decode(data, name)

    def listing(self, plan: MalPlan) -> Listing:
        return listing(plan)

    def build(self, setup: Setup, around: RunCallbacks) -> RunningMal:
        self.check(setup)
        sound(setup.plan)  # type: ignore[arg-type]  # as `check` has found
        return RunningMal(setup, around)

    def check(self, setup: Setup) -> None:
        super().check(setup)
        task, world = any_task(setup.task), setup.world
        task.variation().check(world)
        task.faults(world).check(world.faults)

    def own_plan(self, task: str) -> MalPlan:
        for job in PROGRAMS:
            if task == job:
                return job_plan(job, job_task(job).few)
        text = read_source(plans() / OWN).text
        return MalPlan(name=OWN, text=text, arm="gantries" if task == "gantries" else "none")

    def choices(self, runner: Runner) -> Mapping[Choice, str]:
        return {
            "proceed": "proceed: continue after this statement",
            "retry": "retry: execute this statement again",
            "skip": "skip: end the program here",
        }


SIGMA: Final = SigmaSystem()
