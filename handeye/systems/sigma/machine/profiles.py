"""Durations of moves of a motor, by number of steps: short, medium and long profiles, in whole microseconds."""

import math

from handeye.systems.sigma.motors.pulses import CURVES, SHORT


def move_us(steps: int, curve: int = 0, limit: int = 0) -> int:
    """Duration of a move by `steps` along a curve, microseconds; `limit` is in steps/s, 0: none."""
    form = CURVES[curve if curve < len(CURVES) else 0]
    start, top, acceleration = form.start, form.top, form.acceleration
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
    """Duration of a move at one speed (steps/s), microseconds; above start/stop speed it has ramps."""
    return math.ceil(steps / speed * 1e6) if speed <= CURVES[0].start else move_us(steps, 0, round(speed))
