"""The kind of event that the counter machine adds to those of all systems."""

from handeye.core.units import Measures
from handeye.program.events import SystemEvent


class CountTold(SystemEvent, frozen=True, kw_only=True):
    """A line has reported a register."""

    register: str
    value: int

    def sentence(self, measures: Measures) -> str:
        return f"register {self.register} holds {self.value}"


EVENTS = (CountTold,)
