"""Processor time: how long this computer thought, which is no part of what happens in a run."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass


@dataclass(slots=True)
class Stopwatch:
    """Adds up the seconds for which it runs, by a clock that it is given; without one it stands at zero."""

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
