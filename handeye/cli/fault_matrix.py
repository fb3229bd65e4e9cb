"""The command that tries faults, one a run: the outcome of each, and whether it is noticed."""

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
        Parameter(help="A fault or a group of them; may be repeated.", consume_multiple=False),
    ] = None,
    every: Annotated[bool, Parameter(name="--all", help="All faults, not those of the matrix only.")] = False,
    listed: Annotated[
        bool, Parameter(name="--list", help="Try nothing; list the faults, and what must happen with each.")
    ] = False,
    stage: Annotated[
        str | None, Parameter(help="Let what can set in while the cell works set in with this stage.")
    ] = None,
    n: Annotated[
        WholeNumber, Parameter(name="--n", help="Worlds, from --seed on; each fault is tried in each.")
    ] = 1,
    world: WorldOptions = ANY_WORLD,
    camera: Camera = "auto",
    options: SweepOptions = ANY,
    overwrite: Annotated[bool, Parameter(help="Drop the trials that are in the folder.")] = False,
) -> int:
    """Assemble once with each fault of a matrix, at its usual size, and say which were noticed.

    A fault is `recovered` from, or the program is `stopped` by its right name, in the right stage, with the brakes on.
    Less good is a stop by another name (`misnamed`). Undetected are `unnoticed` faults that should have been noticed, a
    stop that leaves the arm `unbraked`, and a wrong pump that the program took for right (`silent`).

    A run takes up to a minute of a processor; the time left is estimated on standard error. Ctrl-C ends it
    and prints what has finished; with --out the same command goes on there.

    Exit code 0: no fault was undetected; 1: every trial broke off; 3: one was; 2: bad input; 130: interrupted.
    """
    from handeye.trials.faults import FAULTS, FaultWork, chosen, usual, with_panic
    from handeye.trials.folder import head_of
    from handeye.trials.sweep import cases

    spec = world.spec
    catalogue = with_panic(world.work.faults(spec))
    if every and only:
        raise BadArgument("--all excludes --only")
    if listed and (stage is not None or options.out is not None):
        raise BadArgument("--list tries nothing: leave --stage and --out out")
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
        title=f"{plan.program.name} with one fault each, in worlds from {spec} on",
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
