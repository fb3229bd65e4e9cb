"""The command that makes a video of a run."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from handeye.cli.common import Overwrite, Size, TaskWords, complain, note, notes, say, width_and_height
from handeye.cli.programs import check_task, made_known
from handeye.cli.trace_files import RunOrTrace, motion_file, run_or_newest
from handeye.core.errors import CannotWrite, InvalidInput
from handeye.core.plain_text import counted

if TYPE_CHECKING:
    from handeye.trace.trace import Trace
    from handeye.video.making import Progress


def video(
    run: RunOrTrace = None,
    /,
    *,
    task: TaskWords = None,
    output: Annotated[
        Path | None,
        Parameter(
            name=["--out", "-o"],
            help="File for the video: .webp, .webm, or .mp4 (which needs the extra `mp4`). "
            "Default: video.webp in the folder of the run, or next to the trace.",
        ),
    ] = None,
    overwrite: Overwrite = False,
    camera: Annotated[
        str,
        Parameter(
            help="`orbit`, which moves around the cell; `follow`, which moves close to the hand; or the name of a "
            "camera of the scene."
        ),
    ] = "orbit",
    size: Size = "480x360",
    seconds: Annotated[float | None, Parameter(help="Length of the video in seconds. Default: 14.")] = None,
    speed: Annotated[
        float | None,
        Parameter(help="Instead of --seconds: speed of the video, as a multiple of the speed of the run."),
    ] = None,
    first: Annotated[
        str | None,
        Parameter(
            name="--from", help="Begin with this stage, given by its number, its name, or part of its name."
        ),
    ] = None,
    last: Annotated[str | None, Parameter(name="--to", help="End with this stage.")] = None,
    captions: Annotated[
        bool,
        Parameter(
            help="Show captions with stage and clock, and pause at each picture that the program takes."
        ),
    ] = False,
) -> int:
    """Make a video of a recorded run, without simulating it again.

    The video is an animated WebP (for a README), a WebM or an MP4; browsers play all three. Each wait for the camera's
    mechanism is cut to at most 1 s. Short stages play slower, so that each can be seen. With --speed, all stages play
    at the speed that you give.

    ```
    handeye video pump
    handeye video pump -o pins.webm --camera follow --from insert --to top
    ```

    Exit code 0: written; 2: bad input.
    """
    from handeye.runs.folder import VIDEO
    from handeye.video.making import make_video
    from handeye.video.request import VideoRequest

    wanted_task = made_known(task)
    width, height = width_and_height(size)
    wanted = VideoRequest(
        camera=camera, width=width, height=height, seconds=seconds, speed=speed, first=first, last=last,
        captions=captions,
    )  # fmt: skip
    run = run_or_newest(run)
    place = output or (run / VIDEO if run.is_dir() else run.with_name(VIDEO))
    trace = _trace(run)
    check_task(wanted_task, trace.head.task, run)
    replaced = "; the earlier file is replaced" if place.exists() else ""
    with drawing() as told:
        made = make_video(trace, place, wanted, overwrite=overwrite or output is None, told=told)
    how = f"{counted(made.frames, 'frame')} of {wanted.width} x {wanted.height}"
    say(f"{made.path}: {made.seconds:.1f} s, {how}, {made.bytes / 1e6:.2f} MB{replaced}")
    return 0


def _trace(run: Path) -> "Trace":
    """The trace of a run, as far as it can be read; raises InvalidInput if there is none."""
    from handeye.trace.reading import is_cut_short, read_trace

    file = motion_file(run)
    cut = is_cut_short(file)
    if cut and file.suffix != ".part":
        note(f"{file} was cut short; the video shows only the recorded part")
    return read_trace(file, lenient=cut)


@contextmanager
def drawing() -> Iterator["Progress"]:
    """While the context is open, the number of drawn frames is shown: as a bar or, without a terminal, as an
    occasional line.
    """
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("drawing"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=notes, transient=True, disable=not notes.is_terminal) as bar:
        task = bar.add_task("")

        def told(done: int, of: int) -> None:
            bar.update(task, completed=done, total=of)
            if bar.disable and done % 60 == 0:
                note(f"drawing frame {done + 1} of {of}")

        yield told


def filmed(make: "Callable[[Progress], object]") -> bool:
    """Make the video of a run that has ended. If the video cannot be made, report the error and return False."""
    try:
        with drawing() as told:
            make(told)
    except InvalidInput as error:
        complain(error)
        return False
    return True


def check_apart(video: Path, out: Path | None) -> None:
    """Raise CannotWrite if a video would be written into the folder of its run."""
    if out is not None and video.absolute().is_relative_to(out.absolute()):
        raise CannotWrite(f"{video} is in the folder of --out, which belongs to a run; choose another place")
