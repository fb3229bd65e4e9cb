"""Defines the event that reports that a follower has done its work."""

from handeye.core.units import Measures
from handeye.program.events import SystemEvent


class CircuitClosed(SystemEvent, frozen=True, kw_only=True):
    """A follower has gone around the object once."""

    text: str

    def sentence(self, measures: Measures) -> str:
        return self.text


FOLLOW_EVENTS = (CircuitClosed,)
