"""Events of a relay: legs that take the arm over. The events of the legs themselves are those of their systems."""

from itertools import chain
from typing import Any, Final

from handeye.core.entries import entries, entry_named, loaded
from handeye.core.units import Measures
from handeye.program.events import SystemEvent


class LegStarted(SystemEvent, frozen=True, kw_only=True):
    """A leg takes the arm over. `gap` is the gap of the fingers (m), and `named` has the names in the record."""

    stage: str
    system: str
    program: str
    held: str
    gap: float
    named: tuple[str, ...]

    def sentence(self, measures: Measures) -> str:
        holds = f"the hand holds {self.held}" if self.held else "the hand is empty"
        names = f"; handed over: {', '.join(self.named)}" if self.named else ""
        return f"{entry_named(self.system).title} takes the arm over with {self.program}: {holds}{names}"


EVENTS: Final[tuple[Any, ...]] = (
    LegStarted,
    *chain.from_iterable(
        loaded(entry.events) for entry in entries().values() if "leg" in entry.can and entry.events
    ),
)
