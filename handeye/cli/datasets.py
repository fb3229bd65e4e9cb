"""Commands that record runs in many worlds, and write recorded runs as a data set."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from handeye.cli.common import (
    Camera,
    Json,
    Overwrite,
    WholeNumber,
    answer,
    camera_here,
    note,
    positive,
    put_json,
    say,
)
from handeye.cli.programs import plan_or_own
from handeye.cli.sweeps import FirstSeed
from handeye.cli.world_options import ANY_ERRORS, ErrorOptions
from handeye.core.errors import BadArgument
from handeye.core.plain_text import counted


def lerobot(
    runs: Annotated[
        list[Path],
        Parameter(name="RUNS", help="Folders of runs, or folders that contain folders of runs.", negative=""),
    ],
    /,
    *,
    output: Annotated[Path, Parameter(name=["--out", "-o"], help="The folder to write to.")],
    overwrite: Overwrite = False,
    pictures: Annotated[
        bool,
        Parameter(negative="--no-pictures", help="Include the television pictures, compressed without loss."),
    ] = True,
    view: Annotated[
        str | None,
        Parameter(
            help="Also render the view of a camera of the scene, such as studio, and include it as a video that is "
            "compressed with loss. The robot does not have this view. Needs OpenGL."
        ),
    ] = None,
    json: Json = False,
) -> int:
    """Write runs as a data set for learned policies, in the format of LeRobot 3, with a data card; needs the extra
    `lerobot`.

    Failed runs are included and marked. The data set is written completely or not at all.

    Exit code 0: written; 2: bad input.
    """
    from handeye.datasets.lerobot import write_dataset

    def progress(number: int, count: int) -> None:
        note(f"run {number} of {count}")

    written = write_dataset(
        output, runs, pictures=pictures, view=view, overwrite=overwrite, progress=progress
    )
    outcomes = ", ".join(f"{number} {name}" for name, number in written.outcomes.items())
    said = f"{written.path}: {counted(written.episodes, 'episode')}, {counted(written.frames, 'frame')}; {outcomes}"
    return answer(written, (said,), json=json)


def record(
    folder: Annotated[Path, Parameter(name="FOLDER", help="The folder that receives a folder for each run.")],
    /,
    *,
    n: Annotated[
        WholeNumber, Parameter(help="Number of runs without faults, each in a world of its own.")
    ] = 20,
    faulty: Annotated[
        WholeNumber, Parameter(help="Number of further runs, with one fault of the standard set in each.")
    ] = 0,
    seed: FirstSeed = 0,
    errors: ErrorOptions = ANY_ERRORS,
    camera: Camera = "auto",
    jobs: Annotated[WholeNumber, Parameter(help="Number of processes that work at the same time.")] = 2,
    json: Json = False,
) -> int:
    """Record runs in many worlds, for data sets and reports; keep each run and its trace in a folder of its own.

    The same command continues an interrupted recording. Runs that have ended are not repeated, so a greater --n adds
    runs. `handeye export lerobot` writes the runs as a data set.

    Exit code 0: recorded, whatever the results of the runs; 2: bad input; 130: interrupted.
    """
    from handeye.api.plans import Plan
    from handeye.datasets.recording import Recording, record_all, worlds

    positive(jobs, "worker")
    if n + faulty < 1:
        raise BadArgument("there is no run to record: --n and --faulty are both 0")
    errors.check(seed)
    plan = Plan(record=plan_or_own(None, errors.task))
    wanted = worlds(plan, errors.spec(seed), n, faulty)

    def progress(done: int, count: int) -> None:
        note(f"{done} of {counted(count, 'run')}")

    outcomes = record_all(
        Recording(folder=folder, plan=plan, camera=camera_here(camera)), wanted, jobs, progress
    )
    if json:
        put_json({"folder": str(folder), "runs": len(wanted), "outcomes": outcomes})
        return 0
    told = ", ".join(f"{number} {name}" for name, number in outcomes.items())
    say(f"{folder}: {counted(len(wanted), 'run')}; {told}")
    return 0
