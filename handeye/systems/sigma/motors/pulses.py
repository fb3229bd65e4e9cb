"""Computes the pulse trains of the motor microcomputers. A counter that divides a 2 MHz clock determines the
times of the steps.

A few numbers define a train. The times of the pulses are computed directly from these numbers, so the firmware need
not be simulated in small intervals of time.
"""

import math
from functools import cached_property, lru_cache
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from handeye.core.record import Record

CLOCK_HZ: Final = 2_000_000  # clock of the 8253
LARGEST_DIVIDER: Final = 0xFFFF  # the counters of the 8253 have 16 bits
SHORT: Final = 8  # a move of at most this many steps is made at start/stop speed
EMERGENCY: Final = 140_000.0  # steps/s2, the steepest ramp
SEEK: Final = 3_000.0  # steps/s towards the end of the rail
RELEASE: Final = 500.0  # steps/s away from the end of the rail
_GRID: Final = 512  # points of a ramp, between which its inverse is interpolated at first
_NEWTON: Final = 3

Ticks = NDArray[np.int64]  # ticks of the 2 MHz clock


class Curve(Record, frozen=True, kw_only=True):
    """An acceleration curve."""

    start: float = 1_000.0  # steps/s at which a motor may start and stop without a ramp
    top: float = 13_333.0  # steps/s
    acceleration: float = 56_000.0  # steps/s2: mean acceleration in a ramp


CURVES: Final = (
    Curve(),
    Curve(top=15_000.0),
    Curve(acceleration=28_000.0),
    Curve(acceleration=14_000.0),
    Curve(start=500.0),
)
"""Curves by number, as commands select them; an unknown number means the first curve."""


class Train(Record, frozen=True, kw_only=True):
    """A train of pulses. A train of the kind `profile` has `steps` pulses, begins and ends at the speed `start`, and
    does not exceed `top`. A train of the kind `stop` slows the motor down from the speed `top` until the motor stands
    still.
    """

    kind: Literal["profile", "stop"] = "profile"
    steps: int  # for a stop: the greatest number of steps
    start: float  # steps/s
    top: float
    acceleration: float = 0.0  # steps/s2

    @property
    def peak(self) -> float:
        """Greatest speed of the profile (steps/s)."""
        if self.steps <= SHORT or self.top <= self.start:
            return min(self.start, self.top)
        return min(self.top, math.sqrt(self.start**2 + self.steps * self.acceleration))

    @property
    def pulses(self) -> "Pulses":
        """The times of the steps."""
        return _pulses(self)


class Pulses:
    """The pulses of a train."""

    def __init__(self, ticks: Ticks) -> None:
        self.ticks = ticks  # time of each pulse after the command, in ascending order
        ticks.setflags(write=False)

    def __len__(self) -> int:
        return len(self.ticks)

    @property
    def end(self) -> int:
        """Number of ticks from the command to the last pulse; 0 if there is no pulse."""
        return int(self.ticks[-1]) if len(self.ticks) else 0

    @cached_property
    def dividers(self) -> Ticks:
        """For each pulse, the counter's divider for the interval that ends with this pulse."""
        return np.diff(self.ticks, prepend=0)

    def count(self, ticks: int) -> int:
        """Return the number of pulses up to a time (ticks)."""
        return int(np.searchsorted(self.ticks, ticks, side="right"))

    def speed(self, ticks: int) -> float:
        """Return the speed (steps/s) at a time given in ticks; 0 after the end."""
        done = self.count(ticks)
        return CLOCK_HZ / int(self.dividers[done]) if done < len(self.ticks) else 0.0

    @property
    def seconds(self) -> float:
        """Time from the command to the last pulse (s)."""
        return self.end / CLOCK_HZ


def profile(steps: int, curve: Curve, limit: float = 0.0) -> Train:
    """Return the pulse train of a move. A very short move has a constant speed. All other moves have a ramp up and a
    ramp down. Long moves have a constant speed between the ramps.

    Args:
        steps: number of steps, at least 1.
        limit: greatest speed (steps/s), or 0 for the greatest speed of the curve.
    """
    top = min(curve.top, float(limit)) if limit else curve.top
    return Train(steps=steps, start=min(curve.start, top), top=top, acceleration=curve.acceleration)


def constant(steps: int, speed: float, curve: Curve, limit: float = 0.0, *, ramped: bool = True) -> Train:
    """Return the pulse train of a move at constant speed (steps/s). If this speed is above the start/stop speed, the
    move begins and ends with a ramp, unless `ramped` is False.
    """
    speed = min(speed, float(limit)) if limit else speed
    start = min(curve.start, speed) if ramped else speed
    return Train(steps=steps, start=start, top=speed, acceleration=curve.acceleration)


def stop(speed: float, curve: Curve) -> Train:
    """Return the steepest ramp from a speed (steps/s) down to the speed at which a motor may stop."""
    steps = max(0, math.ceil((speed**2 - curve.start**2) / (2 * EMERGENCY)))
    return Train(kind="stop", steps=steps, start=curve.start, top=speed, acceleration=EMERGENCY)


def stopped(train: Train, curve: Curve, ticks: int, *, cut: bool = False) -> Pulses:
    """Return the pulses of a train that is interrupted after `ticks` ticks. The train ends with the steepest ramp or,
    if `cut` is True, abruptly. An abrupt stop is a fault.
    """
    pulses = train.pulses
    made = pulses.ticks[: pulses.count(ticks)]
    if cut:
        return Pulses(made.copy())
    return Pulses(np.concatenate((made, ticks + stop(pulses.speed(ticks), curve).pulses.ticks)))


@lru_cache(maxsize=512)
def _pulses(train: Train) -> Pulses:
    seconds = _stop_times(train) if train.kind == "stop" else _profile_times(train)
    dividers = np.rint(np.diff(seconds, prepend=0.0) * CLOCK_HZ).astype(np.int64)
    return Pulses(np.cumsum(np.clip(dividers, 1, LARGEST_DIVIDER)))


def _stop_times(train: Train) -> NDArray[np.float64]:
    """Return the times of the pulses of a train with constant deceleration."""
    speeds = np.sqrt(
        np.maximum(train.top**2 - 2 * train.acceleration * np.arange(1, train.steps + 1), train.start**2)
    )
    return np.asarray((train.top - speeds) / train.acceleration)


def _profile_times(train: Train) -> NDArray[np.float64]:
    """Return the times of the pulses of two ramps, and of the part between the ramps. The speeds on the ramps follow
    raised cosines.
    """
    steps, start, peak = train.steps, train.start, train.peak
    made = np.arange(1.0, steps + 1)
    if peak <= start:
        return made / peak
    ramp = (peak - start) / train.acceleration  # s
    length = (peak + start) * ramp / 2  # steps
    flat = max(0.0, steps - 2 * length) / peak  # s
    up, left = made <= length, steps - made
    down = left < length
    times = ramp + (made - length) / peak
    times[down] = 2 * ramp + flat - _ramp_times(left[down], start, peak, ramp)
    times[up] = _ramp_times(made[up], start, peak, ramp)
    return times


def _ramp_times(steps: NDArray[np.float64], start: float, peak: float, ramp: float) -> NDArray[np.float64]:
    """Return the times of the steps on a ramp. The ramp goes from the speed `start` to the speed `peak`, and takes
    `ramp` seconds.
    """

    def made(time: NDArray[np.float64]) -> NDArray[np.float64]:
        turned = ramp / math.pi * np.sin(math.pi * time / ramp)
        return start * time + (peak - start) * (time - turned) / 2

    grid = np.linspace(0.0, ramp, _GRID)
    time = np.interp(steps, made(grid), grid)
    for _ in range(_NEWTON):
        speed = start + (peak - start) * (1 - np.cos(math.pi * time / ramp)) / 2
        time = np.clip(time - (made(time) - steps) / speed, 0.0, ramp)
    return time
