"""The command that steps a run in the browser and shows the tables of its machine."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from handeye.cli.common import Out, Overwrite, WholeNumber
from handeye.core.errors import BadArgument, NoSuchName
from handeye.core.source import read_source
from handeye.systems.ml.run.plan import ArmName


def view(
    program: Annotated[str, Parameter(help="An ML program (`.ml`), or the name of a job, such as `follow`.")],
    /,
    *,
    arm: Annotated[
        ArmName | None, Parameter(help="The machine that runs the program, as in `handeye ml run`.")
    ] = None,
    seed: Annotated[WholeNumber, Parameter(help="Seed of the world of the simulated arm.")] = 0,
    variant: Annotated[str, Parameter(help="Variant of the job, such as the outline for `follow`.")] = "",
    sense: Annotated[
        list[str] | None,
        Parameter(help="Reading of a sensor, or state of an interlock; written as for `handeye ml run`."),
    ] = None,
    port: Annotated[WholeNumber, Parameter(help="Port on this computer; 0 for any free port.")] = 0,
    out: Out = None,
    overwrite: Overwrite = False,
) -> int:
    """Step through a run in the browser, and see all tables of its machine while the run goes on.

    In the tables, each word that changed in the cycle shown is highlighted. You can look back at any earlier cycle. A
    value that you write into a word takes effect in the next cycle, even while the arm moves: `MT 3 4` is the goal of
    motor 3, `MT 2 8` the speed of motor 2, and `ST 7 9` a limit of sensor 7. The run records each word that you write,
    so a repetition of the run writes the word again.

    Prints the address to open, which contains a secret and works only on this computer.

    Exit code 0: the program has ended, or you ended the command; 1: an error or an emergency has stopped it; 2: bad
    input.
    """
    from handeye.cli.job import Job, work
    from handeye.core.variation import WorldSpec
    from handeye.runs.setup import Setup
    from handeye.runs.snapshot import Checkpoint
    from handeye.systems.ml.cli.commands import check_machine, reported
    from handeye.systems.ml.cli.senses import sensed
    from handeye.systems.ml.run.jobs import PROGRAMS, job_plan, job_setup
    from handeye.systems.ml.run.plan import MlPlan, sound
    from handeye.view.link import Link
    from handeye.view.server import Server

    file = Path(program)
    if program in PROGRAMS and not file.is_file():
        if arm is not None or sense:
            raise BadArgument(f"the job {program} has an arm and sensors of its own; omit --arm and --sense")
        setup = job_setup(job_plan(program, variant), WorldSpec(seed=seed))
    else:
        if variant:
            raise BadArgument("--variant applies only to a job")
        if not file.suffix and not file.exists():
            raise NoSuchName(
                f"{program}: there is no such file, and no job of that name; jobs are {', '.join(PROGRAMS)}"
            )
        machine: ArmName = arm or "none"
        check_machine(machine, seed=seed, sense=sense)
        source = read_source(file)
        if not reported(source, first=None, left=None):
            return 2
        stimuli = tuple(sensed(each) for each in sense or ())
        plan = MlPlan(name=file.name, text=source.text, arm=machine, stimuli=stimuli)
        sound(plan)
        setup = Setup(system="ml", plan=plan, world=WorldSpec(seed=seed), camera="auto")
    with Server(Link(), port) as server:
        start = Checkpoint(setup=setup)
        return work(Job(start=start, out=out, overwrite=overwrite, step=True, on_stop="ask", server=server))
