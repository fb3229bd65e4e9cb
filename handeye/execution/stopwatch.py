"""Processor time, which is no part of a run's results."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass


@dataclass(slots=True)
class Stopwatch:
    """Adds up seconds while running, by a given clock; without one it stays at zero."""

    clock: Callable[[], float] = lambda: 0.0
    seconds: float = 0.0

    @contextmanager
    def running(self) -> Iterator[None]:
        """Run while entered."""
        begun = self.clock()
        try:
            yield
        finally:
            self.seconds += self.clock() - begun
