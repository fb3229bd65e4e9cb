"""Recognises a live camera by the noise of its pictures: two live pictures always differ, and their noise is
limited.
"""

import math
from typing import Final

import numpy as np

from handeye.ports.camera import Picture

MAX_NOISE: Final = 1.6
"""Greatest plausible noise, as a standard deviation in intensity levels; the simulated vidicon has a noise of 1. We
chose a limit between two measured values: fault-free pictures of two worlds have at most 1.06, and pictures with hum
and snow of 2 levels have 2.07 or more.
"""
_WHITE: Final = 15  # the highest level
_MEDIAN: Final = 0.6745 * math.sqrt(6)  # median of second differences of noise of 1 level
_ENOUGH: Final = 1000  # points whose noise can be judged, at least


def blank(picture: Picture) -> bool:
    """Return True if all points have the same intensity."""
    return bool(picture.min() == picture.max())


def repeated(picture: Picture, earlier: Picture) -> bool:
    """Return True if two pictures are equal at every point."""
    return np.array_equal(picture, earlier)


def noise(picture: Picture) -> float:
    """Estimate the noise of a picture, as a standard deviation in intensity levels. The estimate is computed from the
    deviation of each point from the mean of its neighbours on the same picture line.

    The estimate uses the median of these deviations, because the few edges in a picture hardly change the median.
    Points that are completely black or completely white show no noise and do not count.
    """
    levels = picture.astype(np.int16)
    counts = (levels > 0) & (levels < _WHITE)
    counts = counts[:, :-2] & counts[:, 1:-1] & counts[:, 2:]
    differences = np.abs(levels[:, :-2] - 2 * levels[:, 1:-1] + levels[:, 2:])[counts]
    if len(differences) < _ENOUGH:
        return 0.0
    share = np.cumsum(np.bincount(differences)) / len(differences)
    return (
        float(np.interp(0.5, share, np.arange(len(share)) + 0.5)) / _MEDIAN
    )  # a whole level stands for values up to half a level above it
