"""A video of a recorded run is drawn and written."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import cv2
import numpy as np

from handeye.cell.photograph import Photograph, Photographer
from handeye.cell.posed import posed
from handeye.core.entries import require
from handeye.core.errors import BadFile, Taken
from handeye.core.files import check_place, write_over
from handeye.report.facts.scene import check_scene
from handeye.report.facts.seen import SeenPicture
from handeye.report.recorded import Recorded
from handeye.trace.trace import Trace
from handeye.video.captions import captioned
from handeye.video.formats import format_of
from handeye.video.storyboard import Frame, Storyboard, storyboard
from handeye.video.wanted import Wanted
from handeye.vision.drawing import annotate

_FINER: Final = 2
"""Points of the drawing for one of a frame, along a side."""
_SHADOW: Final = 2048

Told = Callable[[int, int], None]
"""Is told how many frames are drawn, and of how many."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Video:
    """A video that was written."""

    path: Path
    seconds: float
    """How long it is."""
    frames: int
    """How many were drawn; the last one stands for a while."""
    bytes: int


def make_video(
    trace: Trace, path: Path, wanted: Wanted, *, overwrite: bool, told: Told = lambda done, of: None
) -> Video:
    """Write a video of a recorded run, whole or not at all. Nothing is simulated; raises Taken if a video is there, and
    may not be replaced and raises InvalidInput if there can be no such video, it cannot be written there, the run is of
    another scene, or there is no OpenGL here.

    Args:
        overwrite: a video that is there may be replaced.
    """
    require(trace.head.system, "video", trace.name)
    form = format_of(path)
    check_place(path, form.kind)
    if path.exists() and not overwrite:
        raise Taken(f"{path} is there already; --overwrite replaces it")
    check_scene(Recorded(trace=trace))
    board = storyboard(trace, wanted)
    form.check(len(board.frames), wanted.width, wanted.height)
    data = form.encode(_drawn(trace, board, wanted, told), board.held)
    write_over(path, data, form.kind)
    return Video(path=path, seconds=board.seconds, frames=len(board.frames), bytes=len(data))


def _drawn(trace: Trace, board: Storyboard, wanted: Wanted, told: Told) -> Iterator[Photograph]:
    """The frames, one after the other."""
    photographer = Photographer(
        trace.scene, width=_FINER * wanted.width, height=_FINER * wanted.height, shadow=_SHADOW
    )
    for number, frame in enumerate(board.frames):
        told(number, len(board.frames))
        fine = photographer.take(*posed(trace.scene, trace.at(frame.time).poses, frame.time), frame.view)
        small = cv2.resize(fine, (wanted.width, wanted.height), interpolation=cv2.INTER_AREA)
        yield _said(np.asarray(small, dtype=np.uint8), frame)


def _said(drawn: Photograph, frame: Frame) -> Photograph:
    """A frame with what is said over it."""
    if frame.caption is None:
        return drawn
    return captioned(drawn, frame.caption, None if frame.looked_at is None else _marked(frame.looked_at))


def _marked(seen: SeenPicture) -> Photograph:
    """A picture that the program took, with what it found in it; raises InvalidInput if that is so far outside that it
    cannot be drawn.
    """
    try:
        return annotate(seen.picture, seen.marks, scale=1)[:, :, ::-1]
    except ValueError:
        raise BadFile(f"the findings in picture {seen.name} cannot be drawn") from None
