"""Draws and writes the video of a recorded run."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import cv2
import numpy as np

from handeye.cell.photograph import Photograph, Photographer
from handeye.cell.posed import posed
from handeye.core.entries import require
from handeye.core.errors import BadFile
from handeye.core.files import check_place, write_over
from handeye.report.facts.seen import SeenPicture
from handeye.report.recorded import RecordedRun, check_scene
from handeye.trace.trace import Trace
from handeye.video.captions import captioned
from handeye.video.formats import format_of
from handeye.video.request import VideoRequest
from handeye.video.storyboard import Storyboard, storyboard
from handeye.vision.drawing import annotate

_FINER: Final = 2  # drawn points per frame point along a side
_SHADOW: Final = 2048

Progress = Callable[[int, int], None]  # called with the number of frames drawn, and the number of all frames


@dataclass(frozen=True, slots=True, kw_only=True)
class Video:
    """A video that was written."""

    path: Path
    seconds: float  # duration, s
    frames: int  # number of drawn frames; the last one is held for a while
    bytes: int


def make_video(
    trace: Trace, path: Path, wanted: VideoRequest, *, overwrite: bool, told: Progress = lambda done, of: None
) -> Video:
    """Write a video of a recorded run, without simulation. Either the whole file is written, or nothing. Raises Taken
    if the file exists, unless `overwrite` is True.
    """
    require(trace.head.system, "video", trace.name)
    form = format_of(path)
    check_place(path, form.kind, overwrite=overwrite)
    check_scene(RecordedRun(trace=trace))
    board = storyboard(trace, wanted)
    form.check(len(board.frames), wanted.width, wanted.height)
    data = form.encode(_drawn(trace, board, wanted, told), board.held)
    write_over(path, data, form.kind)
    return Video(path=path, seconds=board.seconds, frames=len(board.frames), bytes=len(data))


def _drawn(trace: Trace, board: Storyboard, wanted: VideoRequest, told: Progress) -> Iterator[Photograph]:
    """Draw the frames in order."""
    photographer = Photographer(
        trace.scene, width=_FINER * wanted.width, height=_FINER * wanted.height, shadow=_SHADOW
    )
    for number, frame in enumerate(board.frames):
        told(number, len(board.frames))
        fine = photographer.take(*posed(trace.scene, trace.at(frame.time).poses, frame.time), frame.view)
        small = cv2.resize(fine, (wanted.width, wanted.height), interpolation=cv2.INTER_AREA)
        drawn, seen = np.asarray(small, dtype=np.uint8), frame.looked_at
        inset = None if seen is None else _marked(seen)
        yield drawn if frame.caption is None else captioned(drawn, frame.caption, inset)


def _marked(seen: SeenPicture) -> Photograph:
    """Return a picture with marks for what vision found in it."""
    try:
        return annotate(seen.picture, seen.marks, scale=1)[:, :, ::-1]
    except ValueError:
        raise BadFile(f"the findings in picture {seen.name} cannot be drawn") from None
