"""Wall-clock time and processor time of this computer. These times do not affect the course of a run."""

import time
from dataclasses import dataclass, field
from typing import Self

_LOADED = time.monotonic(), time.process_time()
"""Wall-clock and processor time at which this module was imported. A command imports this module before anything else.
"""


@dataclass(frozen=True, slots=True)
class HostTimer:
    """Measures time since its creation."""

    _wall: float = field(default_factory=time.monotonic)
    _cpu: float = field(default_factory=time.process_time)

    @classmethod
    def of_command(cls) -> Self:
        """Make a timer that counts from the moment when handeye was loaded, so that the imports are included.

        The timer does not start with the process, because the process may have installed packages or waited before
        it loaded handeye.
        """
        return cls(*_LOADED)

    @property
    def wall_s(self) -> float:
        return time.monotonic() - self._wall

    @property
    def cpu_s(self) -> float:
        return time.process_time() - self._cpu
