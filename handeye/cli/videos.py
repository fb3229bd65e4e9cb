"""Command that makes a video of a run."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from handeye.cli.common import TaskWords, note, notes, say
from handeye.cli.programs import check_task, made_known
from handeye.cli.trace_files import RunOrTrace, motion_file, run_or_newest
from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument
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
            name=["--output", "-o"],
            help="The video, .webp or .webm; by default video.webp in the folder of the run, or beside the trace.",
        ),
    ] = None,
    overwrite: Annotated[bool, Parameter(help="Replace the video that is there.")] = False,
    camera: Annotated[
        str,
        Parameter(
            help="`orbit` sways round the cell, `follow` goes near to where the hand works; or one of the scene's "
            "cameras."
        ),
    ] = "orbit",
    size: Annotated[str, Parameter(help="Points from left to right, and from top to bottom.")] = "480x360",
    seconds: Annotated[float | None, Parameter(help="Length of the video; 14 by default.")] = None,
    speed: Annotated[
        float | None, Parameter(help="How many times as fast as the run it is, in the place of a length.")
    ] = None,
    first: Annotated[
        str | None,
        Parameter(name="--from", help="Begin with this stage: its number, name, or a piece of it."),
    ] = None,
    last: Annotated[str | None, Parameter(name="--to", help="End with this stage.")] = None,
    captions: Annotated[
        bool,
        Parameter(help="Tell stage and clock, and stand still for each picture that the program takes."),
    ] = False,
) -> int:
    """Make a video of a recorded run; nothing is simulated.

    An animated WebP (for a README) or a WebM; browsers play both. The long waits for the camera's mechanism are cut
    out. With a length, short stages are slowed down so that each can be seen; with a speed, all is equally fast.

    ```
    handeye video pump
    handeye video pump -o pins.webm --camera follow --from insert --to top
    ```

    Exit code 0: it is written; 2: bad input.
    """
    from handeye.runs.folder import VIDEO
    from handeye.video.making import make_video
    from handeye.video.request import VideoRequest

    wanted_task = made_known(task)
    found = re.fullmatch(r"([0-9]{1,9})x([0-9]{1,9})", size)
    if found is None:
        raise BadArgument(f"{quoted(size)} is no size; one is written as 480x360")
    width, height = int(found[1]), int(found[2])
    wanted = VideoRequest(
        camera=camera, width=width, height=height, seconds=seconds, speed=speed, first=first, last=last,
        captions=captions,
    )  # fmt: skip
    run = run_or_newest(run)
    place = output or (run / VIDEO if run.is_dir() else run.with_name(VIDEO))
    trace = _trace(run)
    check_task(wanted_task, trace.head.task, run)
    with drawing() as told:
        made = make_video(trace, place, wanted, overwrite=overwrite, told=told)
    how = f"{counted(made.frames, 'frame')} of {wanted.width} x {wanted.height}"
    say(f"{made.path}: {made.seconds:.1f} s, {how}, {made.bytes / 1e6:.2f} MB")
    return 0


def _trace(run: Path) -> "Trace":
    """The trace of a run, as far as it can be read; raises InvalidInput if there is none."""
    from handeye.trace.reading import is_cut_short, read_trace

    file = motion_file(run)
    cut = is_cut_short(file)
    if cut and file.suffix != ".part":
        note(f"{file} was cut short; this is a video of what it holds")
    return read_trace(file, lenient=cut)


@contextmanager
def drawing() -> Iterator["Progress"]:
    """Tells how many frames are drawn: as a bar, or where there is no terminal, once in a while."""
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("drawing"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=notes, transient=True, disable=not notes.is_terminal) as bar:
        task = bar.add_task("")

        def told(done: int, of: int) -> None:
            bar.update(task, completed=done, total=of)
            if bar.disable and done % 60 == 0:
                note(f"drawing frame {done + 1} of {of}")

        yield told
