"""The command that tries faults, one per run, and reports each outcome and whether the program notices the fault."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import msgspec
from cyclopts import Parameter

from handeye.cli.common import Camera, WholeNumber, camera_here, positive, put, screen
from handeye.cli.programs import plan_or_own
from handeye.cli.seeds import Seeds, following, seeds_of
from handeye.cli.sweeps import ANY, SweepOptions, carry_out_sweep
from handeye.cli.tally import Tally
from handeye.cli.world_options import ANY_WORLD, WorldOptions, stage_of
from handeye.core.entries import entries, loaded
from handeye.core.errors import BadArgument
from handeye.runs.setup import Setup

if TYPE_CHECKING:
    from handeye.core.faults import Catalogue, FaultKind


def faults(
    *,
    only: Annotated[
        list[str] | None,
        Parameter(help="Try only this fault or group of faults; may be repeated.", consume_multiple=False),
    ] = None,
    every: Annotated[
        bool, Parameter(name="--all", help="Try all faults, not only the standard set (the matrix).")
    ] = False,
    listed: Annotated[
        bool, Parameter(name="--list", help="List the faults and the expected outcome of each; run nothing.")
    ] = False,
    stage: Annotated[
        str | None,
        Parameter(
            help="Stage at which each fault begins; only for faults that can begin during the work. Default: "
            "the usual stage of each fault."
        ),
    ] = None,
    n: Annotated[
        WholeNumber | None,
        Parameter(
            name="--n",
            help="Number of worlds. Their seeds are consecutive and begin with --seed. Each fault is tried in each "
            "world. Default: 1.",
        ),
    ] = None,
    seeds: Seeds = None,
    checkpoints: Annotated[
        Path | None,
        Parameter(
            help="Folder that keeps, for each world, one run without faults; a missing run is made first. If a "
            "fault begins after the first stage, its trial starts at the stage of the fault, from a checkpoint of "
            "this run. Default: each trial is a whole run. The outcomes are the same with and without this folder."
        ),
    ] = None,
    world: WorldOptions = ANY_WORLD,
    camera: Camera = "auto",
    options: SweepOptions = ANY,
) -> int:
    """Assemble once with each fault of a standard set, at its usual size, and report which faults the program
    noticed.

    Good outcomes: the program `recovered`, or it `stopped` in the right stage, with the brakes on, and named the
    fault. Less good: the program stopped but named another fault (`misnamed`). Bad outcomes, counted as undetected:
    the program should have noticed the fault and did not (`unnoticed`), it stopped without setting the brakes
    (`unbraked`), or it reported success although the pump is wrong (`silent`).

    A whole run takes one to three CPU minutes; the time left is shown on standard error. Ctrl-C stops the command and
    prints the runs that have finished. If you gave --out, repeat the command to continue. To add runs with other
    faults in the same worlds, give the command again with these faults and the same folder.

    Exit code 0: every fault was detected; 1: no trial finished; 3: a fault was undetected; 2: bad input; 130:
    interrupted.
    """
    from handeye.trials.faults import FAULTS, FaultWork, chosen, usual, with_panic
    from handeye.trials.folder import head_of
    from handeye.trials.sweep import Case

    first = world.seed if world.file is None else world.spec.seed
    chosen_seeds = seeds_of(n, first, seeds, usual=1)
    spec = (world.errors.spec if world.file is None else world.noisy)(chosen_seeds[0])
    own = _own_trials(world.work.name)
    catalogue = world.work.faults(spec) if own else with_panic(world.work.faults(spec))
    if every and only:
        raise BadArgument("--all cannot be given with --only")
    if listed and (stage is not None or options.out is not None):
        raise BadArgument("--list runs nothing: leave out --stage and --out")
    positive(options.jobs, "worker")
    everything = every or (listed and not only)
    kinds = chosen(catalogue, tuple(catalogue.kinds) if everything else only or ())
    if listed:
        return _list(catalogue, kinds, json=options.json)
    options.check()
    if own:
        foreign = {"--stage": stage, "--checkpoints": checkpoints, "--camera": camera}
        option = next((name for name, value in foreign.items() if value not in (None, "auto")), None)
        if option is not None:
            raise BadArgument(f"{option} is for programs of the Stanford arm; leave it out for this task")
        sweep, work = loaded(own)(world.work.name, spec)
        return carry_out_sweep(
            sweep,
            work,
            [
                Case(trials=(k,), seed=s, condition=each.name)
                for each in kinds
                for k, s in enumerate(chosen_seeds)
            ],
            head_of(sweep, spec, seeds=() if following(chosen_seeds) else tuple(chosen_seeds)),
            options,
            title=f"{world.work.name} with one fault at a time, in worlds from {spec} on",
        )
    plan, camera = plan_or_own(None, world.task), camera_here(camera)
    first = None if stage is None else stage_of(plan.program)(stage)
    given = usual(catalogue, kinds, first, len(plan.program.stages))
    if checkpoints is not None:
        _sound(Setup(plan=plan, world=spec, camera=camera), checkpoints, chosen_seeds, options.jobs)
    return carry_out_sweep(
        FAULTS,
        FaultWork(plan=plan, world=spec, faults=given, camera=camera, sound=checkpoints),
        [
            Case(trials=(k,), seed=each, condition=name)
            for name in given
            for k, each in enumerate(chosen_seeds)
        ],
        head_of(
            FAULTS, spec, plan, camera=camera, seeds=() if following(chosen_seeds) else tuple(chosen_seeds)
        ),
        options,
        title=f"{plan.program.name} with one fault at a time, in worlds from {spec} on",
        plan=plan,
    )


def _own_trials(task: str) -> str:
    """The import path of the fault trials that the system of a task defines; empty if it defines none."""
    return next((entry.faults for entry in entries().values() if task in entry.tasks), "")


def _sound(setup: Setup, folder: Path, seeds: Sequence[int], jobs: int) -> None:
    """Execute the fault-free runs that are not yet in the folder."""
    from handeye.trials.sound_run import sound_runs

    worlds = [msgspec.structs.replace(setup.world, seed=seed) for seed in seeds]
    for _ in Tally(len(worlds), "worlds finished").counting(sound_runs(setup, folder, worlds, jobs)):
        pass


def _list(catalogue: "Catalogue", kinds: "list[FaultKind]", *, json: bool) -> int:
    from handeye.results.faults_page import faults_json, faults_page

    if json:
        put(faults_json(catalogue, kinds))
    else:
        screen.print(faults_page(catalogue, kinds, screen.width))
    return 0
