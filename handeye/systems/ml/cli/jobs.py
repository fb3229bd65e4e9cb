"""What the commands of all jobs share: the options for their worlds, runs and trials."""

from functools import partial
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from handeye.cli.common import WholeNumber
from handeye.cli.judged_jobs import FaultyJobOptions, carry_out_job, carry_out_job_trials
from handeye.cli.sweeps import SweepOptions
from handeye.cli.world_options import OwnErrorOptions, broken
from handeye.tasks import any_task

if TYPE_CHECKING:
    from handeye.systems.ml.run.job_trials import MlJobRow
    from handeye.systems.ml.run.plan import MlPlan
    from handeye.trials.sweep import Sweep

JobSeed = Annotated[
    WholeNumber,
    Parameter(help="Seed of the world. It determines the errors of the arm and where the parts lie."),
]
NumberOfWorlds = Annotated[
    WholeNumber, Parameter(name="--n", help="Number of worlds. The seed of world K is --seed plus K.")
]


def plan_with_parts(job: str, parts: int) -> "MlPlan":
    """Return the plan of a job with this number of parts in its bin.

    Raises:
        NoSuchName: the bin does not take this number of parts.
    """
    from handeye.systems.ml.bin.task import parts_of
    from handeye.systems.ml.run.jobs import job_plan

    parts_of(plan := job_plan(job, str(parts)))
    return plan


def carry_out(plan: "MlPlan", seed: int, errors: OwnErrorOptions, options: FaultyJobOptions) -> int:
    """Run the plan of a job, let its referee judge the result, and make the video. Returns the exit code."""
    from handeye.systems.ml.run.jobs import job_setup

    world = broken(errors.of(plan.job).spec(seed), options.fault, any_task(plan.job))
    return carry_out_job(job_setup(plan, world), options)


def carry_out_trials(
    sweep: "Sweep[MlJobRow]",
    plan: "MlPlan",
    n: int,
    seed: int,
    errors: OwnErrorOptions,
    options: SweepOptions,
    *,
    title: str,
    again: str = "",
) -> int:
    """Run the plan of a job in many worlds, and return the exit code."""
    from handeye.systems.ml.run.jobs import job_setup

    return carry_out_job_trials(
        sweep, partial(job_setup, plan), n, seed, errors, options, settings={"variant": plan.variant},
        title=f"{title}, in worlds with seeds from {seed} upwards", again=again,
    )  # fmt: skip
