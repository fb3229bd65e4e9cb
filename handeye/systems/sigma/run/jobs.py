"""Sets up the runs of jobs. A job is a program together with the pieces on the gantries' board."""

from typing import TYPE_CHECKING, Final

from handeye.core.resources import plans
from handeye.core.source import read_source
from handeye.core.variation import WorldSpec
from handeye.runs.setup import Setup
from handeye.systems.sigma import ENTRY
from handeye.systems.sigma.run.plan import JobName, MalPlan, sound
from handeye.tasks import any_task

if TYPE_CHECKING:  # plans are made without a simulator
    from handeye.systems.sigma.gantries.job import JobTask

PROGRAMS: Final[dict[JobName, str]] = {
    "chess": "chess.mal",
    "handover": "handover_pieces.mal",
    "insert": "insert.mal",
    "prco": "prco.mal",
    "line": "line.mal",
}


def job_plan(job: JobName, pieces: int) -> MalPlan:
    """Return the plan of a job's own program, for a number of pieces."""
    name = PROGRAMS[job]
    return MalPlan(name=name, text=read_source(plans() / name).text, arm="gantries", job=job, pieces=pieces)


def program_plan(task: str, name: str, text: str, variant: str = "") -> MalPlan:
    """Return the plan for a job that is done by a user's program. The variant is the number of pieces; by default, it
    is the job's usual number. Raises BadFile if the program has errors.
    """
    job = next(job for job in PROGRAMS if job == task)
    pieces = int(variant) if variant else job_task(job).usual
    plan = MalPlan(name=name, text=text, arm="gantries", job=job, pieces=pieces)
    sound(plan)
    return plan


def job_task(job: JobName) -> "JobTask":
    """Return the task of a job."""
    from handeye.systems.sigma.gantries.job import JobTask

    task = any_task(job)
    assert isinstance(task, JobTask)
    return task


def job_setup(plan: MalPlan, world: WorldSpec) -> Setup:
    """Return the setup of a run that a referee judges."""
    return Setup(system=ENTRY.name, plan=plan, world=world, camera="auto", judged=True)
