"""What the commands of all jobs share: the options of a run, the run, and trials."""

from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

from cyclopts import Parameter

from handeye.cli import judged_jobs
from handeye.cli.common import WholeNumber, note, say
from handeye.cli.judged_jobs import carry_out_job, carry_out_job_trials
from handeye.cli.sweeps import SweepOptions
from handeye.cli.world_options import Faults, OwnErrorOptions, broken
from handeye.tasks import any_task

if TYPE_CHECKING:
    from handeye.systems.sigma.run.job_trials import BoardRow
    from handeye.systems.sigma.run.plan import JobName, MalPlan
    from handeye.trials.sweep import Sweep

JobSeed = Annotated[
    WholeNumber, Parameter(help="Seed of the world: it determines the pieces and the errors of the machine.")
]
NumberOfBoards = Annotated[
    WholeNumber, Parameter(name="--n", help="Number of boards; board K has the seed --seed plus K.")
]


@Parameter(name="*")
@dataclass(frozen=True, slots=True, kw_only=True)
class JobOptions(judged_jobs.JobOptions):
    """Options for running a job, except its world."""

    fault: Faults = None


ANY_RUN: Final = JobOptions()


def job_or_own_plan(job: "JobName", pieces: int, file: Path | None) -> "MalPlan | None":
    """Return the plan of a job's own program, or of the program in `file` for the same pieces. Prints the mistakes of
    that program, and returns None if it has errors."""
    from handeye.core.source import read_source
    from handeye.systems.sigma.cli.commands import reported
    from handeye.systems.sigma.run.jobs import job_plan
    from handeye.systems.sigma.run.plan import MalPlan, sound

    if file is None:
        return job_plan(job, pieces)
    source = read_source(file)
    if not reported(source):
        return None
    plan = MalPlan(name=file.name, text=source.text, arm="gantries", job=job, pieces=pieces)
    sound(plan)
    return plan


def carry_out(plan: "MalPlan", seed: int, errors: OwnErrorOptions, options: JobOptions) -> int:
    """Run the plan of a job and let its referee judge; make the video. Returns the exit code."""
    from handeye.systems.sigma.cli.commands import Printer
    from handeye.systems.sigma.run.jobs import job_setup

    world = broken(errors.of(plan.job).spec(seed), options.fault, any_task(plan.job))
    printers = () if options.step else (Printer(note if options.json else say),)
    return carry_out_job(job_setup(plan, world), options, printers)


def carry_out_trials(
    sweep: "Sweep[BoardRow]",
    plan: "MalPlan",
    n: int,
    seed: int,
    errors: OwnErrorOptions,
    options: SweepOptions,
    *,
    title: str,
    again: str = "",
) -> int:
    """Run the plan of a job on many boards; returns the exit code."""
    from handeye.systems.sigma.run.jobs import job_setup

    return carry_out_job_trials(
        sweep, partial(job_setup, plan), n, seed, errors, options, settings={"pieces": plan.pieces},
        title=f"{title}, on boards from seed {seed} on", again=again,
    )  # fmt: skip
