"""The commands that teach, run, judge and undo the paper's two examples in worlds with errors, once or many
times."""

import shlex
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

from cyclopts import Parameter
from rich.status import Status

from handeye.cli.common import Json, Overwrite, WholeNumber, note, notes, positive, put_json, say
from handeye.cli.panic_button import PanicButton
from handeye.cli.sweeps import ANY, FirstSeed, SweepOptions, carry_out_sweep
from handeye.cli.videos import check_apart, filmed
from handeye.cli.world_options import ANY_OWN_ERRORS, Faults, OwnErrorOptions, broken
from handeye.core.errors import BadArgument
from handeye.core.host_time import HostTimer
from handeye.core.plain_text import counted
from handeye.core.variation import WorldSpec
from handeye.program.events import AnyEvent, StepStarted, UndoStarted
from handeye.runs.observer import Observer
from handeye.tasks import any_task

if TYPE_CHECKING:
    from handeye.runs.folder import RunFolder
    from handeye.runs.runner import Runner
    from handeye.runs.snapshot import Checkpoint
    from handeye.systems.trig.jobs.benches import JobName, TaughtJob
    from handeye.systems.trig.run.job import JobReport
    from handeye.systems.trig.run.job_video import JobVideo


Seed = Annotated[
    WholeNumber,
    Parameter(
        help=(
            "Seed of the world. The seed determines the errors of the teaching, of the machine and of the blocks."
        )
    ),
]


@Parameter(name="*")
@dataclass(frozen=True, slots=True, kw_only=True)
class KeptOptions:
    """Options that choose which records of a job are written."""

    out: Annotated[
        Path | None,
        Parameter(
            name=["--out", "-o"],
            help="Folder for the run: trace, checkpoints, result, outcome of the job (job.json), program, and "
            "report (report.html). `handeye resume` and `handeye dismantle` continue the run in this folder.",
        ),
    ] = None
    video: Annotated[
        Path | None,
        Parameter(help="File for a video of the job (at most 20 s): .webp, .webm or .mp4."),
    ] = None
    overwrite: Overwrite = False


NOTHING: Final = KeptOptions()
CODES: Final = {"right": 0, "stopped": 1, "silent": 3}


class _Progress(Observer):
    def __init__(self, runner: "Runner", status: Status) -> None:
        self._runner, self._status = runner, status

    def event(self, event: AnyEvent) -> None:
        if isinstance(event, StepStarted):
            steps = counted(len(self._runner.system.executed), "step")
            way = "undoing" if isinstance(event, UndoStarted) else "running"
            self._status.update(
                f"{way}: {steps} done (not counting steps that were undone), now at {event.text}"
            )


def palletise(
    *,
    blocks: Annotated[
        WholeNumber,
        Parameter(help="Number of blocks in the stack, 0 to 20; only 15 blocks fit on the pallet."),
    ] = 20,
    seed: Seed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    fault: Faults = None,
    json: Json = False,
    kept: KeptOptions = NOTHING,
) -> int:
    """Move a stack of blocks onto a pallet, and back. This is the second example of TRIG's paper, with physics, in a
    random world.

    A simulated person types the 26 lines of the example, and teaches positions with errors of about
    .3 mm. Then the program runs forwards, and a referee judges the result. Finally the program runs backwards, and the
    referee judges again. Twenty blocks take some minutes.

    Exit code 0: every block was placed and taken back; 1: the arm stopped too early; 3: done, but the referee
    disagrees; 2: bad input; 130: interrupted.
    """
    from handeye.systems.trig.jobs.benches import MOST_BLOCKS

    if not 0 <= blocks <= MOST_BLOCKS:
        raise BadArgument(f"a stack must have 0 to {MOST_BLOCKS} blocks, not {blocks}")
    return _work("palletise", _world("palletise", seed, errors, fault), blocks, kept, json=json)


def bucket(
    *,
    seed: Seed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    fault: Faults = None,
    json: Json = False,
    kept: KeptOptions = NOTHING,
) -> int:
    """Drop a block into a bucket, and put another block where the first one was: the paper's first example, with
    physics.

    The program is taught and run in a random world, and a referee judges the result. The program is not run backwards,
    because a block in a bucket cannot be taken back (`handeye trig run plans/bucket.trig --arm purbrick --back` shows
    where the attempt stops).

    Exit code 0: done and right; 1: the arm stopped too early; 3: done, but the referee disagrees; 2: bad input;
    130: interrupted.
    """
    return _work("bucket", _world("bucket", seed, errors, fault), None, kept, json=json)


def _world(name: "JobName", seed: int, errors: OwnErrorOptions, fault: Faults) -> WorldSpec:
    """Return the world of a job. Raises InvalidInput if an option names a quantity or fault that the job does
    not have."""
    return broken(errors.of(name).spec(seed), fault, any_task(name))


def _work(name: "JobName", world: WorldSpec, blocks: int | None, kept: KeptOptions, *, json: bool) -> int:
    from handeye.runs.folder import open_new
    from handeye.systems.trig.run.job import setup_of_job
    from handeye.systems.trig.run.job_video import JobVideo

    start = setup_of_job(name, world, blocks)
    video = None
    if kept.video is not None:
        check_apart(kept.video, kept.out)
        video = JobVideo(kept.video, overwrite=kept.overwrite)
    folder = None if kept.out is None else open_new(kept.out, start, overwrite=kept.overwrite)
    with PanicButton() as panic:
        done, job = _carried_out(start, panic, folder, video)
    if done.outcome == "halted":
        if folder is not None:
            say(f"resume with: handeye resume {shlex.quote(str(folder.path))}", notes, whole=True)
        raise KeyboardInterrupt
    if json:
        put_json(done)
    else:
        _tell(done)
    made = video is None or filmed(lambda told: video.write(job, done.ended_s, told))
    return CODES[done.outcome] or (0 if made else 2)


def _carried_out(
    start: "Checkpoint",
    panic: PanicButton,
    folder: "RunFolder | None",
    video: "JobVideo | None",
) -> "tuple[JobReport, TaughtJob]":
    """Teach a job and execute it. Unless the panic button stops the job, write the result to the folder."""
    from handeye.results.cautions import losses
    from handeye.results.finishing import finished, outcome
    from handeye.runs.host_seconds import Meter
    from handeye.systems.trig.run.job import account, carry_out, job_of

    meter = Meter(timer=HostTimer.of_command())
    with notes.status("teaching") as status:

        def observers(runner: "Runner") -> "Sequence[Observer]":
            watching = [] if folder is None else [folder.watch(runner, start, again=False, meter=meter)]
            return [_Progress(runner, status), *watching]

        runner = _taught(start, panic, folder, observers)
        for sentence in () if folder is None else losses(folder, runner):
            note(sentence)
        job = job_of(runner).job
        if video is not None:
            video.watch(job)
        pause = carry_out(runner, tell=note)
        if pause.kind != "panic":
            result = finished(runner, pause, meter, judged=True, folder=folder)
        else:
            result = outcome(runner, pause, meter, judged=True)
            if folder is not None:
                folder.close()
    return account(runner, pause, result), job


def _taught(
    start: "Checkpoint",
    panic: PanicButton,
    folder: "RunFolder | None",
    observers: "Callable[[Runner], Sequence[Observer]]",
) -> "Runner":
    """Start a run and teach its job. If the teaching fails, a folder that was created for the run is removed."""
    from handeye.execution.servo import Halted
    from handeye.runs.runner import Runner

    note(f"teaching {start.setup.task} in the world of seed {start.setup.world.seed}")
    try:
        return Runner(start, halt=panic, observers=observers)
    except BaseException as error:
        if folder is not None:
            folder.discard()
        if isinstance(error, Halted):
            raise KeyboardInterrupt from None
        raise


def _tell(done: "JobReport") -> None:
    for title, checks in (("The program has ended:", done.checks), ("Undone:", done.checks_back)):
        if checks:
            say(title)
        for check in checks.values():
            say(f"  {'right' if check.ok else 'WRONG'}  {check.told} {check.unit}")
    if done.outcome == "stopped":
        say(done.told[-1])
    say(
        {"right": "Right.", "stopped": "The arm has stopped.", "silent": "Done, but the referee disagrees."}[
            done.outcome
        ]
    )


def pallet_trials(
    *,
    n: Annotated[
        WholeNumber, Parameter(name="--n", help="Number of trials. The seed of trial K is --seed plus K.")
    ] = 10,
    seed: FirstSeed = 0,
    blocks: Annotated[WholeNumber, Parameter(help="Number of blocks in the stack, 0 to 20.")] = 7,
    interrupt: Annotated[
        bool,
        Parameter(help="Interrupt each run after a random number of steps, and undo the work from there."),
    ] = False,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: SweepOptions = ANY,
) -> int:
    """Palletise blocks in many worlds, and undo the work. Shows the success rate, and the position errors of the
    blocks.

    Each trial does what `handeye trig palletise` does: the program is taught, run, judged, undone and judged again.
    Ctrl-C ends the batch and prints the trials that have finished.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure: in some trial, the program reported
    success, but the referee disagrees.
    """
    from handeye.systems.trig.jobs.benches import MOST_BLOCKS
    from handeye.systems.trig.run.pallet_trials import PALLET, PalletWork
    from handeye.trials.folder import head_of
    from handeye.trials.sweep import cases

    positive(n, "trial")
    options.check()
    if not 0 <= blocks <= MOST_BLOCKS:
        raise BadArgument(f"a stack must have 0 to {MOST_BLOCKS} blocks, not {blocks}")
    settings = {"blocks": str(blocks), "interrupted runs": "yes" if interrupt else "no"}
    world = errors.of("palletise").spec(seed)
    words = shlex.join(errors.words())
    broken = f"{' --interrupt' if interrupt else ''}{' ' + words if words else ''}"
    return carry_out_sweep(
        PALLET,
        PalletWork(blocks=blocks, interrupt=interrupt, world=world),
        cases(seed, range(n)),
        head_of(PALLET, world, settings=settings),
        options,
        title=f"the palletiser with {counted(blocks, 'block')}, in worlds with seeds from {seed} upwards",
        again=lambda row: f"handeye trials pallet --n 1 --seed {row.seed} --blocks {blocks}{broken}",
        more={"blocks": blocks, "interrupted": interrupt},
    )
