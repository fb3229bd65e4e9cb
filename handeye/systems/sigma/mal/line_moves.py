"""Moves axes along a straight line although the axes are not synchronised. Each axis moves at constant speed, and
the axes wait for each other at intermediate points.
"""

import math
from collections.abc import Mapping, Sequence
from typing import Final

from handeye.systems.sigma.mal.memory import Outgoing
from handeye.systems.sigma.protocol import SLOW_STEP_MM, STEP_MM

FASTEST_CODE: Final = 18  # 36 mm/s, below start/stop speed, so that no axis has a ramp
_STRAIGHT_MM: Final = 0.4  # greatest deviation of the path of a part from the straight line


def line_moves(goals: Sequence[tuple[str, int]], counts: Mapping[str, int]) -> list[Outgoing]:
    """Return commands that move axes to their goals (steps) along a straight line, with a deviation of at most
    half a millimetre.

    Speeds can be set only in steps of 2 mm/s, so the ratio of the speeds only approximates the ratio of the
    distances. The path is therefore divided into parts. After each part, the axes wait for each other.
    """
    ways = {axis: target - counts.get(axis, 0) for axis, target in goals}
    moved = {axis: way for axis, way in ways.items() if way}
    if not moved:
        return []
    longest = max(map(abs, moved.values()))
    codes, off = min(
        (_codes(moved, longest, fastest) for fastest in range(FASTEST_CODE, FASTEST_CODE // 2, -1)),
        key=lambda found: found[1],
    )
    parts = max(1, math.ceil(off / _STRAIGHT_MM))
    axes = tuple(moved)
    return [
        Outgoing(
            to=axis,
            target=counts.get(axis, 0) + round(way * part / parts),
            slow=float(codes[axis] * SLOW_STEP_MM),
            after=axes if axis == axes[0] and part > 1 else (),
        )
        for part in range(1, parts + 1)
        for axis, way in moved.items()
    ]


def _codes(moved: Mapping[str, int], longest: int, fastest: int) -> tuple[dict[str, int], float]:
    """Return the codes of the speeds, and the resulting deviation from the straight line (mm). The axis with the
    longest distance moves at speed `fastest`.
    """
    codes = {axis: max(1, round(fastest * abs(way) / longest)) for axis, way in moved.items()}
    off = max(abs(codes[axis] / fastest - abs(way) / longest) for axis, way in moved.items())
    return codes, off * longest * STEP_MM
