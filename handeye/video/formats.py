"""Video formats: animated WebP, WebM and MP4. OpenCV writes WebP and WebM. MP4 needs the optional dependency `mp4`."""

import os
import re
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from handeye.cell.photograph import Photograph
from handeye.core.errors import BadArgument, MissingExtra, Refused
from handeye.core.files import Kind

RATE: Final = 12  # frames a second
Frames = Iterator[Photograph]


def bgr(frame: Photograph) -> Photograph:
    """Return a frame in OpenCV's colour order, which is blue, green, red."""
    return np.ascontiguousarray(frame[:, :, ::-1])


_QUALITY: Final = 75
_ALIKE: Final = 5  # Differences that libwebp ignores at this quality
_BLOCK: Final = 8  # side of an ignored block, points


def webp(frames: Frames, held: int) -> bytes:
    """Encode an animated WebP file that loops. `held` is the number of frame periods for which the last frame stays."""
    animation = cv2.Animation()
    animation.frames = [bgr(frame) for frame in settled(frames)]
    ends = np.arange(1, len(animation.frames) + 1)
    ends[-1] += held
    animation.durations = np.diff(np.round(1000 * ends / RATE), prepend=0).astype(int).tolist()
    done, data = cv2.imencodeanimation(".webp", animation, [cv2.IMWRITE_WEBP_QUALITY, _QUALITY])
    assert done
    return bytes(data)


def settled(frames: Frames) -> Frames:
    """Yield the frames without small changes. A block of pixels is replaced only when the new block differs enough
    from the shown block.

    libwebp leaves out blocks that resemble the blocks of the previous frame. Without this function, slow changes
    would never be shown.
    """
    shown = next(frames)
    yield shown
    for frame in frames:
        shown = np.where(_changed(frame, shown)[..., None], frame, shown)
        yield shown


def _changed(frame: Photograph, shown: Photograph) -> NDArray[np.bool_]:
    """Return a mask, shape (height, width), of the blocks in which the two pictures differ by more than `_ALIKE`."""
    height, width = frame.shape[:2]
    rows, columns = -(-height // _BLOCK), -(-width // _BLOCK)
    differs = np.zeros((rows * _BLOCK, columns * _BLOCK), dtype=bool)
    differs[:height, :width] = (cv2.absdiff(frame, shown) > _ALIKE).any(axis=2)
    blocks = differs.reshape(rows, _BLOCK, columns, _BLOCK).any(axis=(1, 3))
    return blocks.repeat(_BLOCK, axis=0).repeat(_BLOCK, axis=1)[:height, :width]


_TRACK: Final = re.compile(rb"\x73\xc5\x88(.{8})", re.DOTALL)
"""Pattern of the track number of a WebM file: identifier, length, eight bytes. FFmpeg chooses the track number at
random.
"""


def webm(frames: Frames, held: int) -> bytes:
    """Encode a WebM file (VP8). Equal frames give equal bytes. `held` is the number of frame periods for which the
    last frame is held.
    """
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
        data = path.read_bytes()
        track = _TRACK.search(data)
        return data if track is None else data.replace(track[1], (1).to_bytes(8))


def _writer(path: Path, width: int, height: int) -> cv2.VideoWriter:
    with _quiet():
        writer = cv2.VideoWriter(
            str(path), cv2.CAP_FFMPEG, cv2.VideoWriter.fourcc(*"VP80"), RATE, (width, height)
        )
    if not writer.isOpened():
        raise Refused("OpenCV on this machine cannot write WebM; choose a name that ends in .webp")
    return writer


@contextmanager
def _quiet() -> Iterator[None]:
    """Within this context, suppress OpenCV's warning on standard error about the name VP80."""
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


_MP4_QUALITY: Final = "23"  # quality of x264: 0 is lossless, 51 is the worst


def mp4(frames: Frames, held: int) -> bytes:
    """Encode an MP4 file (H.264), which nearly all video players and presentation programs can play. `held` is the
    number of frame periods for which the last frame is held.
    """
    import av

    with tempfile.TemporaryDirectory(prefix="handeye-") as folder:
        path = Path(folder) / "video.mp4"
        with av.open(path, "w", options={"movflags": "faststart"}) as video:
            first = frame = next(frames)
            stream = video.add_stream("libx264", rate=RATE, options={"crf": _MP4_QUALITY, "threads": "1"})
            stream.height, stream.width = first.shape[:2]
            stream.pix_fmt = "yuv420p"
            for frame in chain([first], frames):
                video.mux(stream.encode(av.VideoFrame.from_ndarray(frame, format="rgb24")))
            for _ in range(held):
                video.mux(stream.encode(av.VideoFrame.from_ndarray(frame, format="rgb24")))
            video.mux(stream.encode())
        return path.read_bytes()


_MAX_BYTES: Final = 1 << 30  # limit on the frames of a WebP animation, which are all in memory at once


@dataclass(frozen=True, slots=True, kw_only=True)
class Format:
    """A video format."""

    kind: Kind
    encode: Callable[[Frames, int], bytes]  # takes frames, and the number of periods to hold the last one
    largest: int | None  # limit on bytes of all frames
    even: bool  # True if width and height must be even

    def check(self, frames: int, width: int, height: int) -> None:
        """Raise BadArgument if the size or length is impossible."""
        if self.even and (width % 2 or height % 2):
            raise BadArgument(
                f"a {self.kind.name} of {width} x {height} cannot be made; width and height must be even"
            )
        if self.largest is not None and frames * width * height * 3 > self.largest:
            raise BadArgument(
                f"{frames} frames of {width} x {height} are too many for a {self.kind.name}, "
                "which is built in memory; make a .webm, or a shorter or smaller video"
            )


def format_of(path: Path) -> Format:
    """Return the format for a file name. Raises BadArgument if no video format has the file's extension."""
    ending = path.suffix.lower()
    if ending == ".mp4":
        try:
            import av  # noqa: F401 - to see that it is here before anything is drawn
        except ImportError:
            raise MissingExtra("video -o FILE.mp4", "av", "mp4") from None
    if ending in FORMATS:
        return FORMATS[ending]
    why = next((reason for endings, reason in REFUSED.items() if ending in endings), None)
    if why is None:
        raise BadArgument(f"{path}: the name of a video must end in {' or '.join(FORMATS)}")
    raise BadArgument(f"{path}: {why}; use {' or '.join(FORMATS)}")


FORMATS: Final = {
    ".webp": Format(
        kind=Kind("WebP picture", rb"(?s)RIFF....WEBP", ending=".webp"),
        encode=webp,
        largest=_MAX_BYTES,
        even=False,
    ),
    ".webm": Format(
        kind=Kind("WebM video", rb"\x1a\x45\xdf\xa3", ending=".webm"), encode=webm, largest=None, even=True
    ),
    ".mp4": Format(
        kind=Kind("MP4 video", rb"(?s)....ftyp", ending=".mp4"), encode=mp4, largest=None, even=True
    ),
}
REFUSED: Final = {
    (".gif",): "a GIF would be seven times as large as a WebP picture, with only 256 colours",
    (".png", ".apng"): "an animated PNG would be twenty times as large as a WebP picture",
    (".m4v", ".mov"): "this format is not supported; an .mp4 holds the same H.264 video",
}
