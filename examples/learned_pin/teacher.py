"""The teacher: it answers the features that the learned policy sees, and nothing else. So it knows no truth."""

from typing import Final

import numpy as np

from handeye.core.pose import Array

START: Final = 0.33  # height of the pin's end over the face at the start, as taught, in units of 10 mm
PITCH: Final = 1.8e-3 / (2 * np.pi)  # of the spiral, m per rad: it passes within .9 mm of every place
SEARCH: Final = 0.8  # speed along the spiral, in units of 10 mm/s, as are all speeds
DESCENT: Final = 0.3  # where metal may meet metal: 3 mm/s
QUICK: Final = 1.5  # in the hole
YIELD: Final = 0.4  # lateral speed per 2 mm of lateral lag: the hand follows the chamfer
ENTERED: Final = 1.2  # depth below the face that was felt at which the pin is in the hole, mm
UNFELT: Final = 4.0  # the same if no face was felt: more, because its height is less well known
NEARLY: Final = 15.5  # depth from which the shoulder may touch the face, mm
DEEP: Final = 16.5  # least depth of a seated pin, mm; its nose is 19 mm long
JAMMED, PRESSED, PRESSING = -3.0, -3.3, -4.5  # vertical lag of the hand, mm; 1 mm is about 5 N


def answer(features: Array) -> Array:
    """Return radial, tangential and vertical speed and `done` for the features, shape (10,)."""
    radius, height, over, touched, radial, tangential, lag, averaged, rise, _ = features
    felt = (
        touched and height - over > -0.8
    )  # the first contact was on the face, not at the bottom of the hole
    depth = -10 * (over if felt else height + START)  # of the pin's end below the face, mm
    if depth < (ENTERED if felt else UNFELT):
        return np.array([*_spiral(radius), _kept(lag), 0.0] if felt else [0.0, 0.0, -DESCENT, 0.0])
    aside = -np.array([radial, tangential]) * YIELD
    if depth < NEARLY:
        along = _spiral(radius) / 2 if 2 * averaged < JAMMED else aside
        return np.array([*along, 0.0 if 2 * lag < JAMMED else -QUICK, 0.0])
    seated = depth > DEEP and 2 * averaged < PRESSED and abs(rise) < 0.2  # mm
    return np.array([*aside, 0.0 if 2 * lag < PRESSING else -DESCENT, float(seated)])


def _spiral(radius: float) -> Array:
    """Return radial and tangential speed along an Archimedean spiral, at a radius in units of 5 mm."""
    r = radius * 5e-3
    return SEARCH * np.array([PITCH, r]) / np.hypot(PITCH, r)


def _kept(lag: float) -> float:
    """Return the vertical speed that keeps the pin pressed on the face with about 10 N."""
    return float(np.clip(-(2 * lag + 2.0) * 0.4, -1.0, 1.0))
