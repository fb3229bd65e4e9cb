"""The files that a video can be: animated WebP and WebM, which browsers play and OpenCV writes."""

import os
import re
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import cv2
import numpy as np

from handeye.cell.photograph import Photograph
from handeye.errors import InvalidInput
from handeye.files import Kind

RATE: Final = 12
"""Frames a second."""
_QUALITY: Final = 75
_MOST: Final = 1 << 30
"""Bytes of the frames of a WebP animation, which are all in memory at once."""
_TRACK: Final = re.compile(rb"\x73\xc5\x88(.{8})", re.DOTALL)
"""The number that a WebM file gives its track, which FFmpeg draws anew for each: identifier, length, eight bytes."""

Frames = Iterator[Photograph]


@dataclass(frozen=True, slots=True, kw_only=True)
class Format:
    """A kind of file for videos."""

    kind: Kind
    encode: Callable[[Frames, int], bytes]
    """Makes a file of the frames; the last one stands for so many periods longer."""
    largest: int | None
    """Bytes of all frames together, at most."""
    even: bool
    """Sides have an even number of points."""

    def check(self, frames: int, width: int, height: int) -> None:
        """See whether there can be such a video.

        Raises:
            InvalidInput: there cannot.
        """
        if self.even and (width % 2 or height % 2):
            raise InvalidInput(
                f"a {self.kind.name} of {width} x {height} cannot be made; both sides must be even"
            )
        if self.largest is not None and frames * width * height * 3 > self.largest:
            raise InvalidInput(
                f"{frames} frames of {width} x {height} are too many for a {self.kind.name}, "
                "which is made in memory; make a .webm, or a shorter or smaller one"
            )


def format_of(path: Path) -> Format:
    """The format that the name of a file asks for.

    Raises:
        InvalidInput: it is none, or one that is not written, for a reason that is told.
    """
    ending = path.suffix.lower()
    if ending in FORMATS:
        return FORMATS[ending]
    why = next((reason for endings, reason in REFUSED.items() if ending in endings), None)
    if why is None:
        raise InvalidInput(f"{path}: the name of a video ends in {' or '.join(FORMATS)}")
    raise InvalidInput(f"{path}: {why}; make a {' or a '.join(FORMATS)}")


def webp(frames: Frames, held: int) -> bytes:
    """An animated WebP file, which begins anew when it is over."""
    animation = cv2.Animation()
    animation.frames = [_bgr(frame) for frame in frames]
    ends = np.arange(1, len(animation.frames) + 1)
    ends[-1] += held
    animation.durations = np.diff(np.round(1000 * ends / RATE), prepend=0).astype(int).tolist()
    done, data = cv2.imencodeanimation(".webp", animation, [cv2.IMWRITE_WEBP_QUALITY, _QUALITY])
    assert done
    return bytes(data)


def webm(frames: Frames, held: int) -> bytes:
    """A WebM file (VP8), the same to the byte for the same frames.

    Raises:
        InvalidInput: this OpenCV cannot write any.
    """
    first = next(frames)
    height, width = first.shape[:2]
    with tempfile.TemporaryDirectory(prefix="handeye-") as folder:
        path = Path(folder) / "video.webm"
        writer = _writer(path, width, height)
        last = first
        writer.write(_bgr(first))
        for last in frames:
            writer.write(_bgr(last))
        for _ in range(held):
            writer.write(_bgr(last))
        writer.release()
        data = path.read_bytes()
    return _numbered(data)


def _writer(path: Path, width: int, height: int) -> cv2.VideoWriter:
    with _quiet():
        writer = cv2.VideoWriter(
            str(path), cv2.CAP_FFMPEG, cv2.VideoWriter.fourcc(*"VP80"), RATE, (width, height)
        )
    if not writer.isOpened():
        raise InvalidInput("the OpenCV of this machine writes no WebM; make a .webp")
    return writer


@contextmanager
def _quiet() -> Iterator[None]:
    """While OpenCV would say on standard error that VP80 is no name for what it writes under that name."""
    kept = os.dup(2)
    with open(os.devnull, "wb") as nothing:
        os.dup2(nothing.fileno(), 2)
    try:
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)


def _numbered(data: bytes) -> bytes:
    """A WebM file whose track has the number 1."""
    track = _TRACK.search(data)
    return data if track is None else data.replace(track[1], (1).to_bytes(8))


def _bgr(frame: Photograph) -> Photograph:
    """As OpenCV has colours."""
    return np.ascontiguousarray(frame[:, :, ::-1])


FORMATS: Final = {
    ".webp": Format(
        kind=Kind("WebP picture", rb"(?s)RIFF....WEBP", ending=".webp"),
        encode=webp,
        largest=_MOST,
        even=False,
    ),
    ".webm": Format(
        kind=Kind("WebM video", rb"\x1a\x45\xdf\xa3", ending=".webm"), encode=webm, largest=None, even=True
    ),
}
REFUSED: Final = {
    (".gif",): "a GIF would be seven times as large, in 256 colours",
    (".png", ".apng"): "an animated PNG would be twenty times as large",
    (".mp4", ".m4v", ".mov", ".avi", ".mkv"): "what OpenCV could write there, no browser plays",
}
"""Why files with these endings are not made."""
