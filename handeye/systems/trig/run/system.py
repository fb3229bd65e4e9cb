"""TRIG as a system of handeye. This module defines what a TRIG run can do, how messages describe a run, and which
files a run leaves.
"""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Final

from handeye.execution.state import ReversalOrder
from handeye.machines.purbrick import PURBRICK
from handeye.program.events import (
    Choice,
)
from handeye.results.result import Result
from handeye.runs.advance import Pause
from handeye.runs.operator import undoing
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.system import Listing, RunCallbacks, StepperWords, System
from handeye.systems.trig import ENTRY
from handeye.systems.trig.jobs.benches import JobName, TaughtPlan, job_script
from handeye.systems.trig.run.job import account, carry_out, ends_job, job_of
from handeye.systems.trig.run.job_page import job_files, kept_job_page
from handeye.systems.trig.run.plan import decode, encode, listing
from handeye.systems.trig.run.running_job import RunningJob
from handeye.systems.trig.run.state import CompletedStep, TaughtState
from handeye.tasks import any_task

OWN_BLOCKS: Final = 5  # default blocks in the stack: enough for a program of 75 steps


class TaughtSystem(System):
    """The system that runs TRIG programs. Each program is taught in the world of its run."""

    name = ENTRY.name
    plan = TaughtPlan
    state = TaughtState
    words = StepperWords(
        about=("The program runs one step at a time, as it was taught; the arrow marks the next step.",),
        places=("PLACE is a line number, a step's name, or a kind of step (LOOP, GRASP). WHAT is one of",),
        units="millimetres, degrees, newtons",
        commands={
            "proceed": (
                "repeat the step that called the operator; while the program runs backwards, try again to undo "
                "this step"
            ),
            "retry": "the same as `proceed`",
            "skip": "end the program here; not possible while the program runs backwards",
        },
    )

    def encode(self, plan: TaughtPlan) -> bytes:
        return encode(plan)

    def decode(self, data: bytes, name: str) -> TaughtPlan:
        return decode(data, name)

    def listing(self, plan: TaughtPlan) -> Listing:
        return listing(plan)

    def build(self, setup: Setup, around: RunCallbacks) -> RunningJob:
        self.check(setup)
        return RunningJob(setup, around)

    def own_plan(self, task: JobName) -> TaughtPlan:  # type: ignore[override]  # narrower than any task: only its own are asked for
        return TaughtPlan(job=task, script=job_script(task, OWN_BLOCKS))

    def machine(self, plan: TaughtPlan) -> tuple[str, str]:
        return PURBRICK.name, ""

    def check(self, setup: Setup) -> None:
        super().check(setup)
        task, world = any_task(setup.task), setup.world
        task.variation().check(world)
        task.faults(world).check(world.faults)

    def executed(self, plan: TaughtPlan, state: TaughtState) -> Sequence[CompletedStep]:
        return state.executed(plan)

    def order(self, plan: TaughtPlan, state: TaughtState, undoing: ReversalOrder) -> None:
        state.order(plan, undoing)

    def choices(self, runner: Runner) -> Mapping[Choice, str]:
        if undoing(runner):
            return {"proceed": "proceed: try again to undo the step", "retry": "retry: the same as proceed"}
        return {
            "proceed": "proceed: try the step again",
            "retry": "retry: the same as proceed",
            "skip": "skip: end the program here",
        }

    def carry_out(self, runner: Runner, go: Callable[[], Pause]) -> Pause:
        return carry_out(runner, go=lambda _: go())

    def files(self, runner: Runner, pause: Pause, result: Result) -> Mapping[str, bytes]:
        if not ends_job(runner, result):
            return {}
        return job_files(account(runner, pause, result), job_of(runner).job.session.program)

    def page(self, folder: Path) -> bytes | None:
        return kept_job_page(folder)


TAUGHT: Final = TaughtSystem()
