"""Tells a live camera's picture by its noise, which makes any two differ."""

import numpy as np

from handeye.ports.camera import Picture


def blank(picture: Picture) -> bool:
    """True if all points have one intensity."""
    return bool(picture.min() == picture.max())


def repeated(picture: Picture, earlier: Picture) -> bool:
    """True if two pictures are equal."""
    return np.array_equal(picture, earlier)
