"""Stores the tables of an arm, and the tables that both arms have in common."""

from collections.abc import Mapping
from typing import Annotated, Any, Final

import msgspec
from msgspec import field
from msgspec.structs import replace

from handeye.core.mutable_records import MutableRecord
from handeye.core.record import Record
from handeye.systems.ml.arithmetic import HIGHEST, LOWEST, fits, wrap
from handeye.systems.ml.errors import MlError
from handeye.systems.ml.level import Shape, View
from handeye.systems.ml.tables.layout import (
    ANALOG_INPUTS,
    ANALOG_OUTPUTS,
    DIGITAL_INPUTS,
    DIGITAL_OUTPUTS,
    EVENTS_KEPT,
    FRAMES,
    INTERLOCKS,
    INTERRUPTS,
    MOTORS,
    RECENT,
    SENSORS,
    SHAPES,
    TIMERS,
)
from handeye.systems.ml.tables.records import (
    ArmLine,
    CycleLine,
    EmergencyLine,
    ForceLine,
    FrameLine,
    GoalLine,
    InterlockLine,
    MotorLine,
    SensorLine,
    SpaceLine,
    Word,
)

PAGE: Final = 16  # lines of an external table in a page
_BY_PROGRAMS: Final[Mapping[str, tuple[str, ...]]] = {
    "AR": ("coordinate",), "CY": ("used", "share"), "EM": (), "FE": (), "GO": (), "PF": (), "PI": (), "SF": ()
}  # fmt: skip
"""For each of these tables, the words that a program can write. In all other tables, a program can write every word.
No program can write the record of an emergency (`EM`), or the interlocks (`SF`).
"""


Fine = Annotated[int, msgspec.Meta(ge=100 * LOWEST, le=100 * HIGHEST)]  # hundredths of a unit


def _zeros(count: int) -> Any:
    return field(default_factory=lambda: [0] * count)


def _lines(kind: type[MutableRecord | Record], count: int) -> Any:
    return field(default_factory=lambda: [kind() for _ in range(count)])


class SharedMemory(MutableRecord, kw_only=True):
    """The tables that both arms have in common. A field that is a list has the words of its table, one line after the
    other.
    """

    TM: list[Word] = _zeros(TIMERS)
    JY: list[Word] = _zeros(MOTORS * 2)
    FK: list[Word] = _zeros(16)
    VR: tuple[Word, ...] = (0,) * 256  # replaced as a whole, so that saved states can share it
    PF: list[FrameLine] = _lines(FrameLine, FRAMES)
    HL: list[Word] = _zeros(3)
    MX: list[Word] = _zeros(16)
    US: dict[int, Word] = field(default_factory=dict)  # words that are not 0


class ArmMemory(MutableRecord, kw_only=True):
    """The complete state of the real-time level of an arm: its tables, and further values that are in no table."""

    now: Annotated[int, msgspec.Meta(ge=0, le=10**12)] = 0  # cycles since the beginning
    MT: list[MotorLine] = _lines(MotorLine, MOTORS)
    ST: list[SensorLine] = _lines(SensorLine, SENSORS)
    AI: list[Word] = _zeros(ANALOG_INPUTS)
    AO: list[Word] = _zeros(ANALOG_OUTPUTS)
    DI: list[Word] = _zeros(DIGITAL_INPUTS)
    DO: list[Word] = _zeros(DIGITAL_OUTPUTS)
    PI: list[Word] = _zeros(INTERRUPTS)
    EM: list[EmergencyLine] = _lines(EmergencyLine, 1)
    FE: list[ForceLine] = _lines(ForceLine, EVENTS_KEPT)
    GO: list[GoalLine] = _lines(GoalLine, EVENTS_KEPT)
    CY: list[CycleLine] = _lines(CycleLine, 1)
    RG: list[Word] = _zeros(15)
    AR: list[ArmLine] = _lines(ArmLine, 1)
    SF: list[InterlockLine] = _lines(InterlockLine, INTERLOCKS)
    WS: list[SpaceLine] = _lines(SpaceLine, MOTORS)
    CA: list[Word] = _zeros(SENSORS * RECENT)
    fine: list[Fine] = _zeros(MOTORS)  # set-points
    pace: list[Fine] = _zeros(MOTORS)
    """Greatest advance of each set-point per cycle in the present motion; 0 stands for the motor's own limit."""
    tools: Word = 0  # the present outputs of the tools


def word_of(name: str) -> int:
    """Return the name of a table as a word. A table's name has two characters, which fit into one word."""
    return ord(name[0]) << 8 | ord(name[1])


class Tables:
    """Access to all tables of an arm by name, line and word."""

    def __init__(self, arm: ArmMemory, shared: SharedMemory) -> None:
        self._arm, self._shared = arm, shared
        self.views: dict[str, View] = {}  # contents that the background level keeps

    def read(self, table: str, line: int, word: int) -> int:
        """Return a word. Raises MlError (M11) if the word does not exist."""
        shape = self._shape(table, line, word)
        if table in self.views:
            return self.views[table].read(line, word)
        store = self._store(table)
        if isinstance(store, dict):
            return int(store.get((line - 1) * shape.words + word - 1, 0))
        if store is None:
            return 0
        if store and isinstance(store[0], MutableRecord | Record):
            return int(getattr(store[line - 1], shape.names[word - 1]))
        return int(store[(line - 1) * shape.words + word - 1])

    def write(self, table: str, line: int, word: int, value: int) -> None:
        """Write a word. Raises MlError if the value does not fit into a word (M04), or if the word does not exist or
        cannot be written (M11).
        """
        shape = self._shape(table, line, word)
        if not fits(value):
            raise MlError("M04", f"{value} does not fit into a word of {table}")
        if table in self.views:
            self.views[table].write(line, word, value)
            return
        name = shape.names[word - 1] if len(shape.names) == shape.words else ""
        store = self._store(table)
        if store is None or name not in _BY_PROGRAMS.get(table, (name,)):
            raise MlError("M11", f"word {word} of {table} cannot be written")
        if store and not isinstance(store, dict) and isinstance(store[0], MutableRecord):
            setattr(store[line - 1], name, value)
        elif store and not isinstance(store, dict) and isinstance(store[0], Record):
            store[line - 1] = replace(store[line - 1], **{name: value})
        elif isinstance(store, tuple):
            setattr(self._shared, table, (*store[: line - 1], value, *store[line:]))
        else:
            store[(line - 1) * shape.words + word - 1] = value

    def _shape(self, table: str, line: int, word: int) -> Shape:
        shape = SHAPES.get(table)
        if shape is None:
            raise MlError("M11", f"there is no table {table}; the tables are {', '.join(SHAPES)}")
        if not 1 <= line <= shape.lines:
            raise MlError("M11", f"there is no line {line} in {table}; its lines are 1 to {shape.lines}")
        if not 1 <= word <= shape.words:
            raise MlError(
                "M11", f"there is no word {word} in a line of {table}; the words are 1 to {shape.words}"
            )
        if not shape.internal:
            self._page_in(table, (line - 1) // PAGE)
        return shape

    def _store(self, table: str) -> Any:
        return (
            getattr(self._arm, table, None)
            if hasattr(self._arm, table)
            else getattr(self._shared, table, None)
        )

    def _page_in(self, table: str, page: int) -> None:
        """Bring a page of an external table into a frame. If no frame is free, the new page replaces the page that was
        used least recently.
        """
        frames, name, now = self._shared.PF, word_of(table), self._arm.now
        there = [n for n, frame in enumerate(frames) if (frame.table, frame.page) == (name, page)]
        free = [n for n, frame in enumerate(frames) if not frame.table]
        oldest = max(range(len(frames)), key=lambda n: wrap(now - frames[n].used))
        frames[[*there, *free, oldest][0]] = FrameLine(table=name, page=page, used=wrap(now))
