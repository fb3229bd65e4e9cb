"""Trials of faults: a job runs with one fault of the arm or of the parts."""

from dataclasses import dataclass
from typing import Final

from msgspec.structs import replace

from handeye.core.diagnostics import quoted
from handeye.core.errors import Refused
from handeye.core.variation import WorldSpec
from handeye.systems.ml.run.jobs import FEW, PROGRAMS, job_plan, job_setup
from handeye.systems.ml.run.plan import MlPlan
from handeye.tasks import any_task
from handeye.trials.faults import FAULTS, FaultRow, FaultTrial, trial_of
from handeye.trials.job_faults import judged_run
from handeye.trials.sweep import Case, Sweep

_LONGEST: Final = 3600.0  # s of simulated time after which a program counts as endless


@dataclass(frozen=True, slots=True, kw_only=True)
class MlFaultWork:
    """Runs a job once for each fault. Each case is a run with one fault, which is named in the case's `condition`."""

    plan: MlPlan
    world: WorldSpec

    def __call__(self, case: Case) -> list[FaultRow]:
        """Run the job with the fault at its usual size."""
        catalogue = any_task(self.plan.job).faults(self.world)
        fault = catalogue.kind(case.condition).usual()
        world = replace(self.world, seed=case.seed, faults=(fault,))
        runner, result = judged_run(job_setup(self.plan, world), _LONGEST)
        if result is None:
            tried = FaultTrial(
                name=catalogue.written(fault), outcome="misnamed", stage=self.plan.name,
                message=f"the program is still running after {_LONGEST:g} s", error=None, line=None, exit_code=1,
            )  # fmt: skip
        else:
            tried = trial_of(fault, catalogue, result, runner.events, braked=True)  # the arm has no brakes
        return [FaultRow(trial=case.trials[0], seed=case.seed, condition=case.condition, tried=tried)]


def fault_trials(task: str, world: WorldSpec) -> tuple[Sweep[FaultRow], MlFaultWork]:
    """Return the trials of a job with each of its faults, and the function that makes one trial. Raises Refused if no
    referee judges the task.
    """
    if task not in PROGRAMS:
        raise Refused(
            f"faults cannot be tried in the task {quoted(task)}, because no referee judges the outcome of this task"
        )
    if not any_task(task).faults(world).kinds:
        raise Refused(f"no faults are declared for the task {quoted(task)}")
    return FAULTS, MlFaultWork(plan=job_plan(task, FEW.get(task, "")), world=world)
