"""Animated WebP files, by OpenCV."""

from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from handeye.cell.photograph import Photograph
from handeye.video.frames import RATE, Frames, bgr

_QUALITY: Final = 75
_ALIKE: Final = 5
"""Differences that libwebp ignores at this quality."""
_BLOCK: Final = 8  # side of an ignored block, points


def webp(frames: Frames, held: int) -> bytes:
    """A looping animated WebP file; the last frame is held for `held` periods."""
    animation = cv2.Animation()
    animation.frames = [bgr(frame) for frame in settled(frames)]
    ends = np.arange(1, len(animation.frames) + 1)
    ends[-1] += held
    animation.durations = np.diff(np.round(1000 * ends / RATE), prepend=0).astype(int).tolist()
    done, data = cv2.imencodeanimation(".webp", animation, [cv2.IMWRITE_WEBP_QUALITY, _QUALITY])
    assert done
    return bytes(data)


def settled(frames: Frames) -> Frames:
    """Frames whose blocks change only when they differ enough from what is shown.

    libwebp skips what resembles the frame before, so that slow changes would never be shown.
    """
    shown = next(frames)
    yield shown
    for frame in frames:
        shown = np.where(_changed(frame, shown)[..., None], frame, shown)
        yield shown


def _changed(frame: Photograph, shown: Photograph) -> NDArray[np.bool_]:
    """Mask of the points in blocks with a sufficient difference, shape (height, width)."""
    height, width = frame.shape[:2]
    rows, columns = -(-height // _BLOCK), -(-width // _BLOCK)
    differs = np.zeros((rows * _BLOCK, columns * _BLOCK), dtype=bool)
    differs[:height, :width] = (cv2.absdiff(frame, shown) > _ALIKE).any(axis=2)
    blocks = differs.reshape(rows, _BLOCK, columns, _BLOCK).any(axis=(1, 3))
    return blocks.repeat(_BLOCK, axis=0).repeat(_BLOCK, axis=1)[:height, :width]
