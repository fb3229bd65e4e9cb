"""Set-points for straight motions of all axes in joint space, one per servo period."""

import math
from collections.abc import Iterator

import numpy as np

from handeye.core.pose import Array

PEAK_SPEED = 1.875  # of the quintic 10 s3 - 15 s4 + 6 s5, as a multiple of its mean
PEAK_ACCELERATION = 5.774  # as a multiple of distance / duration2


def quintic(start: Array, goal: Array, speed: Array, acceleration: Array, period: float) -> Iterator[Array]:
    """Yield the set-points of a fast quintic motion of n axes from rest to rest, one per period (s). All axes
    arrive together.
    """
    distance = np.abs(goal - start)
    longest = max(
        np.max(PEAK_SPEED * distance / speed),
        math.sqrt(np.max(PEAK_ACCELERATION * distance / acceleration)),
    )
    steps = max(1, math.ceil(longest / period))
    for step in range(1, steps + 1):
        s = step / steps
        yield start + (goal - start) * s**3 * (10 - 15 * s + 6 * s * s)


def slow_line(start: Array, goal: Array, speed: Array, period: float) -> Iterator[Array]:
    """Yield the set-points of a slow motion of n axes at constant speed, one per period (s). The motion may be
    stopped at any set-point.
    """
    steps = max(1, math.ceil(float(np.max(np.abs(goal - start) / speed)) / period))
    for step in range(1, steps + 1):
        yield start + (goal - start) * (step / steps)
