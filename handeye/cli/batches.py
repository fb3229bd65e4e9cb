"""Commands that run plans in many worlds, and that compare batches of trials."""

import shlex
from collections.abc import Callable
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final, Literal

from cyclopts import Parameter

from handeye.cli.common import (
    Camera,
    Json,
    WholeNumber,
    camera_here,
    positive,
    put_json,
    screen,
)
from handeye.cli.programs import plan_or_own
from handeye.cli.seeds import Seeds, following, seeds_of
from handeye.cli.sweeps import ANY, FirstSeed, SweepOptions, carry_out_sweep
from handeye.cli.world_options import ANY_ERRORS, ErrorOptions, Faults, broken
from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, Refused
from handeye.core.plain_text import counted
from handeye.runs.operator import parse_policy
from handeye.tasks import DEFAULT, option, planned

if TYPE_CHECKING:
    from handeye.trials.plans.row import Row
    from handeye.trials.plans.trial import Trial
    from handeye.trials.sweep import Engine

COUNT: Final = 20
PlanOption = Annotated[
    Path | None,
    Parameter(
        name="--plan",
        help="A plan made by `handeye plan`, or the name of a program. Default: the program of the task.",
    ),
]


def assembly_trials(
    *,
    n: Annotated[WholeNumber | None, Parameter(help=f"Number of trials. Default: {COUNT}.")] = None,
    seed: FirstSeed | None = None,
    seeds: Seeds = None,
    errors: ErrorOptions = ANY_ERRORS,
    fault: Faults = None,
    plan: PlanOption = None,
    only: Annotated[WholeNumber | None, Parameter(help="Run only trial K (the first is 0).")] = None,
    engine: Annotated[
        Literal["process", "dask"],
        Parameter(help="Where trials run: in processes on this computer, or on dask workers."),
    ] = "process",
    scheduler: Annotated[
        str | None,
        Parameter(
            help="With --engine dask: address of a scheduler. Default: start workers on this computer."
        ),
    ] = None,
    camera: Camera = "auto",
    on_stop: Annotated[
        str,
        Parameter(
            help="How to answer when the program calls the operator: `abort`, `retry:N`, `unwind` or "
            "`unwind:STAGE`, as for `handeye assemble`."
        ),
    ] = "abort",
    simulated_limit: Annotated[
        float, Parameter(help="Simulated seconds after which a trial ends unfinished.")
    ] = 3600.0,
    cpu_limit: Annotated[
        float,
        Parameter(
            help="CPU seconds after which a trial ends unfinished. While the computer sleeps or does other work, no "
            "time is counted."
        ),
    ] = 1800.0,
    options: SweepOptions = ANY,
) -> int:
    """Assemble in many worlds, to learn the success rate with its confidence interval, and what failed where.

    The figures are the same for any number of processes. A trial whose process is killed is repeated once. A trial
    that raises an exception counts as a failure. Trials that ended because this computer failed are repeated when the
    batch continues. With --out, the command also writes figures.html, a page with the figures, into the folder of the
    batch.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure: in some world, the program reported
        success but the referee disagreed; 2: bad input; 130: interrupted.
    """
    from handeye.trials.plans.trial import ASSEMBLY, Trial
    from handeye.trials.sweep import Case

    if options.tables is not None and options.folder is None:
        raise BadArgument("--tables needs --out, the folder to which the tables are written")
    if scheduler is not None and engine != "dask":
        raise BadArgument("--scheduler needs --engine dask")
    chosen = seeds_of(n, seed, seeds, usual=COUNT)
    numbers = _numbers(len(chosen), only)
    positive(options.jobs, "worker")
    for limit in (simulated_limit, cpu_limit):
        if not 0 < limit < inf:
            raise BadArgument(f"a time limit must be more than 0 s, not {limit:g}")
    if plan is None:
        errors.check(chosen[0])
    record = plan_or_own(plan, errors.task)
    errors, spared = errors.of(record.task).apart(record.program.calls)
    world = broken(errors.spec(chosen[0]), fault, errors.work, record.program)
    planned(errors.work).check_arm(record)
    if parse_policy(on_stop, record.program.stages) is None:
        raise BadArgument(
            "a batch cannot ask the operator: --on-stop takes abort, retry:N, unwind or unwind:STAGE"
        )
    trial = Trial(
        plan=record,
        world=world,
        camera=camera_here(camera),
        without=spared,
        on_stop=on_stop,
        simulated_limit_s=simulated_limit,
        cpu_limit_s=cpu_limit,
    )
    where = (
        f"worlds from {world} on"
        if following(chosen)
        else f"{counted(len(chosen), 'world')} given by --seeds, beginning with {world}"
    )
    lacking = f", without {', '.join(spared)}" if spared else ""
    answered = "" if on_stop == "abort" else f", with {on_stop} as the answer to each call to the operator"
    command = ["assemble"] if plan is None else ["run", str(plan), "--judge"]
    return carry_out_sweep(
        ASSEMBLY,
        trial,
        [Case(trials=(k,), seed=chosen[k]) for k in numbers],
        trial.head(ASSEMBLY, seeds=() if following(chosen) else tuple(chosen)),
        options,
        title=f"{record.program.name} in {where}{lacking}{answered}",
        plan=record,
        again=_again(
            trial,
            command + _task_words(record.task, plan),
            [] if on_stop == "abort" else ["--on-stop", on_stop],
        ),
        engine=trial_engine(engine, options.jobs, scheduler, cpu_limit),
    )


def trial_engine(name: str, jobs: int, scheduler: str | None, cpu_limit_s: float | None = None) -> "Engine":
    """The engine that runs trials."""
    from handeye.trials.sweep import processes

    if name == "process":
        return processes(jobs, cpu_limit_s)
    from handeye.trials.dask_engine import dask_workers

    return dask_workers(jobs, scheduler)


def dismantling_trials(
    *,
    n: Annotated[WholeNumber, Parameter(help="Number of trials.")] = COUNT,
    seed: FirstSeed = 0,
    errors: ErrorOptions = ANY_ERRORS,
    fault: Faults = None,
    plan: PlanOption = None,
    to: Annotated[
        str | None, Parameter(help="Assemble up to the end of this stage, and take apart what was assembled.")
    ] = None,
    camera: Camera = "auto",
    options: SweepOptions = ANY,
) -> int:
    """Assemble in many worlds, make the arm take each pump apart again, and count how often every part is back in
    place.

    Trials in which the assembly does not succeed are listed but not counted.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure: in some world, the program reported
    everything undone but the referee disagreed; 2: bad input; 130: interrupted.
    """
    from handeye.debugger.breakpoints import stage_number
    from handeye.trials.plans.trial import DISMANTLING, DismantlingTrial
    from handeye.trials.sweep import cases, processes

    positive(n, "trial")
    positive(options.jobs, "worker")
    if plan is None:
        errors.check(seed)
    record = plan_or_own(plan, errors.task)
    errors, spared = errors.of(record.task).apart(record.program.calls)
    if not errors.work.judges_apart:
        raise Refused(f"the referee of the task {quoted(record.task)} cannot judge what the arm has undone")
    world = broken(errors.spec(seed), fault, errors.work, record.program)
    stage = "" if to is None else record.program.stages[stage_number(to, record.program)]
    trial = DismantlingTrial(plan=record, world=world, camera=camera_here(camera), without=spared, to=stage)
    built = f"up to {stage}" if stage else "completely"
    made = ([] if plan is None else ["--plan", str(plan)]) + (["--to", stage] if stage else [])
    return carry_out_sweep(
        DISMANTLING,
        trial,
        cases(world.seed, range(n)),
        trial.head(DISMANTLING),
        options,
        title=f"{record.program.name} assembled {built} and taken apart, in worlds from {world} on",
        plan=record,
        again=_again(trial, ["trials", "dismantling", "--n", "1"], made + _task_words(record.task, plan)),
        engine=processes(options.jobs, trial.cpu_limit_s),
    )


def compare_trials(
    first: Annotated[Path, Parameter(help="Folder of the first batch.")],
    /,
    *others: Annotated[
        Path, Parameter(help="Folders of the batches to compare with the first batch.", json_list=False)
    ],
    json: Json = False,
) -> int:
    """Compare one or more batches of trials with the first batch, world by world, to see how much a sensor, or an
    error of the world, changes the success rate.

    All batches must be of the same kind. Each comparison counts only the trials that are in both of its batches. `p`
    is the p-value of McNemar's exact test. The test uses only the trials that succeeded in one batch and failed in the
    other. `p` is the probability that chance alone splits these trials between the two batches at least as unevenly as
    they were split.
    """
    from handeye.trials.comparing import paired
    from handeye.trials.folder import read_batch

    if not others:
        raise BadArgument("a comparison needs at least two batches; name another folder")
    names = [str(path) for path in (first, *others)]
    found = paired(names, [read_batch(path) for path in (first, *others)])
    if json:
        put_json(found)
    else:
        from handeye.trials.text import comparison

        screen.print(comparison(names[0], found), soft_wrap=True)
    return 0


def _numbers(count: int, only: int | None) -> range:
    """The trials to run."""
    if only is None:
        return range(count)
    if not 0 <= only < count:
        raise BadArgument(f"there is no trial {only}: this batch has trials 0 to {count - 1}")
    return range(only, only + 1)


def _task_words(task: str, plan: Path | None) -> list[str]:
    return [*option(task)] or (["--task", task] if plan is None and task != DEFAULT else [])


def _again(trial: "Trial", command: list[str], options: list[str]) -> "Callable[[Row], str]":
    """Return a function that takes a row and returns the command that repeats the trial of this row."""
    from msgspec.structs import replace

    from handeye.report.facts.again import sense_words, world_words

    made = [*sense_words(trial.without), "--camera", trial.camera]

    def told(row: "Row") -> str:
        words = world_words(replace(trial.world, seed=row.seed), trial.plan.task)
        return shlex.join(["handeye", *command, *words, *made, *options])

    return told
