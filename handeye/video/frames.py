"""Frames of a video."""

from collections.abc import Iterator
from typing import Final

import numpy as np

from handeye.cell.photograph import Photograph

RATE: Final = 12  # frames a second
Frames = Iterator[Photograph]


def bgr(frame: Photograph) -> Photograph:
    """A frame in OpenCV's order: blue, green, red."""
    return np.ascontiguousarray(frame[:, :, ::-1])
