"""Traces for Python programs: read from files, made into videos, and shown in notebooks.

>>> trace = handeye.open("out")
>>> trace.joints[trace.times > 100.0]    # sensed joint positions after 100 s; shape (n, 6)
>>> trace.forces(line=91).force[:, 2]    # upward force, in N, during line 91 of the script
>>> trace.at(137.0).step.text    # what the arm was doing at that time
"""

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

from handeye.comparison.comparison import Comparison, comparison
from handeye.core.arguments import given_file
from handeye.core.errors import CannotWrite, InvalidInput, Taken
from handeye.core.notebook import inked, line, page, sandbox
from handeye.report.recorded import RecordedRun
from handeye.results.recorded_run import recorded_run
from handeye.runs.folder import TRACE
from handeye.trace import trace as recorded
from handeye.trace.reading import read_trace_as

if TYPE_CHECKING:
    from handeye.video.making import Video

FRAME_HEIGHT_PX: Final = 640
_WITHOUT: Final = "A notebook shows the report without photographs; trace.frame(time) takes a photograph."


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Trace(recorded.Trace):
    """The recording of a run, read from a file and checked. Values computed from the recording are kept for later
    use.

    Times are in seconds since the program began, as in events, tables, pages and commands. The trace does not
    record the preparation before the program starts, in which the camera is calibrated; `head.prepared` gives the
    duration of this preparation in seconds. In the shapes of arrays, n is the number of servo periods, sixty per
    second, and m the number of joints. Reading raises `InvalidInput` if a message in the file does not have the
    type of its channel. A notebook shows the run's report with a 3D replay; `frame` returns one picture.
    """

    def video(
        self,
        path: str | os.PathLike[str],
        *,
        camera: str = "orbit",
        width: int = 480,
        height: int = 360,
        seconds: float | None = None,
        speed: float | None = None,
        first: str | int | None = None,
        last: str | int | None = None,
        captions: bool = False,
        overwrite: bool = False,
    ) -> "Video":
        """Make a video of the run: an animated WebP or a WebM, depending on the ending of `path`.

        The video is drawn from the recording, without simulating the run again. It needs OpenGL. Each wait for the
        camera's mechanism is cut to at most 1 s.

        Args:
            camera: `orbit`, which moves around the cell; `follow`, which moves close to the hand; or the name of a
                camera of the scene.
            seconds: length of the video in seconds, 14 by default; short stages are played more slowly, so that
                each can be seen.
            speed: how many times faster than the run the video plays; give this instead of `seconds`.
            first: the stage with which the video begins: its number, its name, or part of its name.
            last: the stage with which the video ends, given in the same way.
            captions: show stage and clock, and pause at each picture that the program takes.
            overwrite: replace an existing video.

        Raises:
            InvalidInput: for the same reasons as `frame`; also if one of the given stages does not exist, if nothing
                was recorded in these stages, if the length or speed is impossible, or if the video cannot be written.
        """
        from handeye.core.arguments import given_file
        from handeye.video.making import make_video
        from handeye.video.request import VideoRequest

        wanted = VideoRequest(
            camera=camera, width=width, height=height, seconds=seconds, speed=speed, first=first, last=last,
            captions=captions,
        )  # fmt: skip
        file = given_file(path, "the name of a video must end in .webp, .webm or .mp4")
        try:
            return make_video(self, file, wanted, overwrite=overwrite)
        except Taken:
            raise CannotWrite(f"{file} already exists; overwrite=True replaces it") from None

    def _repr_html_(self) -> str:
        """Show the run's report in an HTML frame, and say how large the report is (MB). If there is no report, show
        the reason.
        """
        try:
            file = _report(self)
        except InvalidInput as fault:
            return page(line(inked(str(fault), "doubtful")))
        weighs = f"The report of {self.head.program}, {self.head.world}: {len(file) / 1e6:.1f} MB in this notebook."
        return page(line(weighs), sandbox(file, f"report of {self.head.program}", FRAME_HEIGHT_PX))


def open(path: str | os.PathLike[str]) -> Trace:
    """Read the trace of a run that has ended: a `trace.mcap`, or the folder of the run.

    Raises:
        InvalidInput: the file cannot be read, or is not a valid trace.

    >>> run = handeye.assemble(script="OPEN 1\\n", camera="ray", out=folder)
    >>> handeye.open(folder).head.program
    'script'
    """
    file = given_file(path, "a trace must be a file or the folder of a run")
    return read_trace_as(Trace, file / TRACE if file.is_dir() else file)


def _report(trace: Trace) -> bytes:
    from handeye.report.animation import animation
    from handeye.report.page.document import report_page
    from handeye.report.photographs import no_album
    from handeye.report.recorded import RecordedRun, check_scene

    run = RecordedRun(trace=trace)
    check_scene(run)
    return report_page(run, no_album(run, _WITHOUT), animation(run))


def compare(
    a: str | os.PathLike[str] | recorded.Trace, b: str | os.PathLike[str] | recorded.Trace
) -> Comparison:
    """Compare two recorded runs step by step. `print` shows the comparison as the command `handeye compare` does.

    Args:
        a: the folder of a run that has ended, a `trace.mcap`, or an open trace.
        b: the other run, in one of the same forms.

    Raises:
        InvalidInput: a run cannot be read, or cannot be compared.

    >>> for seed in 1, 2:
    ...     run = handeye.assemble(seed, script="OPEN 1\\nCLOSE .1\\n", camera="ray", out=folder / str(seed))
    >>> found = handeye.compare(folder / "1", folder / "2")
    >>> found.same, found.first.place.text, found.parted
    (False, 'OPEN 1', None)
    """
    return comparison(_recorded(a), _recorded(b))


def _recorded(run: str | os.PathLike[str] | recorded.Trace) -> RecordedRun:
    if isinstance(run, recorded.Trace):
        return RecordedRun(trace=run)
    trace = open(run)
    return recorded_run(Path(run), trace)
