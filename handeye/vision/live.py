"""Tells a live camera's picture by its noise, which makes any two differ and never exceeds what it should."""

import math
from statistics import NormalDist
from typing import Final

import numpy as np

from handeye.ports.camera import Picture

MAX_NOISE: Final = 1.6
"""Greatest plausible noise, sigma in levels; 1 is stated. Chosen: sound pictures of two worlds show up to 1.05, those
with hum and snow of 2 levels 2.03 and more."""
_WHITE: Final = 15  # the highest level
_FLAT: Final = 3  # second difference, levels, that noise of 1 level seldom exceeds
_ENOUGH: Final = 1000  # points whose noise can be judged, at least


def blank(picture: Picture) -> bool:
    """True if all points have one intensity."""
    return bool(picture.min() == picture.max())


def repeated(picture: Picture, earlier: Picture) -> bool:
    """True if two pictures are equal."""
    return np.array_equal(picture, earlier)


def noise(picture: Picture) -> float:
    """Noise of a picture, sigma in levels, by how points differ from the mean of their neighbours on the line.

    Edges are few, so the share of small differences gives it. Black and white points show no noise, and do not count.
    """
    levels = picture.astype(np.int16)
    counts = (levels > 0) & (levels < _WHITE)
    counts = counts[:, :-2] & counts[:, 1:-1] & counts[:, 2:]
    differences = np.abs(levels[:, :-2] - 2 * levels[:, 1:-1] + levels[:, 2:])[counts]
    if len(differences) < _ENOUGH:
        return 0.0
    share = min(float((differences <= _FLAT).mean()), 1 - 1e-9)
    return (_FLAT + 0.5) / (math.sqrt(6) * NormalDist().inv_cdf((1 + share) / 2)) if share > 0 else math.inf
