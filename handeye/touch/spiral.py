"""Search patterns: the square spiral and the line."""

import math
from collections.abc import Callable

SearchPattern = Callable[[int], tuple[float, float] | None]
"""Function that takes the number k of a place, counted from 0, and returns the offset of this place in search steps
along x and y of the table. After the last place, it returns None.
"""


def spiral(k: int) -> tuple[int, int]:
    """Return place `k`, counted from 0, of the square spiral: (0,0) (1,0) (1,1) (0,1) (-1,1) (-1,0) (-1,-1) (0,-1)
    (1,-1) (2,-1) ...

    The straight runs are 1, 1, 2, 2, 3, 3, ... steps long, with left turns between them. With a search step s,
    every point of the plane is within s / sqrt(2) of a place.
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
    """Return place `k`, counted from 0, on a line in the given direction (rad from x). The places are 0, 1, -1, 2, -2
    ... steps from the start.
    """
    along = (k + 1) // 2 * (1 if k % 2 else -1)
    return along * math.cos(direction), along * math.sin(direction)
