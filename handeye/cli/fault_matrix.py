"""The command that tries faults, one per run: the outcome of each, and whether the program notices it."""

from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from handeye.cli.common import Camera, WholeNumber, camera_here, positive, put, screen
from handeye.cli.programs import plan_or_own
from handeye.cli.sweeps import ANY, SweepOptions, carry_out_sweep
from handeye.cli.world_options import ANY_WORLD, WorldOptions, stage_of
from handeye.core.errors import BadArgument

if TYPE_CHECKING:
    from handeye.core.faults import Catalogue, FaultKind


def faults(
    *,
    only: Annotated[
        list[str] | None,
        Parameter(help="A fault or a group of faults; may be repeated.", consume_multiple=False),
    ] = None,
    every: Annotated[
        bool, Parameter(name="--all", help="Try all faults, not only those of the matrix.")
    ] = False,
    listed: Annotated[
        bool, Parameter(name="--list", help="List the faults and the expected outcome of each; run nothing.")
    ] = False,
    stage: Annotated[
        str | None, Parameter(help="Start the faults that can begin during work at this stage.")
    ] = None,
    n: Annotated[
        WholeNumber,
        Parameter(name="--n", help="Number of worlds, from --seed on; each fault is tried in each world."),
    ] = 1,
    world: WorldOptions = ANY_WORLD,
    camera: Camera = "auto",
    options: SweepOptions = ANY,
    overwrite: Annotated[bool, Parameter(help="Drop the trials in the folder.")] = False,
) -> int:
    """Assemble once with each fault of a matrix, at its usual size, and report which the program noticed.

    Good outcomes: the program `recovered`, or it `stopped` in the right stage, with the brakes on, and named the
    fault. Less good: it stopped but named another fault (`misnamed`). Bad outcomes, counted as undetected: the program
    ought to notice and did not (`unnoticed`), it stopped without brakes (`unbraked`), or it reported success with a
    wrong pump (`silent`). A run takes up to one CPU minute; the time left is shown on standard error. Ctrl-C stops the
    command and prints the runs that have finished; with --out the same command continues from there.

    Exit code 0: every fault was detected; 1: no trial finished; 3: a fault was undetected; 2: bad input; 130:
    interrupted.
    """
    from handeye.trials.faults import FAULTS, FaultWork, chosen, usual, with_panic
    from handeye.trials.folder import head_of
    from handeye.trials.sweep import cases

    spec = world.spec
    catalogue = with_panic(world.work.faults(spec))
    if every and only:
        raise BadArgument("--all cannot be given with --only")
    if listed and (stage is not None or options.out is not None):
        raise BadArgument("--list runs nothing: leave out --stage and --out")
    positive(options.jobs, "worker")
    positive(n, "world")
    everything = every or (listed and not only)
    kinds = chosen(catalogue, tuple(catalogue.kinds) if everything else only or ())
    if listed:
        return _list(catalogue, kinds, json=options.json)
    options.check()
    plan, camera = plan_or_own(None, world.task), camera_here(camera)
    first = None if stage is None else stage_of(plan.program)(stage)
    given = usual(catalogue, kinds, first, len(plan.program.stages))
    return carry_out_sweep(
        FAULTS,
        FaultWork(plan=plan, world=spec, faults=given, camera=camera),
        cases(spec.seed, range(n), [*given]),
        head_of(FAULTS, spec, plan, camera=camera),
        options,
        title=f"{plan.program.name} with one fault at a time, in worlds from {spec} on",
        plan=plan,
        anew=overwrite,
    )


def _list(catalogue: "Catalogue", kinds: "list[FaultKind]", *, json: bool) -> int:
    from handeye.results.faults_page import faults_json, faults_page

    if json:
        put(faults_json(catalogue, kinds))
    else:
        screen.print(faults_page(catalogue, kinds, screen.width))
    return 0
