"""Commands that carry out the paper's two examples in drawn worlds: taught, run, judged, and taken back."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

from cyclopts import Parameter

from handeye.cli.common import Json, WholeNumber, complain, note, put_json, say
from handeye.cli.panic_button import PanicButton
from handeye.cli.videos import drawing
from handeye.errors import InvalidInput
from handeye.variation import checked_seed

if TYPE_CHECKING:
    from handeye.report.taught_job import JobReport
    from handeye.tasks.benches import JobName

Seed = Annotated[WholeNumber, Parameter(help="The world: how far off people teach, machine and blocks are.")]


@Parameter(name="*")
@dataclass(frozen=True, slots=True, kw_only=True)
class KeptOptions:
    """What is left of a job."""

    out: Annotated[
        Path | None,
        Parameter(help="Folder for the result (result.json), the program, and a report (report.html)."),
    ] = None
    video: Annotated[
        Path | None,
        Parameter(help="Video of the job, .webp or .webm, 20 s long at most."),
    ] = None
    overwrite: Annotated[
        bool, Parameter(help="Replace the result in the folder of --out, and the video that is there.")
    ] = False


NOTHING: Final = KeptOptions()
CODES: Final = {"right": 0, "stopped": 1, "silent": 3}


def palletise(
    *,
    blocks: Annotated[WholeNumber, Parameter(help="In the stack, 0 to 20; the pallet takes 15.")] = 20,
    seed: Seed = 0,
    json: Json = False,
    kept: KeptOptions = NOTHING,
) -> int:
    """Put a stack of blocks into a pallet, and back: the paper's second example, with physics, in a drawn world.

    Its 26 lines are typed into a new editor, by a person whose places are off by .3 mm. Then the program is run from
    the top, a referee looks, it is run backwards, and the referee looks again. Twenty blocks take some minutes.

    Exit code 0: placed, and every block back where it was; 1: the arm has stopped before; 3: done, and the referee
    disagrees; 2: bad input; 130: interrupted.
    """
    from handeye.tasks.benches import MOST_BLOCKS

    if not 0 <= blocks <= MOST_BLOCKS:
        raise InvalidInput(f"a stack of 0 to {MOST_BLOCKS} blocks can be palletised, not of {blocks}")
    return _work("palletise", checked_seed(seed), blocks, kept, json=json)


def bucket(*, seed: Seed = 0, json: Json = False, kept: KeptOptions = NOTHING) -> int:
    """Drop a block into a bucket, and put another one in its place: the paper's first example, with physics.

    It is taught and run in a drawn world, and a referee looks. It is not run backwards: what lies in a bucket cannot be
    taken back (`handeye trig run plans/bucket.trig --arm purbrick --back` shows where that stops).

    Exit code 0: done and right; 1: the arm has stopped before; 3: done, and the referee disagrees; 2: bad input;
    130: interrupted.
    """
    return _work("bucket", checked_seed(seed), None, kept, json=json)


def _work(name: "JobName", seed: int, blocks: int | None, kept: KeptOptions, *, json: bool) -> int:
    from handeye.cli.trig_sessions import interrupting, watched_desk
    from handeye.folders import check_folder
    from handeye.report.job_folder import JOB_FOLDER, write_job
    from handeye.report.taught_job import carry_out
    from handeye.tasks.benches import open_job
    from handeye.video.job_video import JobVideo

    if kept.out is not None:
        check_folder(kept.out, JOB_FOLDER, overwrite=kept.overwrite)
        if kept.video is not None and kept.video.absolute().is_relative_to(kept.out.absolute()):
            raise InvalidInput(
                f"{kept.video} lies in the folder of --out, which is written as a whole; name another"
            )
    video = None if kept.video is None else JobVideo(kept.video, overwrite=kept.overwrite)
    with PanicButton() as panic:
        job = open_job(name, seed, blocks or 0)
        note(f"teaching {name} in the world of seed {seed}")
        job.teach(interrupting(panic))
        if video is not None:
            video.watch(job)
        with watched_desk(job.session, panic) as desk:
            done = carry_out(job, name, desk, seed=seed, blocks=blocks)
    if kept.out is not None:
        write_job(kept.out, done, job)
    if done.outcome == "halted":
        raise KeyboardInterrupt
    if json:
        put_json(done)
    else:
        _tell(done)
    code = CODES[done.outcome]
    if video is None:
        return code
    try:
        with drawing() as told:
            video.write(job, done.ended_s, told)
    except InvalidInput as error:  # the verdict stands
        complain(error)
        return code or 2
    return code


def _tell(done: "JobReport") -> None:
    """What the referee has found, and the verdict."""
    for title, checks in (("The program has ended:", done.checks), ("Undone:", done.checks_back)):
        if checks:
            say(title)
        for check in checks.values():
            say(f"  {'right' if check.ok else 'WRONG'}  {check.told} {check.unit}")
    if done.outcome == "stopped":
        say(done.told[-1])
    say(
        {"right": "Right.", "stopped": "The arm has stopped.", "silent": "Done, and the referee disagrees."}[
            done.outcome
        ]
    )
