"""What the commands of all jobs share: the options of a run, the run with its video, and trials."""

import shlex
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Annotated, Any, Final

from cyclopts import Parameter

from handeye.cli.common import Details, Json, NoKeep, Out, Overwrite, positive
from handeye.cli.runs import Break, Live, OnStop, Step, check_kept
from handeye.cli.sweeps import SweepOptions, carry_out_sweep
from handeye.cli.videos import check_apart, filmed
from handeye.cli.world_options import Faults, OwnErrorOptions

if TYPE_CHECKING:
    from handeye.core.variation import WorldSpec
    from handeye.runs.observer import Observer
    from handeye.runs.setup import Setup
    from handeye.trials.sweep import Sweep


@Parameter(name="*")
@dataclass(frozen=True, slots=True, kw_only=True)
class RunOptions:
    """Options for running a program."""

    json: Json = False
    details: Details = False
    out: Out = None
    overwrite: Overwrite = False
    no_keep: NoKeep = False
    breaks: Break = None
    step: Step = False
    live: Live = False
    on_stop: OnStop = None


@Parameter(name="*")
@dataclass(frozen=True, slots=True, kw_only=True)
class JobOptions(RunOptions):
    """Options for running a job, except its world."""

    video: Annotated[
        Path | None, Parameter(help="File for a video of the run, 14 s long: .webp, .webm or .mp4.")
    ] = None


@Parameter(name="*")
@dataclass(frozen=True, slots=True, kw_only=True)
class FaultyJobOptions(JobOptions):
    """Options for running a job whose world may have faults."""

    fault: Faults = None


USUAL_RUN: Final = RunOptions()
ANY_RUN: Final = JobOptions()
ANY_FAULTY_RUN: Final = FaultyJobOptions()


def carry_out_run(
    setup: "Setup",
    options: RunOptions,
    listening: "Sequence[Observer]" = (),
    *,
    folder: Path | None = None,
    judged: bool = True,
) -> int:
    """Run a program and report how it ended. Returns the exit code.

    Args:
        listening: observers of the run; not used if the run is stepped.
        folder: where the run is saved, in place of --out.
    """
    from handeye.cli.job import Job, work
    from handeye.runs.snapshot import Checkpoint

    return work(
        Job(
            start=Checkpoint(setup=setup), out=folder or options.out, keep=not (options.no_keep or options.step),
            details=options.details, overwrite=options.overwrite, breaks=options.breaks or (), step=options.step,
            live=options.live, on_stop=options.on_stop, json=options.json, referee=judged,
            listening=() if options.step else listening,
        )
    )  # fmt: skip


def carry_out_job(setup: "Setup", options: JobOptions, listening: "Sequence[Observer]" = ()) -> int:
    """Run a job, have its referee judge the result, and make the video. Returns the exit code."""
    out, video, overwrite = options.out, options.video, options.overwrite
    check_kept(options.no_keep, out)
    with TemporaryDirectory() as aside:
        folder = out
        if video is not None:
            _check_video(video, out, overwrite=overwrite)
            folder = out or Path(aside) / "run"
        code = carry_out_run(setup, options, listening, folder=folder)
        if video is None or folder is None or code not in (0, 1, 3):
            return code
        return code or (0 if _filmed(folder, video, overwrite=overwrite) else 2)


def carry_out_job_trials(
    sweep: "Sweep[Any]",
    setup_of: "Callable[[WorldSpec], Setup]",
    n: int,
    seed: int,
    errors: OwnErrorOptions,
    options: SweepOptions,
    *,
    settings: Mapping[str, object],
    title: str,
    again: str,
) -> int:
    """Run a job in many worlds, and return the exit code.

    Args:
        settings: settings of all trials, recorded with each trial.
        title: heading that says what the trials do.
        again: words of the command that repeats a trial, without the seed and the errors of the trial.
    """
    from handeye.trials.folder import head_of
    from handeye.trials.jobs import JobWork
    from handeye.trials.sweep import cases

    positive(n, "trial")
    options.check()
    world = errors.of(sweep.kind).spec(seed)
    words = " ".join(filter(None, (again, shlex.join(errors.words()))))
    return carry_out_sweep(
        sweep,
        JobWork(setup=setup_of(world), row=sweep.row, settings=settings),
        cases(seed, range(n)),
        head_of(sweep, world, settings={name: str(value) for name, value in settings.items()}),
        options,
        title=title,
        again=lambda row: f"handeye trials {sweep.kind} --n 1 --seed {row.seed} {words}".rstrip(),
        more=settings,
    )


def _check_video(video: Path, out: Path | None, *, overwrite: bool) -> None:
    """Raise InvalidInput, before the run begins, if it would be impossible to write the video."""
    from handeye.cell.opengl import context
    from handeye.core.files import check_place
    from handeye.video.formats import format_of

    check_place(video, format_of(video).kind, overwrite=overwrite)
    context()
    check_apart(video, out)


def _filmed(folder: Path, video: Path, *, overwrite: bool) -> bool:
    """Make the video from the trace of the run. If the video cannot be made, report the error and return False."""
    from handeye.runs.folder import TRACE
    from handeye.trace.reading import read_trace
    from handeye.video.making import make_video
    from handeye.video.request import VideoRequest

    return filmed(
        lambda told: make_video(
            read_trace(folder / TRACE), video, VideoRequest(), overwrite=overwrite, told=told
        )
    )
