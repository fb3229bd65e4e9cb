"""Defines the events of ML programs: printed lines, traced statements, and motions that were not executed."""

from typing import ClassVar

from handeye.core.plain_text import printable
from handeye.core.units import Measures
from handeye.program.events import Importance, SystemEvent
from handeye.systems.ml.follow.happenings import FOLLOW_EVENTS
from handeye.systems.ml.realtime.happenings import REALTIME_EVENTS
from handeye.systems.ml.support.happenings import SUPPORT_EVENTS


class Printed(SystemEvent, frozen=True, kw_only=True):
    """A line was printed."""

    text: str

    def sentence(self, measures: Measures) -> str:
        return f"MOS prints: {printable(self.text)}"


class Traced(SystemEvent, frozen=True, kw_only=True):
    """A statement is about to be executed while TRACE is on. Its parameters have been evaluated."""

    importance: ClassVar[Importance] = "debug"
    statement: int
    text: str

    def sentence(self, measures: Measures) -> str:
        return f"{self.statement} {self.text}"


class Nullified(SystemEvent, frozen=True, kw_only=True):
    """A motion was not executed, because flags of sensors were on."""

    statement: int  # 0: a typed line
    sensors: tuple[int, ...]  # sensors whose flags are on

    def sentence(self, measures: Measures) -> str:
        where = f"statement {self.statement}" if self.statement else "the typed line"
        flags = " and ".join(map(str, self.sensors))
        which = (
            f"the flag of sensor {flags} is"
            if len(self.sensors) == 1
            else f"the flags of sensors {flags} are"
        )
        return f"{where} moves nothing, because {which} on"


EVENTS = (Printed, Traced, Nullified, *REALTIME_EVENTS, *FOLLOW_EVENTS, *SUPPORT_EVENTS)
