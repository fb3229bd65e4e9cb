"""Frames of a video, on their way into a file."""

from collections.abc import Iterator
from typing import Final

import numpy as np

from handeye.cell.photograph import Photograph

RATE: Final = 12
"""Frames a second."""
Frames = Iterator[Photograph]


def bgr(frame: Photograph) -> Photograph:
    """A frame as OpenCV has colours: blue, green, red."""
    return np.ascontiguousarray(frame[:, :, ::-1])
