"""Commands that run a program: assemble, run, resume."""

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

from handeye.cli.common import (
    Calibrate,
    Camera,
    Details,
    Json,
    NoKeep,
    Out,
    Overwrite,
    PlanFile,
    TaskWords,
    note,
)
from handeye.cli.programs import check_task, is_program, made_known, plan_at, plan_or_own
from handeye.cli.run_limits import at_stage, check_ahead, check_order, checkpoint_folder, stops_of
from handeye.cli.trace_files import RunOrCheckpoint, run_or_newest
from handeye.cli.world_options import ANY_WORLD, Faults, WorldOptions, broken
from handeye.core.errors import BadArgument
from handeye.core.plain_text import counted

if TYPE_CHECKING:
    pass

Then = Literal["dismantle", "assemble"]
To = Annotated[str | None, Parameter(help="Pause after this stage.")]
Until = Annotated[
    str | None,
    Parameter(
        help="Pause before this step, given by its number in `handeye stages`, or by its label in the script."
    ),
]
Break = Annotated[
    list[str] | None,
    Parameter(
        name="--break", consume_multiple=False,
        help="Pause at a label, a stage, a line (58, or pins.al:3), an instruction, or on `error:N`; "
        "may be repeated.",
    ),
]  # fmt: skip
Step = Annotated[
    bool,
    Parameter(help=("Step through the run with commands that you type, or that standard input provides.")),
]
Live = Annotated[
    bool,
    Parameter(
        help="With --step and piped commands: print each line of the program as the line begins, and accept the "
        "commands `pause` and `pace` during the run, as on a terminal. Send each command only after the answer to "
        "the previous one."
    ),
]
OnStop = Annotated[
    str | None,
    Parameter(
        help="How to answer when the program calls the operator. `abort` ends the run. `retry:N` repeats the "
        "failed stage, each stage at most N times. `unwind:STAGE` makes the arm undo its work back to the "
        "beginning of STAGE and try again, at most once for each stage that fails; `unwind` alone goes back "
        "to the beginning of the failed stage. `ask` asks you. Default: `ask` on a terminal, `abort` "
        "elsewhere."
    ),
]


def assemble(
    *,
    world: WorldOptions = ANY_WORLD,
    fault: Faults = None,
    json: Json = False,
    details: Details = False,
    out: Out = None,
    overwrite: Overwrite = False,
    no_keep: NoKeep = False,
    camera: Camera = "auto",
    report: Annotated[
        bool, Parameter(help="Also write report.html, a page about the run, into the folder of the run.")
    ] = False,
    calibrate: Calibrate = False,
    on_stop: OnStop = None,
    then: Annotated[
        list[Then] | None,
        Parameter(
            consume_multiple=False,
            help="What to do after the referee has accepted the pump. The first --then must be `dismantle`: the arm "
            "takes the pump apart. A second one, `assemble`, makes the arm assemble the pump again. You can repeat "
            "both in turn.",
        ),
    ] = None,
) -> int:
    """Assemble the water pump, or do another task with its own program: plan, run, judge.

    Exit code 0: assembled; 1: the program stopped and called the operator; 3: the program reported success, but the
    referee disagrees; 2: bad input; 130: interrupted.
    """
    from handeye.cli.job import Job, work
    from handeye.runs.setup import Setup
    from handeye.runs.snapshot import Checkpoint

    if any(part != ("dismantle", "assemble")[n % 2] for n, part in enumerate(then or ())):
        raise BadArgument("give --then dismantle and --then assemble in turn, beginning with dismantle")
    check_kept(no_keep, out)
    if report and no_keep:
        raise BadArgument(
            "--report writes a page into the folder of the run, but with --no-keep there is no folder; leave out "
            "one of these two options"
        )
    world.check()
    started = time.process_time()
    plan = plan_or_own(None, world.task)
    planning = time.process_time() - started
    world, spared = world.apart(plan.program.calls)
    spec, done = world.spec, world.work
    setup = Setup(
        plan=plan, world=broken(spec, fault, done, plan.program), camera=camera, judged=True, without=spared
    )
    return work(
        Job(
            start=Checkpoint(setup=setup),
            out=out,
            keep=not no_keep,
            overwrite=overwrite,
            calibrate=calibrate,
            on_stop=on_stop,
            json=json,
            details=details,
            report=report,
            referee=True,
            then=then or (),
            planning_cpu_s=planning,
        )
    )


def run(
    file: PlanFile,
    /,
    *,
    world: WorldOptions = ANY_WORLD,
    fault: Faults = None,
    world_of: Annotated[
        Path | None,
        Parameter(
            help="Use the world, the faults and the renderer of this recorded run, given by its folder or "
            "trace."
        ),
    ] = None,
    judge: Annotated[
        bool | None,
        Parameter(
            negative="--no-judge",
            help="Have the referee judge the result; the referee knows the true state of the cell. Default: only if "
            "the plan is given by the name of a program.",
        ),
    ] = None,
    json: Json = False,
    details: Details = False,
    out: Out = None,
    overwrite: Overwrite = False,
    no_keep: NoKeep = False,
    camera: Camera = "auto",
    calibrate: Calibrate = False,
    first: Annotated[str | None, Parameter(name="--from", help="Begin with this stage.")] = None,
    to: To = None,
    stage: Annotated[str | None, Parameter(help="Run only this stage.")] = None,
    until: Until = None,
    breaks: Break = None,
    step: Step = False,
    live: Live = False,
    checkpoints: Annotated[
        Path | None,
        Parameter(
            help="Folder of checkpoints, or of a run: --from and --stage begin from the checkpoints in this folder, "
            "and new checkpoints are saved there."
        ),
    ] = None,
    on_stop: OnStop = None,
) -> int:
    """Run a plan, or some of its stages, in the work cell of its task: straight through or step by step.

    Give a stage by its number, its name, or part of its name. A run that does not begin with the first stage starts
    from a checkpoint. If this checkpoint is missing, the earlier stages run first.

    Exit code 0: the program finished, or paused where asked; 1: the program stopped and called the operator; 3: the
    program reported success, but the referee (if it judges the run) disagrees; 2: bad input, or a piped --step command
    was refused; 130: interrupted.
    """
    from handeye.cli.job import Job, work
    from handeye.cli.recorded_worlds import in_world_of
    from handeye.runs.setup import Setup
    from handeye.runs.snapshot import Checkpoint

    _check_live(live, step)
    check_kept(no_keep, out)
    plan, judge = plan_at(file, world.task), is_program(file) if judge is None else judge
    wanted = world
    world, spared = world.of(plan.task).apart(plan.program.calls)
    if stage is not None and (first is not None or to is not None):
        raise BadArgument("--stage cannot be given with --from or --to")
    if world_of is None:
        spec = broken(world.spec, fault, world.work, plan.program)
        setup = Setup(plan=plan, world=spec, camera=camera, judged=judge, without=spared)
    elif wanted.chosen or fault or camera != "auto":
        others = "--seed, --world, --level, --without, --set, --scale, --fault and --camera"
        raise BadArgument(f"{world_of} has its own world; {others} cannot be given with --world-of")
    else:
        setup = in_world_of(world_of, plan, judged=judge)
    start = Checkpoint(setup=setup)
    stops = stops_of(plan.program, to=to if stage is None else stage, until=until, breaks=breaks or [])
    check_order(plan.program, first, to)
    kept = checkpoint_folder(checkpoints, out)
    if stage is not None or first is not None:
        start = at_stage(start, (first if stage is None else stage) or "", kept, out)
    check_ahead(start, stops, breaks or [])
    if checkpoints is not None and kept is not None and not kept.exists():
        note(f"created {kept} for the checkpoints")
    return work(
        Job(
            start=start,
            out=out,
            keep=not (no_keep or step or checkpoints),
            overwrite=overwrite,
            calibrate=calibrate,
            checkpoints=None if checkpoints is None else kept,
            stops=stops,
            breaks=breaks or (),
            halfway=not step and bool(breaks or until),
            step=step,
            live=live,
            on_stop=on_stop,
            json=json,
            details=details,
            referee=judge,
        )
    )


def resume(
    run: RunOrCheckpoint = None,
    /,
    *,
    task: TaskWords = None,
    judge: Annotated[
        bool | None,
        Parameter(
            negative="--no-judge",
            help="Have the referee judge the result. Default: as chosen when the run began.",
        ),
    ] = None,
    json: Json = False,
    details: Details = False,
    out: Annotated[
        Path | None,
        Parameter(name=["--out", "-o"], help="Folder to save the run in, if PATH is a checkpoint file."),
    ] = None,
    overwrite: Overwrite = False,
    to: To = None,
    until: Until = None,
    breaks: Break = None,
    step: Step = False,
    live: Live = False,
    on_stop: OnStop = None,
) -> int:
    """Resume an interrupted run.

    If the run has ended, the command shows its result and changes nothing; with `--step` you can go back in the run.

    If PATH is the folder of a run, the run continues from the newest valid checkpoint in the folder. The exit codes
    are those of `handeye run`.
    """
    from handeye.cli.job import Job, work
    from handeye.cli.reports import shown
    from handeye.results.kept_run import has_ended
    from handeye.runs.checkpoint_file import read_checkpoint
    from handeye.runs.folder import CHECKPOINTS, PLAN, open_again
    from handeye.runs.systems import listing_of

    _check_live(live, step)
    folder, wanted_task = None, made_known(task)
    path = run_or_newest(run)
    if path.name == CHECKPOINTS and (path.parent / PLAN).is_file():
        path = path.parent
    if path.is_dir():
        if out is not None:
            raise BadArgument(
                f"leave out --out: {path} is the folder of a run, and a run resumes in its own folder; --out is for "
                "checkpoint files"
            )
        folder, start, faults = open_again(path)
        for fault in faults:
            note(f"left out: {fault}")
    else:
        start = read_checkpoint(path)
    check_task(wanted_task, start.setup.task, path)
    stops = stops_of(listing_of(start.setup), to=to, until=until, breaks=breaks or [])
    check_order(listing_of(start.setup), start.stage, to)
    check_ahead(start, stops, breaks or [])
    wanted = start.setup.judged if judge is None else judge
    if folder is not None and not step and has_ended(folder.path, start, judged=wanted):
        note(f"the run in {folder.path} has ended: there is nothing to resume")
        return shown(folder.path, json=json, details=details).result.exit_code
    done = "no steps" if start.position < 1 else counted(start.position, "step")
    stage = "its end" if start.stage is None and start.position > 0 else start.stage or "its beginning"
    note(f"resuming after {done}: {stage}")
    return work(
        Job(
            start=start,
            folder=folder,
            out=out,
            overwrite=overwrite,
            stops=stops,
            breaks=breaks or (),
            halfway=not step and bool(breaks or until),
            step=step,
            live=live,
            on_stop=on_stop,
            json=json,
            details=details,
            referee=wanted,
        )
    )


def check_kept(no_keep: bool, out: Path | None) -> None:
    """Raises InvalidInput if both --no-keep and --out are given."""
    if no_keep and out is not None:
        raise BadArgument("--no-keep cannot be given with --out")


def _check_live(live: bool, step: bool) -> None:
    """Raises InvalidInput for --live without --step."""
    if live and not step:
        raise BadArgument(
            "--live needs --step: it prints each line of the program when the run begins this line"
        )
