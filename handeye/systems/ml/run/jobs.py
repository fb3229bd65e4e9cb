"""Sets up the runs of jobs: a program, and the station on which it works."""

from typing import Final

from handeye.core.resources import plans
from handeye.core.variation import WorldSpec
from handeye.runs.setup import Setup
from handeye.systems.ml import ENTRY
from handeye.systems.ml.language.assembler import assembled, decks
from handeye.systems.ml.run.plan import MlPlan, sound

PROGRAMS: Final = {
    "follow": "curve_follower.ml",
    "blocks": "blocks.ml",
    "train": "train.ml",
    "support": "support.sym",
    "orient": "orient.ml",
    "bin": "bin.ml",
    "typewriter": "typewriter.sym support.sym",
}  # files that are assembled together are separated by a blank
SYMBOLIC: Final = ".sym"  # file extension of symbolic programs, which are assembled before a run
FEW: Final = {"bin": "3"}  # variants of jobs that have little work, for trials of faults
USUAL: Final = {"follow": "square", "bin": "8", "typewriter": "4"}  # variants of jobs if none is named

COUNTED: Final = {"bin": "5 LOAD 33 {}\n"}
"""By job: the statement that gives the program the number of parts. Only the operator has counted the parts, so the
operator stores this statement before the program runs. `{}` stands for the number, which is the variant of the job.
"""


def job_plan(job: str, variant: str = "") -> MlPlan:
    """Return the plan of a job's own program."""
    name, *others = PROGRAMS[job].split()
    source = decks([plans() / each for each in (name, *others)])
    text = assembled(source)[0] if name.endswith(SYMBOLIC) else source.text
    variant = variant or USUAL.get(job, "")
    text += COUNTED.get(job, "").format(variant)
    return MlPlan(name=name, text=text, arm="rectilinear", job=job, variant=variant)


def program_plan(task: str, name: str, text: str, variant: str = "") -> MlPlan:
    """Return the plan of a run in which a user's program does a variant of a job. By default, the program does the
    usual variant. Raises BadFile if the program has errors.
    """
    plan = MlPlan(name=name, text=text, arm="rectilinear", job=task, variant=variant or USUAL.get(task, ""))
    sound(plan)
    return plan


def job_setup(plan: MlPlan, world: WorldSpec) -> Setup:
    """Return the setup of a run that a referee judges."""
    return Setup(system=ENTRY.name, plan=plan, world=world, camera="auto", judged=True)
