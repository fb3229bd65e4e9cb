"""`handeye trials mutants`: what happens if one of a program's checks is missing or weaker."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from handeye.cli.common import Camera, WholeNumber, camera_here, note, put_json, say
from handeye.cli.programs import plan_or_own
from handeye.cli.sweeps import ANY, SweepOptions, carry_out_sweep
from handeye.cli.world_options import ANY_WORLD, WorldOptions
from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, NoSuchName, Refused
from handeye.tasks import planned

if TYPE_CHECKING:
    from handeye.trials.mutants.rules import Mutant


def mutant_trials(
    *,
    only: Annotated[
        list[str] | None,
        Parameter(
            help="Try only the mutants whose names contain this text, such as `line 569` or `unguarded`. May be "
            "repeated.",
            consume_multiple=False,
        ),
    ] = None,
    listed: Annotated[bool, Parameter(name="--list", help="List the mutants; run nothing.")] = False,
    most: Annotated[
        WholeNumber,
        Parameter(
            help="Greatest number of faults to run each mutant with. Each run has one fault. 0: only prove, and run "
            "nothing."
        ),
    ] = 5,
    checkpoints: Annotated[
        Path | None,
        Parameter(
            help="Folder of the fault-free run. The runs of the mutants start from the checkpoints in this folder. "
            "The command creates the folder if it is missing, and keeps it. Needed unless --most is 0."
        ),
    ] = None,
    world: WorldOptions = ANY_WORLD,
    camera: Camera = "auto",
    options: SweepOptions = ANY,
) -> int:
    """Make mutants of a program, each with one check taken away or weakened. Does the proof refuse each mutant? If
    not, does another check catch the faults for which the changed check was meant?

    If `handeye check --prove` accepts a mutant, the mutant runs from the beginning of its stage, once with each fault
    for which the changed check is meant. The mutant is `silent` if, in at least one run, it reports success although
    the work is wrong. A mutant that is not silent is `caught` if at least one run stops, and `unnoticed` if all runs
    end with the right work. If the changed check is meant for no known fault, the mutant is `not run`.

    Exit code 0: no mutant was silent; 1: no trial finished; 3: a mutant was silent; 2: bad input; 130: interrupted.
    """
    from handeye.trials.folder import head_of
    from handeye.trials.mutants.rules import mutants
    from handeye.trials.mutants.trials import MUTANTS, MutantWork
    from handeye.trials.sweep import Case

    options.check()
    if most < 0:
        raise BadArgument(f"--most must be 0 or more, not {most}")
    work, spec, camera = planned(world.work), world.spec, camera_here(camera)
    if not work.obligations(spec):
        raise Refused(
            f"the task {quoted(work.name)} declares no obligations, so there is nothing to prove about a mutant"
        )
    if most and checkpoints is None and not listed:
        raise BadArgument("the runs need --checkpoints DIR; with --most 0, there are only proofs and no runs")
    plan = plan_or_own(None, world.task)
    made = _chosen(list(mutants(plan.program)), only)
    if listed:
        return _list(made, json=options.json)
    return carry_out_sweep(
        MUTANTS,
        MutantWork(
            plan=plan, world=spec, mutants={each.name: each for each in made}, camera=camera,
            sound=checkpoints or Path(), most=most,
        ),
        [Case(trials=(0,), seed=spec.seed, condition=each.name) for each in made],
        head_of(MUTANTS, spec, plan, {"faults at most": str(most)}, camera=camera),
        options,
        title=f"mutants of {plan.program.name} in the world of {spec}",
        plan=plan,
    )  # fmt: skip


def _chosen(made: "list[Mutant]", only: list[str] | None) -> "list[Mutant]":
    """The mutants whose names contain at least one text of `only`; all mutants if `only` is None or empty."""
    for text in only or ():
        if not any(text in each.name for each in made):
            raise NoSuchName(f"no mutant has {quoted(text)} in its name; --list lists the mutants")
    return [each for each in made if not only or any(text in each.name for text in only)]


def _list(made: "list[Mutant]", *, json: bool) -> int:
    if json:
        put_json([{"name": each.name, "stage": each.stage, "steps": each.steps} for each in made])
        return 0
    for each in made:
        say(f"{each.name:48}  stage {each.stage}")
    note(f"{len(made)} mutants")
    return 0
