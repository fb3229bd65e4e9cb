"""What the commands of all jobs share: the options of a run, the run with its video, and trials."""

import shlex
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Annotated, Final

from cyclopts import Parameter

from handeye.cli.common import (
    Details,
    Json,
    NoKeep,
    Out,
    Overwrite,
    WholeNumber,
    complain,
    positive,
)
from handeye.cli.runs import Break, Live, OnStop, Step, check_kept
from handeye.cli.sweeps import SweepOptions, carry_out_sweep
from handeye.cli.videos import drawing
from handeye.cli.world_options import OwnErrorOptions
from handeye.core.errors import CannotWrite, InvalidInput

if TYPE_CHECKING:
    from handeye.systems.ml.run.job_trials import MlJobRow
    from handeye.systems.ml.run.plan import MlPlan
    from handeye.trials.sweep import Sweep

JobSeed = Annotated[
    WholeNumber,
    Parameter(help="Seed of the world: it determines the errors of the arm, and where parts lie."),
]
NumberOfWorlds = Annotated[
    WholeNumber, Parameter(name="--n", help="Number of worlds; world K has the seed --seed plus K.")
]


@Parameter(name="*")
@dataclass(frozen=True, slots=True, kw_only=True)
class JobOptions:
    """Options of a run of a job, except its world."""

    json: Json = False
    details: Details = False
    out: Out = None
    video: Annotated[Path | None, Parameter(help="Video of the run, .webp, .webm or .mp4, 14 s long.")] = None
    overwrite: Overwrite = False
    no_keep: NoKeep = False
    breaks: Break = None
    step: Step = False
    live: Live = False
    on_stop: OnStop = None


ANY_RUN: Final = JobOptions()


def carry_out(plan: "MlPlan", seed: int, errors: OwnErrorOptions, options: JobOptions) -> int:
    """Run the plan of a job and let its referee judge; make the video. Returns the exit code."""
    from handeye.cli.job import Job, work
    from handeye.runs.snapshot import Checkpoint
    from handeye.systems.ml.run.jobs import job_setup

    out, video = options.out, options.video
    check_kept(options.no_keep, out)
    setup = job_setup(plan, errors.of(plan.job).spec(seed))
    with TemporaryDirectory() as aside:
        folder = out
        if video is not None:
            _check_video(video, out, overwrite=options.overwrite)
            folder = out or Path(aside) / "run"
        code = work(
            Job(
                start=Checkpoint(setup=setup), out=folder, keep=not (options.no_keep or options.step),
                details=options.details, overwrite=options.overwrite, breaks=options.breaks or (), step=options.step,
                live=options.live, on_stop=options.on_stop, json=options.json, referee=True,
            )
        )  # fmt: skip
        if video is None or folder is None or code not in (0, 1, 3):
            return code
        return code or (0 if _filmed(folder, video, overwrite=options.overwrite) else 2)


def carry_out_trials(
    sweep: "Sweep[MlJobRow]",
    plan: "MlPlan",
    n: int,
    seed: int,
    errors: OwnErrorOptions,
    options: SweepOptions,
    *,
    title: str,
    again: str,
) -> int:
    """Run the plan of a job in many worlds; returns the exit code.

    Args:
        title: what the trials do, as their heading.
        again: the words that repeat a trial besides its seed and the errors.
    """
    from handeye.systems.ml.run.job_trials import MlJobWork
    from handeye.trials.folder import head_of
    from handeye.trials.sweep import cases

    positive(n, "trial")
    options.check()
    world = errors.of(plan.job).spec(seed)
    words = " ".join(filter(None, (again, shlex.join(errors.words()))))
    return carry_out_sweep(
        sweep,
        MlJobWork(plan=plan, world=world),
        cases(seed, range(n)),
        head_of(sweep, world, settings={"variant": plan.variant}),
        options,
        title=f"{title}, in worlds from seed {seed} on",
        again=lambda row: f"handeye trials {plan.job} --n 1 --seed {row.seed} {words}".rstrip(),
        more={"variant": plan.variant},
    )


def _check_video(video: Path, out: Path | None, *, overwrite: bool) -> None:
    """Raise InvalidInput before the run if the video could not be written after it."""
    from handeye.cell.opengl import context
    from handeye.core.files import check_place
    from handeye.video.formats import format_of

    check_place(video, format_of(video).kind, overwrite=overwrite)
    context()
    if out is not None and video.absolute().is_relative_to(out.absolute()):
        raise CannotWrite(f"{video} is in the folder of --out, which belongs to a run; choose another place")


def _filmed(folder: Path, video: Path, *, overwrite: bool) -> bool:
    """Make the video from the trace of the run. If that fails, report the error and return False."""
    from handeye.runs.folder import TRACE
    from handeye.trace.reading import read_trace
    from handeye.video.making import make_video
    from handeye.video.request import VideoRequest

    try:
        with drawing() as told:
            make_video(read_trace(folder / TRACE), video, VideoRequest(), overwrite=overwrite, told=told)
    except InvalidInput as error:
        complain(error)
        return False
    return True
