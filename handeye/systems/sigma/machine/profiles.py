"""Computes how long a move of a motor takes. The duration depends on the number of steps and on the speed profile
(short, medium or long). Durations are in whole microseconds.
"""

import math

from handeye.systems.sigma.motors.pulses import CURVES, SHORT


def move_us(steps: int, curve: int = 0, limit: int = 0) -> int:
    """Return the duration (microseconds) of a move by `steps` with an acceleration curve. `limit` is a speed limit
    (steps/s); 0 means no limit.
    """
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
    """Return the duration (microseconds) of a move at a constant speed (steps/s). Above the start/stop speed,
    the move begins and ends with ramps."""
    return math.ceil(steps / speed * 1e6) if speed <= CURVES[0].start else move_us(steps, 0, round(speed))
