"""Wall-clock and processor time of this computer; no result of a run depends on it."""

import time
from dataclasses import dataclass, field
from typing import Self

_LOADED = time.monotonic(), time.process_time()
"""When this module was imported: first of all, by a command."""


@dataclass(frozen=True, slots=True)
class HostTimer:
    """Measures time since its creation."""

    _wall: float = field(default_factory=time.monotonic)
    _cpu: float = field(default_factory=time.process_time)

    @classmethod
    def of_command(cls) -> Self:
        """A timer from when handeye was loaded, its imports included.

        Not from the start of the process: that may have installed packages, or slept, before it became handeye.
        """
        return cls(*_LOADED)

    @property
    def wall_s(self) -> float:
        return time.monotonic() - self._wall

    @property
    def cpu_s(self) -> float:
        return time.process_time() - self._cpu
