"""A call in progress, which can be cancelled and which reports its progress."""

from collections.abc import Callable
from dataclasses import dataclass, field
from threading import Event
from typing import Final

EVERY: Final = 60  # polls between two reports; a servo period polls once, and there are 60 in a second
Report = Callable[[float, float | None, str], None]
"""Function that takes the progress of a call, the total (None if the total is not known), and a text."""


def _unheard(done: float, whole: float | None, text: str) -> None:
    """Discard a report."""


@dataclass(eq=False, slots=True)
class Call:
    """One call of a tool."""

    report: Report = _unheard
    cancelled: Event = field(default_factory=Event)
    told: Callable[[], str] = lambda: "preparing the cell"  # where the call is, in words
    _polls: int = 0

    def halted(self) -> bool:
        """Return True if the call was cancelled. A run calls this method in every servo period. The method therefore
        also reports progress, about once in a simulated second.
        """
        self._polls += 1
        if self._polls % EVERY == 0:
            self.report(self._polls / EVERY, None, self.told())
        return self.cancelled.is_set()
