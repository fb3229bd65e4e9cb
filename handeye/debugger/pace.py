"""Pace of a run against the clock on the wall. This computer waits; the run knows nothing of it."""

import re
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Final

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument
from handeye.execution.servo import ServoPeriod
from handeye.runs.observer import Observer

FREE: Final = "free"  # as fast as it goes
SLOWEST: Final = 0.25
FASTEST: Final = 100.0
_LATE_S: Final = (
    0.1  # up to which a run catches up; one that is later, as after a picture, goes on from there
)


@dataclass(slots=True, eq=False)
class Pace(Observer):
    """Keeps a run from going faster than `factor` times the wall clock."""

    factor: float | None = None
    """Simulated seconds per second; None: as fast as it goes."""
    clock: Callable[[], float] = time.monotonic
    sleep: Callable[[float], None] = time.sleep
    _kept: tuple[float, float, float] | None = field(default=None, init=False)
    """The factor that is kept, and since when by the wall clock and by the cell's, s."""

    def __str__(self) -> str:
        if self.factor is None:
            return "as fast as it goes"
        return "as fast as the clock" if self.factor == 1 else f"{self.factor:g} times as fast as the clock"

    def tick(self, period: ServoPeriod) -> None:
        if self.factor is None:
            self._kept = None
        else:
            self._keep(self.factor, period.sensed.time)

    def _keep(self, factor: float, time: float) -> None:
        """Wait until a time of the cell has come."""
        now = self.clock()
        if self._kept is None or self._kept[0] != factor or time < self._kept[2]:
            self._kept = factor, now, time
        _, since, begun = self._kept
        early = since + (time - begun) / factor - now
        if early > 0:
            self.sleep(early)
        elif early < -_LATE_S:
            self._kept = factor, now, time


def factor(text: str) -> float | None:
    """Read a pace: `1x`, `4x`, `.5x`, or `free`, which is None; raises InvalidInput if it is none."""
    if text.casefold() == FREE:
        return None
    number = re.fullmatch(r"([0-9]{1,3}(?:\.[0-9]{1,6})?|\.[0-9]{1,6})x?", text.casefold())
    if number is None or not SLOWEST <= float(number[1]) <= FASTEST:
        raise BadArgument(
            f"pace takes `1x`, `4x`, another number from {SLOWEST:g}x to {FASTEST:g}x, or `{FREE}`, not {quoted(text)}"
        )
    return float(number[1])
