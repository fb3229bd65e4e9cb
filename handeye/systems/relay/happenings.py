"""Events of a relay: a leg takes over the arm, or leaves it. During a leg, the system of the leg reports its own
events.
"""

from collections.abc import Mapping
from typing import Any, Final

import msgspec

from handeye.core.entries import entries, entry_named, loaded
from handeye.core.units import Measures
from handeye.program.events import AnyEvent, SystemEvent


class LegStarted(SystemEvent, frozen=True, kw_only=True):
    """A leg takes over the arm. `gap` is the gap of the fingers (m), and `named` has the names of the values in the
    hand-over record.
    """

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


class LegFinished(SystemEvent, frozen=True, kw_only=True):
    """A leg has ended, the brakes are set, and the hand-over record of the leg is made."""

    stage: str
    system: str
    program: str

    def sentence(self, measures: Measures) -> str:
        return f"{entry_named(self.system).title} gives the arm up: {self.program} has ended, and the brakes are set"


def _kind(system: str, kind: type[SystemEvent]) -> type[SystemEvent]:
    """Return a copy of a kind of event. The copy's name begins with the name of the system, so that no other system
    has an event of this name.
    """
    name = f"{system.capitalize()}{kind.__name__}"
    made: Any = msgspec.defstruct(
        name, [], bases=(kind,), frozen=True, kw_only=True, tag_field="event", tag=name, module=__name__
    )
    own: type[SystemEvent] = made
    return own


OF_LEGS: Final[Mapping[type, type[SystemEvent]]] = {
    kind: _kind(entry.name, kind)
    for entry in entries().values()
    if "leg" in entry.can and entry.events
    for kind in loaded(entry.events)
}
"""For each kind of event of a system that can run a leg, the kind of event that the relay reports instead."""
EVENTS: Final[tuple[Any, ...]] = (LegStarted, LegFinished, *OF_LEGS.values())


def of_leg(event: AnyEvent) -> AnyEvent:
    """Return an event of a leg as an event of the relay."""
    kind: Any = OF_LEGS.get(type(event))
    return event if kind is None else kind(**{name: getattr(event, name) for name in event.__struct_fields__})
