"""Defines the events of the real-time level. Positions, goals and limits are in the units of ML."""

from typing import ClassVar

from handeye.core.units import Measures
from handeye.program.events import Importance, SystemEvent


class LevelEvent(SystemEvent, frozen=True, kw_only=True):
    """Base class of the events of an arm's real-time level."""

    arm: str  # right or left
    cycle: int  # number of the 10 ms cycle


class LimitCrossed(LevelEvent, frozen=True, kw_only=True):
    """The reading of a sensor left its expected limits, and the sensor's flag came on."""

    sensor: int
    reading: int
    lower: int | None  # None: open
    upper: int | None

    def sentence(self, measures: Measures) -> str:
        return f"sensor {self.sensor} reads {self.reading}, which is not {_between(self.lower, self.upper)}"


class Froze(LevelEvent, frozen=True, kw_only=True):
    """All motors were commanded to stay where they are."""

    positions: dict[int, int]  # by motor
    moving: tuple[int, ...] = ()  # motors that were not at their goals

    def sentence(self, measures: Measures) -> str:
        places = ", ".join(f"motor {motor} at {self.positions[motor]}" for motor in self.moving)
        return f"all motors of the {self.arm} arm freeze" + (f": {places}" if places else "; none was moving")


class Posted(LevelEvent, frozen=True, kw_only=True):
    """The real-time level has posted (notified) the background level that a motion has ended."""

    importance: ClassVar[Importance] = "debug"
    what: str  # goal, force or emergency
    cycles: int  # cycles that the motion took

    def sentence(self, measures: Measures) -> str:
        ends = {
            "goal": "has reached its goal",
            "force": "was frozen",
            "emergency": "was stopped by an emergency",
        }
        return f"the motion of the {self.arm} arm {ends[self.what]} after {self.cycles * 10} ms"


class EmergencyStopped(LevelEvent, frozen=True, kw_only=True):
    """All motors were frozen, the pump and all tools were switched off, and the program was stopped."""

    importance: ClassVar[Importance] = "error"
    cause: str
    statement: int  # the statement that was being executed; 0: none
    text: str

    def sentence(self, measures: Measures) -> str:
        where = f" at statement {self.statement}" if self.statement else ""
        return (
            f"emergency of the {self.arm} arm{where}: {self.text}; all motors are frozen and the pump is off"
        )


class PumpSwitched(LevelEvent, frozen=True, kw_only=True):
    """ENABLE or DISABLE switched the pump."""

    on: bool

    def sentence(self, measures: Measures) -> str:
        return f"the pump of the {self.arm} arm is {'on' if self.on else 'off'}"


class TableWritten(LevelEvent, frozen=True, kw_only=True):
    """A word of a table was written."""

    importance: ClassVar[Importance] = "debug"
    table: str
    line: int
    word: int
    was: int
    value: int

    def sentence(self, measures: Measures) -> str:
        return f"word {self.word} of line {self.line} in the table {self.table} changes from {self.was} to {self.value}"


class GoalRounded(LevelEvent, frozen=True, kw_only=True):
    """A goal was rounded to the nearest detent of its motor."""

    importance: ClassVar[Importance] = "warning"
    motor: int
    asked: int
    goal: int

    def sentence(self, measures: Measures) -> str:
        return f"motor {self.motor} stops only at detents: it goes to {self.goal} instead of {self.asked}"


class ToolSwitched(LevelEvent, frozen=True, kw_only=True):
    """An output switched a tool."""

    tool: str
    on: bool

    def sentence(self, measures: Measures) -> str:
        return f"the {self.tool} is switched {'on' if self.on else 'off'}"


def _between(lower: int | None, upper: int | None) -> str:
    if lower is None:
        return f"below {upper}"
    return f"above {lower}" if upper is None else f"between {lower} and {upper}"


REALTIME_EVENTS = (
    LimitCrossed, Froze, Posted, EmergencyStopped, PumpSwitched, TableWritten, GoalRounded, ToolSwitched
)  # fmt: skip
