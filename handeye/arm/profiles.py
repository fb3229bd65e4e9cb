"""Profiles: set-points of a straight way from one place of all axes to another, one a period."""

import math
from collections.abc import Iterator

import numpy as np

from handeye.core.pose import Array

_PEAK_SPEED = 1.875
"""Of a quintic: its greatest speed is so many times its mean one."""
_PEAK_ACCELERATION = 5.774
"""Its greatest acceleration is so many times the way by the square of the time."""


def quintic(start: Array, goal: Array, speed: Array, acceleration: Array, period: float) -> Iterator[Array]:
    """Set-points of a fast way that begins and ends at rest, without a jerk: all axes arrive together.

    Args:
        start: where the axes are, shape (n,), as `goal`.
        speed: greatest of each axis, shape (n,), as `acceleration`.
        period: s between two set-points.
    """
    way = np.abs(goal - start)
    longest = max(
        np.max(_PEAK_SPEED * way / speed), math.sqrt(np.max(_PEAK_ACCELERATION * way / acceleration))
    )
    steps = max(1, math.ceil(longest / period))
    for step in range(1, steps + 1):
        s = step / steps
        yield start + (goal - start) * s**3 * (10 - 15 * s + 6 * s * s)


def slow_line(start: Array, goal: Array, speed: Array, period: float) -> Iterator[Array]:
    """Set-points of a slow way at an even speed, at any of which one can stop without harm.

    Args:
        start: where the axes are, shape (n,), as `goal`.
        speed: of each axis at most, shape (n,).
        period: s between two set-points.
    """
    steps = max(1, math.ceil(float(np.max(np.abs(goal - start) / speed)) / period))
    for step in range(1, steps + 1):
        yield start + (goal - start) * (step / steps)
