"""How long a motor takes for a number of steps: short, medium and long profiles, in whole microseconds."""

import math
from typing import Final, NamedTuple


class Curve(NamedTuple):
    """How a motor accelerates: steps/s and steps/s2."""

    start: float
    top: float
    acceleration: float  # mean


CURVES: Final = (
    Curve(1000.0, 13_333.0, 56_000.0),
    Curve(1000.0, 15_000.0, 56_000.0),
    Curve(1000.0, 13_333.0, 28_000.0),
    Curve(1000.0, 13_333.0, 14_000.0),
    Curve(500.0, 13_333.0, 56_000.0),
)
SHORT: Final = 8  # steps, at start/stop speed throughout


def move_us(steps: int, curve: int = 0, limit: int = 0) -> int:
    """The time of a move by `steps` along a curve, microseconds; `limit` is in steps/s, 0: none."""
    start, top, acceleration = CURVES[curve if curve < len(CURVES) else 0]
    if limit:
        top = min(top, float(limit))
    start = min(start, top)
    if steps <= SHORT or top <= start:
        return math.ceil(steps / start * 1e6)
    peak = math.sqrt(start * start + steps * acceleration)
    if peak <= top:
        return math.ceil(2 * (peak - start) / acceleration * 1e6)
    ramps = 2 * (top - start) / acceleration
    level = steps - (top * top - start * start) / acceleration
    return math.ceil((ramps + level / top) * 1e6)


def slow_us(steps: int, speed: float) -> int:
    """The time of a move at one speed (steps/s), microseconds; above start/stop speed it has ramps."""
    return math.ceil(steps / speed * 1e6) if speed <= CURVES[0].start else move_us(steps, 0, round(speed))
