"""Wall-clock and processor time of this computer; no result of a run depends on it."""

import os
import time
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Self

_IMPORTED = time.monotonic()


@dataclass(frozen=True, slots=True)
class HostTimer:
    """Measures time since its creation."""

    _wall: float = field(default_factory=time.monotonic)
    _cpu: float = field(default_factory=time.process_time)

    @classmethod
    def of_process(cls) -> Self:
        """A timer from the start of this process, interpreter and imports included."""
        return cls(_wall=time.monotonic() - process_age(), _cpu=0.0)

    @property
    def wall_s(self) -> float:
        return time.monotonic() - self._wall

    @property
    def cpu_s(self) -> float:
        return time.process_time() - self._cpu


def process_age() -> float:
    """Seconds since this process started; since this module's import where the platform does not say."""
    imported = time.monotonic() - _IMPORTED
    with suppress(OSError, ValueError, IndexError, AttributeError):
        after_name = Path("/proc/self/stat").read_text(encoding="ascii", errors="replace").rpartition(")")[2]
        started = int(after_name.split()[19]) / os.sysconf("SC_CLK_TCK")
        age = time.clock_gettime(time.CLOCK_BOOTTIME) - started
        if started > 0 and age >= imported:
            return age
    return imported
