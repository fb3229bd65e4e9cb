"""Commands that have the arm undo what it did: dismantle, and its trials."""

import shlex
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

from cyclopts import Parameter

from handeye.cli.batches import kept_batch, progress
from handeye.cli.common import Camera, Json, Out, TaskWords, WholeNumber, note, positive, put_json, screen
from handeye.cli.programs import check_task, made_known, plan_or_own
from handeye.cli.runs import Overwrite
from handeye.cli.world_options import ANY_ERRORS, WORLD, ErrorOptions, Faults, broken
from handeye.core.errors import CannotWrite, InvalidInput
from handeye.core.host_time import HostTimer
from handeye.core.plain_text import counted
from handeye.tasks import DEFAULT, option

if TYPE_CHECKING:
    from handeye.core.variation import WorldSpec
    from handeye.runs.snapshot import Checkpoint
    from handeye.trials.batch.dismantling import DismantlingTrial
    from handeye.trials.batch.row import Row

COUNT: Final = 20
"""Trials, if nobody says how many."""


def dismantle(
    path: Path,
    /,
    *,
    task: TaskWords = None,
    to: Annotated[
        str | None, Parameter(help="Go back to the beginning of this stage, and no farther.")
    ] = None,
    json: Json = False,
    out: Out = None,
    overwrite: Overwrite = False,
) -> int:
    """Have the arm undo what it did in a run: take the pump apart again.

    Every step is undone by the arm, the last one first: by the way it has gone, with what the hand holds, under
    guards. Where the hand meets more force than it should, or holds something else than then, the brakes are set and
    the operator is called. The folder of the run stays as it is.

    Exit code 0: everything is back where the run found it, or undone as far as was asked for; 1: a guard
    stopped it; 3: it is undone, and the referee disagrees; 2: bad input; 130: interrupted.

    Parameters
    ----------
    path
        The folder of a run, or a checkpoint of it.
    """
    from handeye.cli.job import Job, work
    from handeye.debugger.breakpoints import stage_number
    from handeye.runs.systems import listing_of
    from handeye.runs.undo_orders import to_be_undone

    _check_apart(path, out)
    wanted = made_known(task)
    kept = _newest(path)
    check_task(wanted, kept.setup.task, path)
    stage = None if to is None else stage_number(to, listing_of(kept.setup))
    start = to_be_undone(kept, str(path), stage)
    return work(Job(start=start, out=out, overwrite=overwrite, json=json, referee=True, on_stop="abort"))


def _check_apart(path: Path, out: Path | None) -> None:
    """Raises InvalidInput if the dismantling would be kept in the folder of the run, which stays as it is."""
    from handeye.runs.folder import CHECKPOINTS

    run = path.parent.parent if path.parent.name == CHECKPOINTS else path
    if out is not None and run.is_dir() and run.resolve() in (out.resolve(), *out.resolve().parents):
        raise CannotWrite(f"--out {out}: {path} stays as it is; keep its dismantling in another folder")


def _newest(path: Path) -> "Checkpoint":
    """The checkpoint in a file, or a run's folder as the run has left it; what is left out is told.

    Raises:
        InvalidInput: there is none.
    """
    from handeye.runs.checkpoint_file import read_checkpoint
    from handeye.runs.folder import EVENTS, open_again
    from handeye.runs.undo_orders import caught_up, done_since
    from handeye.trace.eventlist import effective, read_events

    if not path.is_dir():
        return read_checkpoint(path)
    _, start, faults = open_again(path)
    for fault in faults:
        note(f"left out: {fault}")
    try:
        events = effective(read_events(path / EVENTS, growing=True))
    except InvalidInput as fault:
        note(f"left out: {fault}")
        return start
    more = done_since(start, events)
    if more is None:
        note(f"left out: {path / EVENTS}, which is not of the run in the checkpoints of {path}")
    elif more:
        note(f"carrying out again {counted(more, 'step')} that no checkpoint of {path} holds")
    return caught_up(start, events, str(path))


def dismantling_trials(
    *,
    n: Annotated[WholeNumber, Parameter(help="How many trials.")] = COUNT,
    seed: Annotated[
        WholeNumber, Parameter(group=WORLD, help="World of trial 0; trial K has a number greater by K.")
    ] = 0,
    errors: ErrorOptions = ANY_ERRORS,
    fault: Faults = None,
    plan: Annotated[
        Path | None,
        Parameter(
            help="A plan made by `handeye plan`, or the name of a program; by default that of the task."
        ),
    ] = None,
    to: Annotated[
        str | None, Parameter(help="Build as far as the end of this stage, and take that apart.")
    ] = None,
    workers: Annotated[WholeNumber, Parameter(name=["--workers", "--jobs"], help="Trials at a time.")] = 2,
    camera: Camera = "auto",
    out: Annotated[
        Path | None,
        Parameter(
            help="Folder of the batch: a line is written to it as each trial ends, and the same command goes on where "
            "it was broken off."
        ),
    ] = None,
    json: Json = False,
) -> int:
    """Assemble in many worlds, have the arm take each apart again, and count how often everything is where it was.

    Trials in which nothing was built are told, and do not count.

    Exit code 0: no silent failure; 3: in some world all was undone and the referee disagreed; 2: bad input; 130:
    interrupted.
    """
    from handeye.cli.batch_text import dismantling_page
    from handeye.debugger.breakpoints import stage_number
    from handeye.trials.batch.batch import carry_out, jobs_of
    from handeye.trials.batch.dismantling import DismantlingTrial, dismantling_figures
    from handeye.trials.batch.engines import processes

    timer = HostTimer()
    positive(n, "trial")
    positive(workers, "worker")
    senses, errors = errors.senses, errors.errors()
    record = plan_or_own(plan, errors.task)
    errors = errors.of(record.task)
    errors.spec(seed + n - 1)
    world = broken(errors.spec(seed), fault, errors.work, record.program)
    stage = "" if to is None else record.program.stages[stage_number(to, record.program)]
    trial = DismantlingTrial(plan=record, camera=camera, without=senses, to=stage)
    fresh: list[Row] = []
    with kept_batch(out, trial, world) as folder:
        kept = 0 if folder is None else len({*folder.rows} & {*range(n)})
        tell = progress(n, kept, timer, fresh, "apart")
        rows = carry_out(trial, jobs_of(world, range(n)), processes(workers), folder=folder, told=tell)
    found = dismantling_figures(rows, _again(trial, world, plan), wall_s=timer.wall_s)
    if json:
        put_json(found)
    else:
        screen.print(dismantling_page(found), soft_wrap=True)
    return 3 if found.silent_failures else 0


def _again(trial: "DismantlingTrial", world: "WorldSpec", plan: Path | None) -> "Callable[[Row], str]":
    """What tells the command that carries a trial out again."""
    from msgspec.structs import replace

    from handeye.report.facts.again import sense_words, world_words

    made = sense_words(trial.without) + ([] if trial.camera == "auto" else ["--camera", trial.camera])
    made += ([] if plan is None else ["--plan", str(plan)]) + (["--to", trial.to] if trial.to else [])
    task = trial.plan.task
    made += option(task) or (["--task", task] if plan is None and task != DEFAULT else [])

    def command(row: "Row") -> str:
        words = world_words(replace(world, seed=row.seed), task)
        return shlex.join(["handeye", "trials", "dismantling", "--n", "1", *words, *made])

    return command
