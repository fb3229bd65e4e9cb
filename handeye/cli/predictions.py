"""The command that predicts many worlds without simulating any, and simulates the worst of them."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

from cyclopts import Parameter

from handeye.cli.batches import command_of, kept_batch, progress
from handeye.cli.common import Camera, Json, WholeNumber, compiled, note, positive, put_json, screen
from handeye.cli.world_options import ANY_ERRORS, WORLD, ErrorOptions
from handeye.core.errors import BadArgument, Refused
from handeye.core.host_time import HostTimer
from handeye.core.plain_text import counted
from handeye.planfile.store import read_plan
from handeye.runs.scripts import default_script

if TYPE_CHECKING:
    from collections.abc import Sequence

    from handeye.core.variation import WorldSpec
    from handeye.planfile.plan import Plan
    from handeye.program.senses import Sense
    from handeye.trials.batch.row import Row
    from handeye.trials.prediction.figures import PredictionFigures
    from handeye.trials.prediction.predicting import Prediction

WORLDS: Final = 10_000
WORST: Final = 100
TOLD: Final = 2500
"""Worlds between two lines of progress."""


def predict_trials(
    *,
    n: Annotated[WholeNumber | None, Parameter(help=f"How many worlds; by default {WORLDS}.")] = None,
    seed: Annotated[
        WholeNumber | None,
        Parameter(group=WORLD, help="The first world, by default 0; the next has a number greater by 1."),
    ] = None,
    errors: ErrorOptions = ANY_ERRORS,
    plan: Annotated[
        Path | None, Parameter(help="A plan made by `handeye plan`; by default that of the water pump.")
    ] = None,
    worst: Annotated[
        WholeNumber, Parameter(help="How many of the worst worlds are told, or simulated.")
    ] = WORST,
    simulate: Annotated[
        bool, Parameter(negative=(), help="Carry the worst worlds out as whole trials, and count what fails.")
    ] = False,
    against: Annotated[
        Path | None,
        Parameter(help="Folder of a batch: its worlds are predicted, and compared with its trials."),
    ] = None,
    workers: Annotated[WholeNumber, Parameter(name=["--workers", "--jobs"], help="Processes at a time.")] = 2,
    camera: Camera = "auto",
    out: Annotated[
        Path | None,
        Parameter(
            help="Folder for the figures as tables, `prediction`, and the trials, `trials`: a batch, which the same "
            "command goes on with where it was broken off."
        ),
    ] = None,
    json: Json = False,
) -> int:
    """Predict by kinematics and tolerances how near many worlds come to failing, and simulate the worst.

    For each contact operation: how far off the hand, or what it holds, will be where it should go, by what the joints
    read wrong there, where things truly stand, and what the program has felt and saved before; and how far off it may
    be. Nothing is simulated, so that ten thousand worlds take seconds.

    Exit code 0; 3: of the worlds that were simulated, some failed silently; 2: bad input; 130: interrupted.
    """
    from handeye.cli.prediction_text import page
    from handeye.trials.prediction.figures import figures, worst_of

    worlds = WORLDS if n is None else n
    for count, what in ((worlds, "world"), (worst, "world"), (workers, "process")):
        positive(count, what)
    if against is not None and (simulate or plan is not None):
        raise BadArgument("--against takes plan and trials of its folder: leave --plan and --simulate out")
    if against is not None and (n is not None or seed is not None or errors != ANY_ERRORS):
        raise BadArgument(
            "--against takes the worlds of its folder: leave --n, --seed, --level, --without and --set out"
        )
    timer = HostTimer()
    asked = _asked(worlds, seed or 0, errors, plan) if against is None else _of_batch(against)
    found = _predicted(asked, workers)
    command = command_of(asked.world, plan, camera, asked.without)
    rows = asked.rows
    if simulate:
        rows = _simulated(asked, worst_of(found, worst), camera, workers, out)
    made = figures(found, command, worst=worst, rows=rows, wall_s=timer.wall_s)
    if out is not None:
        _leave(out / "prediction", found, made)
    if json:
        put_json(made)
    else:
        screen.print(page(made), soft_wrap=True)
    return 3 if simulate and made.outcome is not None and made.outcome.silent else 0


@dataclass(frozen=True, slots=True, kw_only=True)
class _Asked:
    """What is to be predicted, and whole trials that are there already."""

    plan: "Plan"
    world: "WorldSpec"
    seeds: "Sequence[int]"
    without: "tuple[Sense, ...]"
    rows: "Sequence[Row]" = ()


def _asked(n: int, seed: int, errors: ErrorOptions, plan: Path | None) -> _Asked:
    senses, options = errors.senses, errors.errors()
    options.spec(seed + n - 1)
    record = compiled(default_script()) if plan is None else read_plan(plan)
    return _Asked(plan=record, world=options.spec(seed), seeds=range(seed, seed + n), without=senses)


def _of_batch(folder: Path) -> _Asked:
    from handeye.trials.batch.folder import read_batch, read_plan_of

    head, rows = read_batch(folder)
    if not rows:
        raise Refused(f"no trial of the batch in {folder} has ended")
    seeds = [row.seed for row in rows]
    return _Asked(
        plan=read_plan_of(folder, head), world=head.world, seeds=seeds, without=head.without, rows=rows
    )


def _predicted(asked: _Asked, workers: int) -> "Prediction":
    """The prediction; progress is told."""
    from handeye.trials.prediction.predicting import predict

    timer, count = HostTimer(), len(asked.seeds)

    def tell(done: int) -> None:
        if done % TOLD == 0 or done == count:
            note(f"{done:6} of {counted(count, 'world')} predicted, {timer.wall_s:.0f} s")

    return predict(
        asked.plan.program,
        asked.world,
        asked.seeds,
        without=asked.without,
        workers=_useful(workers, count),
        told=tell,
    )


def _useful(workers: int, worlds: int) -> int:
    """As many processes as there is work for."""
    from handeye.trials.prediction.predicting import CHUNK

    return min(workers, -(-worlds // CHUNK))


def _simulated(
    asked: _Asked, numbers: "Sequence[int]", camera: str, workers: int, out: Path | None
) -> "Sequence[Row]":
    """Whole trials of some of the worlds, kept as a batch."""
    from handeye.trials.batch.batch import carry_out, jobs_of
    from handeye.trials.batch.engines import processes
    from handeye.trials.batch.trial import Trial

    timer, fresh, world = HostTimer(), list["Row"](), asked.world
    trial = Trial(plan=asked.plan, camera=camera, without=asked.without)
    with kept_batch(None if out is None else out / "trials", trial, world) as folder:
        there = 0 if folder is None else len({*folder.rows} & {*numbers})
        tell = progress(len(numbers), there, timer, fresh)
        return carry_out(trial, jobs_of(world, numbers), processes(workers), folder=folder, told=tell)


def _leave(folder: Path, found: "Prediction", made: "PredictionFigures") -> None:
    from handeye.trace.table_files import write_tables
    from handeye.trials.prediction.tables import tables

    folder.parent.mkdir(parents=True, exist_ok=True)
    write_tables(folder, tables(found, made), "csv", "Figures are in the unit of their column")
