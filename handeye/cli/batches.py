"""The command that assembles in many worlds and counts."""

import re
import shlex
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final, Literal

from cyclopts import Parameter

from handeye.cli.common import Camera, Json, WholeNumber, note, positive, put_json, screen
from handeye.cli.programs import plan_or_own
from handeye.cli.world_options import ANY_ERRORS, WORLD, ErrorOptions, Faults, broken
from handeye.core.errors import BadArgument
from handeye.core.files import check_place, write_over
from handeye.core.host_time import HostTimer
from handeye.core.plain_text import counted
from handeye.runs.operator import parse_policy
from handeye.tasks import DEFAULT, option, planned

if TYPE_CHECKING:
    from handeye.core.variation import WorldSpec
    from handeye.program.senses import Sense
    from handeye.trace.table_files import Format
    from handeye.trials.batch.engines import Engine
    from handeye.trials.batch.figures import Figures
    from handeye.trials.batch.folder import BatchFolder
    from handeye.trials.batch.row import Row, Verdict
    from handeye.trials.batch.trial import Trial

COUNT: Final = 20
"""Trials, if nobody says how many."""
PICTURED, TABLES = "figures.html", "tables"
"""What a batch leaves in its folder."""


def assembly_trials(
    *,
    n: Annotated[WholeNumber | None, Parameter(help=f"How many trials; by default {COUNT}.")] = None,
    seed: Annotated[
        WholeNumber | None,
        Parameter(group=WORLD, help="World of trial 0, by default 0; trial K has a number greater by K."),
    ] = None,
    seeds: Annotated[
        str | None,
        Parameter(help="The same as --seed and --n: a range such as 0-19, or one number."),
    ] = None,
    errors: ErrorOptions = ANY_ERRORS,
    fault: Faults = None,
    plan: Annotated[
        Path | None,
        Parameter(
            help="A plan made by `handeye plan`, or the name of a program; by default that of the task."
        ),
    ] = None,
    only: Annotated[WholeNumber | None, Parameter(help="Carry out trial K alone, from 0.")] = None,
    workers: Annotated[WholeNumber, Parameter(name=["--workers", "--jobs"], help="Trials at a time.")] = 2,
    engine: Annotated[
        Literal["process", "dask"],
        Parameter(help="What carries trials out: processes of this computer, or workers of dask."),
    ] = "process",
    scheduler: Annotated[
        str | None,
        Parameter(help="With --engine dask: address of a scheduler; by default, workers are begun here."),
    ] = None,
    camera: Camera = "auto",
    on_stop: Annotated[
        str,
        Parameter(
            help="How calls of the operator are answered: `abort`, `retry:N`, `unwind` or `unwind:STAGE`, as in "
            "`assemble`."
        ),
    ] = "abort",
    simulated_limit: Annotated[
        float, Parameter(help="Seconds of the cell's clock after which a trial counts as failed.")
    ] = 3600.0,
    wall_limit: Annotated[
        float, Parameter(help="Seconds of this computer after which a trial counts as failed.")
    ] = 1800.0,
    out: Annotated[
        Path | None,
        Parameter(
            help="Folder of the batch: a line is written to it as each trial ends, and the same command goes on where "
            "it was broken off."
        ),
    ] = None,
    tables: Annotated[
        Literal["csv", "parquet"] | None,
        Parameter(help="With --out: the figures as tables, in the folder `tables` there."),
    ] = None,
    json: Json = False,
) -> int:
    """Assemble in many worlds and count: how often, how sure that is, and what failed where.

    The figures are the same for any number of workers. A trial whose process is killed is tried once more; an
    exception counts as a failure. With --out the figures are drawn on a page, too: figures.html in the folder.

    Exit code 0: no silent failure; 1: every trial was broken off; 3: in some world the program said done and the
    referee disagreed; 2: bad input; 130: interrupted.
    """
    from handeye.trials.batch.batch import carry_out, jobs_of
    from handeye.trials.batch.figures import figures
    from handeye.trials.batch.trial import Trial

    if tables and out is None:
        raise BadArgument("--tables needs --out, the folder that they are left in")
    if scheduler is not None and engine != "dask":
        raise BadArgument("--scheduler goes with --engine dask")
    timer = HostTimer()
    chosen = _chosen(n, seed, seeds)
    numbers = _numbers(len(chosen), only)
    positive(workers, "worker")
    _limits(simulated_limit, wall_limit)
    senses, errors = errors.senses, errors.errors()
    record = plan_or_own(plan, errors.task)
    errors = errors.of(record.task)
    errors.spec(chosen[-1])
    world = broken(errors.spec(chosen[0]), fault, errors.work, record.program)
    planned(errors.work).check_arm(record)
    if parse_policy(on_stop, record.program.stages) is None:
        raise BadArgument(
            "nobody can be asked in a batch: --on-stop takes abort, retry:N, unwind or unwind:STAGE"
        )
    trial = Trial(
        plan=record,
        camera=camera,
        without=senses,
        on_stop=on_stop,
        simulated_limit_s=simulated_limit,
        wall_limit_s=wall_limit,
    )
    fresh: list[Row] = []
    with kept_batch(out, trial, world) as folder:
        if out is not None:
            _check_leaving(out, tables)
        tell = progress(len(numbers), 0 if folder is None else len({*folder.rows} & {*numbers}), timer, fresh)
        rows = carry_out(
            trial, jobs_of(world, numbers), _engine(engine, workers, scheduler), folder=folder, told=tell
        )
    again = command_of(world, plan, record.task, camera, senses, on_stop)
    found = figures(rows, lambda row: again(row.seed), fresh=fresh, wall_s=timer.wall_s)
    if out is not None:
        _leave(out, rows, found, tables, _title(trial, world))
    if json:
        put_json(found)
    else:
        from handeye.cli.batch_text import page

        screen.print(page(found), soft_wrap=True)
    return 3 if found.silent_failures else 1 if found.n == found.failed else 0


def _engine(name: str, workers: int, scheduler: str | None) -> "Engine":
    """What carries trials out."""
    from handeye.trials.batch.engines import processes

    if name == "process":
        return processes(workers)
    from handeye.trials.batch.dask_engine import dask_workers

    return dask_workers(workers, scheduler)


def _check_leaving(out: Path, tables: "Format | None") -> None:
    """Raises InvalidInput if page or tables of a batch cannot be left in its folder when the trials have ended."""
    from handeye.trace.table_files import check_tables
    from handeye.trials.batch.page import PAGE

    check_place(out / PICTURED, PAGE)
    if tables is not None:
        check_tables(out / TABLES, tables)


def _leave(out: Path, rows: "Sequence[Row]", found: "Figures", tables: "Format | None", title: str) -> None:
    """Leave the page of a batch in its folder, and its tables."""
    from handeye.trace.table_files import write_tables
    from handeye.trials.batch.page import PAGE, batch_page
    from handeye.trials.batch.tables import tables as tables_of

    write_over(out / PICTURED, batch_page(title, rows, found), PAGE)
    if tables is not None:
        units = "Figures are in the unit of their column"
        write_tables(out / TABLES, tables_of(rows, found), tables, units)


def _title(trial: "Trial", world: "WorldSpec") -> str:
    lacking = f", without {', '.join(trial.without)}" if trial.without else ""
    answered = "" if trial.on_stop == "abort" else f", with {trial.on_stop} where the operator is called"
    return f"{trial.plan.program.name} in worlds from {world} on{lacking}{answered}"


def compare_trials(
    first: Annotated[Path, Parameter(help="Folder of a batch.")],
    /,
    *others: Annotated[
        Path, Parameter(help="Folders of batches that are compared with it.", json_list=False)
    ],
    json: Json = False,
) -> int:
    """Compare batches with a first one, world by world: what a sense, or an error of the world, makes of the rate.

    Only seeds that both have count. `p` is of McNemar's exact test: how likely pairs that differ fall so unevenly if
    neither batch is better.
    """
    from handeye.trials.batch.comparing import paired
    from handeye.trials.batch.folder import read_batch

    if not others:
        raise BadArgument("at least two batches are compared; name another folder")
    names = [str(path) for path in (first, *others)]
    found = paired(names, [read_batch(path) for path in (first, *others)])
    if json:
        put_json(found)
    else:
        from handeye.cli.batch_text import comparison

        screen.print(comparison(names[0], found), soft_wrap=True)
    return 0


def _chosen(n: int | None, seed: int | None, seeds: str | None) -> range:
    """The seeds of a batch."""
    if seeds is None:
        first, count = seed or 0, COUNT if n is None else n
        positive(count, "trial")
        return range(first, first + count)
    if n is not None or seed is not None:
        raise BadArgument("--seeds says both: leave --n and --seed out, or --seeds")
    found = re.fullmatch(r"([0-9]{1,19})(?:-([0-9]{1,19}))?", seeds)
    first, last = (0, -1) if found is None else (int(found[1]), int(found[2] or found[1]))
    if last < first:
        raise BadArgument(f"seeds are given as a number or a range such as 0-19; {seeds!r} is neither")
    positive(last - first + 1, "trial")
    return range(first, last + 1)


def _numbers(count: int, only: int | None) -> range:
    """The trials to be carried out."""
    if only is None:
        return range(count)
    if not 0 <= only < count:
        raise BadArgument(f"there is no trial {only}: this batch has trials 0 to {count - 1}")
    return range(only, only + 1)


def _limits(*seconds: float) -> None:
    for limit in seconds:
        if not 0 < limit < inf:
            raise BadArgument(f"a limit of time is a number of seconds above 0; {limit:g} is not")


@contextmanager
def kept_batch(out: Path | None, trial: "Trial", world: "WorldSpec") -> "Iterator[BatchFolder | None]":
    """The folder of the batch, if one is wanted; what is in it is told also where trials are broken off."""
    from handeye.trials.batch.batch import head_of
    from handeye.trials.batch.folder import BatchFolder

    if out is None:
        yield None
        return
    folder = BatchFolder(out, head_of(trial, world), trial.plan)
    try:
        yield folder
    except BaseException:
        note(f"{counted(len(folder.rows), 'trial')} kept in {out}; the same command goes on from there")
        raise
    finally:
        folder.close()


def progress(
    count: int, kept: int, timer: HostTimer, rows: "list[Row]", right: "Verdict" = "assembled"
) -> "Callable[[Row], None]":
    """What tells of each trial as it ends: how it ended, the rate until now with its interval, and the time left."""
    from handeye.cli.batch_text import percent
    from handeye.trials.batch.rates import rate

    if kept:
        note(f"{kept} of {counted(count, 'trial')} are kept from before")

    def tell(row: "Row") -> None:
        rows.append(row)
        sure = rate(sum(each.verdict == right for each in rows), len(rows))
        assert sure.wilson95 is not None
        left = timer.wall_s / len(rows) * (count - kept - len(rows))
        note(
            f"{kept + len(rows):4} of {count}  seed {row.seed:4}  {row.verdict:9}  {sure.successes} of {sure.trials} "
            f"{right} ({percent(*sure.wilson95)}), {_left(left)} left{row.detail and '  '}{row.detail}"
        )

    return tell


def _left(seconds: float) -> str:
    return f"{seconds:.0f} s" if seconds < 100 else f"{seconds / 60:.0f} min"


def command_of(
    world: "WorldSpec",
    plan: Path | None,
    task: str,
    camera: str,
    senses: "tuple[Sense, ...]",
    on_stop: str = "abort",
) -> Callable[[int], str]:
    """What tells the command that carries the trial of a seed out."""
    from msgspec.structs import replace

    from handeye.report.facts.again import sense_words, world_words

    words = ["assemble"] if plan is None else ["run", str(plan), "--judge"]
    words += option(task) or (["--task", task] if plan is None and task != DEFAULT else [])
    made = sense_words(senses) + ([] if camera == "auto" else ["--camera", camera])
    made += [] if on_stop == "abort" else ["--on-stop", on_stop]

    def command(seed: int) -> str:
        return shlex.join(["handeye", *words, *world_words(replace(world, seed=seed), task), *made])

    return command
