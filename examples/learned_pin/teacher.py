"""The teacher: it answers the features that the learned policy sees, and nothing else. So it knows no truth."""

from typing import Final

import numpy as np

from handeye.core.pose import Array

PITCH: Final = 1.8e-3 / (2 * np.pi)  # of the spiral, m per rad: it passes within .9 mm of every place
SEARCH: Final = 0.8  # along the spiral, in units of 10 mm/s
DESCENT: Final = 0.3  # where metal may meet metal: 3 mm/s
QUICK: Final = 1.5  # in the hole


def answer(features: Array) -> Array:
    """Return radial, tangential and vertical speed (units of 10 mm/s) and `done` for the features, shape (10,)."""
    radius, height, over, touched, radial, tangential, lag, averaged, rise, _ = features
    felt = touched and height - over > -0.8  # on the face, not at the bottom of the hole
    depth = -10 * (over if felt else height + 0.33)  # of the pin's end below the face, mm
    if depth < (1.2 if felt else 4.0):
        return (
            np.array([*_spiral(radius), _pressing(lag), 0.0]) if felt else np.array([0.0, 0.0, -DESCENT, 0.0])
        )
    aside = -np.array([radial, tangential]) * 0.4  # follow the chamfer
    if depth < 15.5:
        stuck = 2 * averaged < -3.0
        return np.array([*(_spiral(radius) / 2 if stuck else aside), 0.0 if 2 * lag < -3.0 else -QUICK, 0.0])
    seated = depth > 16.5 and 2 * averaged < -3.3 and abs(rise) < 0.2
    return np.array([*aside, 0.0 if 2 * lag < -4.5 else -DESCENT, float(seated)])


def _spiral(radius: float) -> Array:
    """Return the direction of an Archimedean spiral at a radius (units of 5 mm), times the speed of the search."""
    r = radius * 5e-3
    return SEARCH * np.array([PITCH, r]) / np.hypot(PITCH, r)


def _pressing(lag: float) -> float:
    """Return the vertical speed that keeps the pin pressed on the face with about 10 N."""
    return float(np.clip(-(2 * lag + 2.0) * 0.4, -1.0, 1.0))
