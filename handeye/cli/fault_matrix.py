"""The command that tries faults, one a run: what each comes to, and whether it is noticed."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

from cyclopts import Parameter

from handeye.cli.common import Camera, Json, WholeNumber, note, positive, put, put_json, say, screen
from handeye.cli.kept_records import KeptRecords
from handeye.cli.programs import plan_or_own
from handeye.cli.tally import Tally
from handeye.cli.world_options import ANY_WORLD, WorldOptions, stage_of
from handeye.core.errors import BadArgument
from handeye.core.files import Kind

if TYPE_CHECKING:
    from handeye.core.faults import Catalogue, FaultKind
    from handeye.core.variation import WorldSpec
    from handeye.planfile.plan import Plan
    from handeye.trials.faults import FaultTrial

OUTCOMES: Final = Kind("list of outcomes", rb'\{"name":')


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
    world: WorldOptions = ANY_WORLD,
    workers: Annotated[WholeNumber, Parameter(help="Processes at a time.")] = 2,
    camera: Camera = "auto",
    json: Json = False,
    out: Annotated[
        Path | None,
        Parameter(
            help="File for the outcomes, one JSON object a line; written as runs end. One that is there is not gone on "
            "with, and is replaced with --overwrite only."
        ),
    ] = None,
    overwrite: Annotated[bool, Parameter(help="Replace the outcomes that are there.")] = False,
) -> int:
    """Assemble once with each fault of a matrix, at its usual size, and tell what that comes to.

    A fault is `recovered` from, or the program is `stopped` by its right name, in the right stage, with the brakes on.
    Less good is a stop by another name (`misnamed`). Undetected are `unnoticed` faults that should have been noticed, a
    stop that leaves the arm `unbraked`, and a wrong pump that the program took for right (`silent`).

    A run takes up to a minute of a processor; about how long the rest takes is told on standard error. Ctrl-C ends it,
    and what has ended stays told.

    Exit code 0: no fault was undetected; 3: one was; 2: bad input; 130: interrupted.
    """
    from handeye.trials.faults import chosen, with_panic

    spec = world.spec
    catalogue = with_panic(world.work.faults(spec.seed))
    if every and only:
        raise BadArgument("--all excludes --only")
    if listed and (stage is not None or out is not None):
        raise BadArgument("--list tries nothing: leave --stage and --out out")
    positive(workers, "worker")
    everything = every or (listed and not only)
    kinds = chosen(catalogue, tuple(catalogue.kinds) if everything else only or ())
    if listed:
        return _list(catalogue, kinds, json=json)
    tried = KeptRecords(out, OUTCOMES, by="name", overwrite=overwrite)
    plan = plan_or_own(None, world.task)
    number = None if stage is None else stage_of(plan.program)(stage)
    return _tried(plan, spec, kinds, number, workers=workers, camera=camera, json=json, tried=tried)


def _list(catalogue: "Catalogue", kinds: "list[FaultKind]", *, json: bool) -> int:
    from handeye.results.faults_page import faults_json, faults_page

    if json:
        put(faults_json(catalogue, kinds))
    else:
        screen.print(faults_page(catalogue, kinds, screen.width))
    return 0


def _tried(
    plan: "Plan",
    world: "WorldSpec",
    kinds: "list[FaultKind]",
    stage: int | None,
    *,
    workers: int,
    camera: str,
    json: bool,
    tried: KeptRecords,
) -> int:
    """Carry the plan out with each fault, keep and tell each outcome as its run ends; the exit code."""
    from handeye.trials.faults import counted_outcomes, matrix_of, try_faults

    note(f"{len(kinds)} runs, {workers} at a time")
    ended = try_faults(plan, world, kinds, stage=stage, camera=camera, workers=workers)
    try:
        for trial in Tally(len(kinds), "faults").counting(ended, None if json else _tell):
            tried.keep(trial)
    finally:
        matrix = matrix_of(tried)
        if json:
            put_json(matrix)
        elif tried:
            say(f"{matrix.n} faults: {counted_outcomes(tried)}; {matrix.undetected} undetected")
    return 3 if matrix.undetected else 0


def _tell(trial: "FaultTrial") -> None:
    """Tell of a run with a fault, in a line."""
    where = "" if trial.line is None else f"“{trial.stage}”, line {trial.line}: "
    number = "" if trial.error is None else f"error {trial.error}: "
    say(f"{trial.name:32}  {trial.outcome:9}  {where}{number}{trial.message}".rstrip())
