"""Video formats: animated WebP and WebM, which browsers play and OpenCV writes."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from handeye.core.errors import BadArgument
from handeye.core.files import Kind
from handeye.video.frames import Frames
from handeye.video.webm import webm
from handeye.video.webp import webp

_MAX_BYTES: Final = 1 << 30  # of a WebP animation's frames, all in memory at once


@dataclass(frozen=True, slots=True, kw_only=True)
class Format:
    """A video format."""

    kind: Kind
    encode: Callable[[Frames, int], bytes]  # frames, and periods to hold the last one, to a file
    largest: int | None  # limit on bytes of all frames
    even: bool  # needs even sides

    def check(self, frames: int, width: int, height: int) -> None:
        """Raise BadArgument for an impossible size or length."""
        if self.even and (width % 2 or height % 2):
            raise BadArgument(
                f"a {self.kind.name} of {width} x {height} cannot be made; both sides must be even"
            )
        if self.largest is not None and frames * width * height * 3 > self.largest:
            raise BadArgument(
                f"{frames} frames of {width} x {height} are too many for a {self.kind.name}, "
                "which is made in memory; make a .webm, or a shorter or smaller one"
            )


def format_of(path: Path) -> Format:
    """The format of a file name; raises BadArgument."""
    ending = path.suffix.lower()
    if ending in FORMATS:
        return FORMATS[ending]
    why = next((reason for endings, reason in REFUSED.items() if ending in endings), None)
    if why is None:
        raise BadArgument(f"{path}: the name of a video ends in {' or '.join(FORMATS)}")
    raise BadArgument(f"{path}: {why}; make a {' or a '.join(FORMATS)}")


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
}
REFUSED: Final = {
    (".gif",): "a GIF would be seven times as large, in 256 colours",
    (".png", ".apng"): "an animated PNG would be twenty times as large",
    (".mp4", ".m4v", ".mov"): "every browser would play H.264 there, which OpenCV does not write",
}
"""Endings that are refused, and why."""
