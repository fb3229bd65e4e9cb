"""The square spiral, and the line, in which nearby places are searched."""

import math
from collections.abc import Callable

SearchPattern = Callable[[int], tuple[float, float] | None]
"""The place of a number, from 0, in steps of the search along x and y of the table; None: there are no more."""


def spiral(k: int) -> tuple[int, int]:
    """Grid place number `k`, from 0: (0,0) (1,0) (1,1) (0,1) (-1,1) (-1,0) (-1,-1) (0,-1) (1,-1) (2,-1) ...

    The straight runs are 1, 1, 2, 2, 3, 3, ... long, turning left. On a grid of step s every point of the
    plane is within s / sqrt(2) of a place.
    """
    if k == 0:
        return 0, 0
    ring = (math.isqrt(k) + 1) // 2  # ring n ends at the place (n, -n), number (2n + 1)^2 - 1
    side, along = divmod(k - (2 * ring - 1) ** 2, 2 * ring)
    match side:
        case 0:
            return ring, along - ring + 1
        case 1:
            return ring - 1 - along, ring
        case 2:
            return -ring, ring - 1 - along
    return along - ring + 1, -ring


def line(k: int, direction: float) -> tuple[float, float]:
    """Place number `k`, from 0, on a line in a direction (rad from x): 0, then 1, -1, 2, -2 ... steps along it."""
    along = (k + 1) // 2 * (1 if k % 2 else -1)
    return along * math.cos(direction), along * math.sin(direction)
