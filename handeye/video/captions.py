"""Draws captions on video frames: the present stage among all stages, the clock, and pictures."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from handeye.cell.photograph import Photograph

Mask = NDArray[np.float32]  # Ink coverage of each point, 0 to 1, shape (height, width)
_BAND, _BAR, _LETTERS, _MARGIN = 0.105, 0.016, 0.05, 0.025
"""Heights of the caption band, of the stage bar below it and of the letters, and width of the margin, as fractions
of the frame's height.
"""
_DARK: Final = 0.35  # remaining brightness under the caption
_MIN_SCALE: Final = 0.6  # least scale of the letters; words that are still too long are cut
_INK: Final = np.array([255, 250, 240], dtype=np.float32)
DONE: Final = np.array([228, 164, 52], dtype=np.uint8)
STOPPED: Final = np.array([214, 48, 40], dtype=np.uint8)
TO_COME: Final = np.array([70, 70, 74], dtype=np.uint8)
_INSET: Final = 0.42  # height of a picture, as a fraction of the frame's height
_FINER: Final = 4
_FONT: Final = cv2.FONT_HERSHEY_SIMPLEX


@dataclass(frozen=True, slots=True, kw_only=True)
class Caption:
    """The content of a frame's caption."""

    words: str
    clock: str
    stages: int  # number of all stages
    begun: int  # number of stages that have begun
    stopped: bool  # True if the last stage was stopped


def captioned(frame: Photograph, caption: Caption, inset: Photograph | None) -> Photograph:
    """Return a frame with a caption at its lower edge. If `inset` is a picture, it is put into the upper right
    corner."""
    said = frame.copy()
    if inset is not None:
        _put_inset(said, inset)
    _put_words(said, caption)
    _put_bar(said, caption)
    return said


def _put_inset(frame: Photograph, inset: Photograph) -> None:
    """Put a picture with a white border into the upper right corner."""
    height = max(round(_INSET * len(frame)), 1)
    width = min(round(height * inset.shape[1] / inset.shape[0]), frame.shape[1])
    edge = max(len(frame) // 180, 1)
    small = cv2.resize(inset, (width, height), interpolation=cv2.INTER_AREA)
    framed = cv2.copyMakeBorder(small, edge, edge, edge, edge, cv2.BORDER_CONSTANT, value=(240, 240, 235))
    margin = round(_MARGIN * len(frame))
    place = frame[margin:, ::-1][: len(framed), margin : margin + framed.shape[1]]
    place[:] = framed[: len(place), ::-1][:, : place.shape[1]]


def _put_words(frame: Photograph, caption: Caption) -> None:
    """Write the stage (left) and the clock (right) on a darkened band."""
    height, width = frame.shape[:2]
    top, bottom = round((1 - _BAND - _BAR) * height), round((1 - _BAR) * height)
    band = frame[top:bottom]
    margin = round(2 * _MARGIN * height)
    clock = lettered(caption.clock, band.shape[:2], width, right=True, margin=margin)
    columns = np.flatnonzero(clock.any(axis=0))
    free = width - 3 * margin - (int(np.ptp(columns)) if len(columns) else 0)
    ink = np.maximum(clock, lettered(caption.words, band.shape[:2], free, margin=margin))[..., None]
    band[:] = (band * _DARK * (1 - ink) + _INK * ink).astype(np.uint8)


def _put_bar(frame: Photograph, caption: Caption) -> None:
    """Draw a segment for each stage: done, stopped, or not yet begun."""
    height, width = frame.shape[:2]
    bar = frame[round((1 - _BAR) * height) :]
    bar[:] = 0
    edges = np.linspace(0, width, caption.stages + 1).round().astype(int)
    for number, (begin, end) in enumerate(pairwise(edges)):
        last = number == caption.begun - 1
        colour = TO_COME if number >= caption.begun else STOPPED if last and caption.stopped else DONE
        bar[:, begin : max(end - 1, begin + 1)] = colour


def lettered(words: str, size: Sequence[int], room: int, *, margin: int, right: bool = False) -> Mask:
    """Return the mask of a band of `size` (height, width) with a line of text halfway up. The text is at most `room`
    pixels wide, and begins `margin` pixels from the left edge. If `right` is True, the text ends `margin` pixels from
    the right edge.
    """
    height, width = size
    words, scale = _fitted(words, _FINER * height * _LETTERS / _BAND / _extent("M", 1)[1], _FINER * room)
    long, high = _extent(words, scale)
    left = _FINER * (width - margin) - long if right else _FINER * margin
    large = np.zeros((_FINER * height, _FINER * width), dtype=np.uint8)
    place = left, (_FINER * height + high) // 2
    cv2.putText(large, words, place, _FONT, scale, 255, _weight(scale), cv2.LINE_AA)
    small = cv2.resize(large, (width, height), interpolation=cv2.INTER_AREA)
    return np.asarray(small / np.float32(255), dtype=np.float32)


def _fitted(words: str, scale: float, room: int) -> tuple[str, float]:
    """Make words fit into a width (pixels): first reduce their scale, then cut them. Returns the words and the
    scale."""
    least = _MIN_SCALE * scale
    while scale > least and _extent(words, scale)[0] > room:
        scale *= 0.95
    whole = words
    while words and _extent(words, scale)[0] > room:
        whole = whole[:-1]
        words = f"{whole.rstrip()}..." if whole else ""
    return words, scale


def _extent(words: str, scale: float) -> tuple[int, int]:
    """Return the width and height of words (pixels)."""
    (long, high), _ = cv2.getTextSize(words, _FONT, scale, _weight(scale))
    return long, high


def _weight(scale: float) -> int:
    return max(round(1.6 * scale), 1)
