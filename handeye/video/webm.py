"""WebM files (VP8), by OpenCV with FFmpeg."""

import os
import re
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Final

import cv2

from handeye.core.errors import Refused
from handeye.video.frames import RATE, Frames, bgr

_TRACK: Final = re.compile(rb"\x73\xc5\x88(.{8})", re.DOTALL)
"""Track number of a WebM file, random in FFmpeg: identifier, length, eight bytes."""


def webm(frames: Frames, held: int) -> bytes:
    """A WebM file (VP8), reproducible to the byte; the last frame is held for `held` periods."""
    frame = next(frames)
    height, width = frame.shape[:2]
    with tempfile.TemporaryDirectory(prefix="handeye-") as folder:
        path = Path(folder) / "video.webm"
        writer = _writer(path, width, height)
        writer.write(bgr(frame))
        for frame in frames:
            writer.write(bgr(frame))
        for _ in range(held):
            writer.write(bgr(frame))
        writer.release()
        return _numbered(path.read_bytes())


def _writer(path: Path, width: int, height: int) -> cv2.VideoWriter:
    with _quiet():
        writer = cv2.VideoWriter(
            str(path), cv2.CAP_FFMPEG, cv2.VideoWriter.fourcc(*"VP80"), RATE, (width, height)
        )
    if not writer.isOpened():
        raise Refused("the OpenCV of this machine writes no WebM; make a .webp")
    return writer


@contextmanager
def _quiet() -> Iterator[None]:
    """Silence OpenCV's warning on standard error about the name VP80."""
    try:
        kept = os.dup(2)
    except OSError:  # there is no standard error
        yield
        return
    with open(os.devnull, "wb") as nothing:
        os.dup2(nothing.fileno(), 2)
    try:
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)


def _numbered(data: bytes) -> bytes:
    """A WebM file with track number 1."""
    track = _TRACK.search(data)
    return data if track is None else data.replace(track[1], (1).to_bytes(8))
