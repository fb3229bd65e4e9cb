"""Defines the interface between the two levels of MOS: the background level interprets statements, and uses the
real-time level of an arm through `Level`.

All numbers are words of 16 bits in the units of ML: 0.001 inch, 0.01 degree, and the units of each sensor. Time is
counted in cycles of 10 ms. Only `cycle` lets time pass.
"""

from abc import ABC, abstractmethod
from collections.abc import Collection, Mapping, Sequence
from typing import Literal, NamedTuple, Protocol

from handeye.core.mutable_records import MutableRecord

Post = Literal["", "goal", "force", "emergency"]
Side = Literal["right", "left"]


class Shape(NamedTuple):
    """The layout of a table."""

    title: str
    lines: int
    words: int
    internal: bool = True  # True: the real-time level uses the table
    names: tuple[str, ...] = ()  # names of the words of a line; empty if they have none


class View(Protocol):
    """The contents of a table. Another part of MOS keeps these contents. Lines and words count from 1; callers ask
    only for lines and words that exist.
    """

    def read(self, line: int, word: int) -> int:
        """Return a word."""

    def write(self, line: int, word: int, value: int) -> None:
        """Set a word. Raises MlError if the word cannot be written."""


class Level(ABC):
    """The real-time level of one arm."""

    @property
    @abstractmethod
    def now(self) -> int:
        """Number of cycles since the beginning."""

    @abstractmethod
    def cycle(self) -> None:
        """Execute one cycle of 10 ms: sample the inputs, check the sensors, check the goals, and set the outputs."""

    @property
    @abstractmethod
    def posted(self) -> Post:
        """A word that says what ended the last motion. While a motion is under way, the word is empty."""

    @property
    @abstractmethod
    def memory(self) -> MutableRecord:
        """The complete state of the level."""

    @abstractmethod
    def remember(self, memory: MutableRecord) -> None:
        """Continue from a copy of a state. Raises InvalidInput if the state does not fit this level."""

    # -- tables ---------------------------------------------------------------------------------------

    @property
    @abstractmethod
    def shapes(self) -> Mapping[str, Shape]:
        """Layouts of all tables. The keys are the tables' names of two letters."""

    @abstractmethod
    def read(self, table: str, line: int, word: int) -> int:
        """Return a word of a table. Lines and words count from 1. Raises MlError (M11) if the word does not exist."""

    @abstractmethod
    def write(self, table: str, line: int, word: int, value: int) -> None:
        """Write a word of a table. The real-time level uses the new value from the next cycle on. Raises MlError (M11)
        if the word does not exist or cannot be written.
        """

    @abstractmethod
    def view(self, table: str, contents: View) -> None:
        """Make a table show contents that are stored in the background level."""

    # -- sensors --------------------------------------------------------------------------------------

    @property
    @abstractmethod
    def flags(self) -> Collection[int]:
        """Numbers of the logical sensors whose flags are on."""

    @abstractmethod
    def expect(self, sensor: int, lower: int, upper: int) -> None:
        """Set the expected limits of a sensor, and clear its flag. Raises MlError if the limits are in the wrong order
        (M04), or if no sensor has this number (M11).
        """

    @abstractmethod
    def open(self, sensor: int | None = None) -> None:
        """Open the limits of a sensor, so that every reading is within the limits, and clear the sensor's flag. If no
        number is given, open the limits and clear the flags of all sensors. Raises MlError (M11) if no sensor has this
        number.
        """

    @abstractmethod
    def reading(self, sensor: int) -> int:
        """Return the latest reading of a logical sensor. Raises MlError (M11) if no sensor has this number."""

    @abstractmethod
    def calibrate(self, sensors: Sequence[int]) -> None:
        """Take the mean of the last 8 readings of each sensor as its zero. If `sensors` is empty, do this for all
        analog sensors. Raises MlError (M11) if a number is not the number of a sensor.
        """

    @abstractmethod
    def wand(self, sensor: int) -> None:
        """Assign the wand to a logical sensor. From then on, the sensor's flag comes on if the wand touches something.
        Raises MlError (M11) if no sensor has this number, or if the arm has no wand.
        """

    # -- motors ---------------------------------------------------------------------------------------

    @property
    @abstractmethod
    def motors(self) -> tuple[int, ...]:
        """Numbers of the installed motors."""

    @abstractmethod
    def position(self, motor: int) -> int:
        """Return the latest position of a motor. Raises MlError (M09) if the motor is not installed."""

    @abstractmethod
    def goal(self, motor: int) -> int:
        """Return the strategic goal of a motor. Raises MlError (M09) if the motor is not installed."""

    @abstractmethod
    def start(self, goals: Mapping[int, int]) -> bool:
        """Give motors new strategic goals. Returns False, and changes nothing, if the flag of any sensor is on. If
        this method raises MlError (M09, M10, M15), it has changed nothing.
        """

    # -- power and devices ----------------------------------------------------------------------------

    @property
    @abstractmethod
    def enabled(self) -> bool:
        """True if the pump is on."""

    @abstractmethod
    def enable(self) -> None:
        """Switch the pump on. No motor moves. Raises MlError (M14) while the cause of an emergency persists."""

    @abstractmethod
    def disable(self) -> None:
        """Freeze all motors, then switch the pump off."""

    @abstractmethod
    def statement(self, number: int) -> None:
        """Note the number of the statement that is now being executed; 0 for a line that is not stored."""

    @abstractmethod
    def emergency(self, cause: str, statement: int) -> None:
        """Freeze all motors, switch the pump off, and record cause and statement in the table EM."""

    @abstractmethod
    def look(self) -> None:
        """Look for an emergency between two cycles. No time passes, and no flag comes on."""

    @property
    @abstractmethod
    def stopped(self) -> str:
        """The emergency that has stopped the program, as a sentence; the text is empty if there was no emergency since
        ENABLE.
        """

    @abstractmethod
    def analog_in(self, point: int) -> int:
        """Return an analog input. Raises MlError (M11) if the input does not exist."""

    @abstractmethod
    def analog_out(self, point: int, value: int) -> None:
        """Set an analog output. Raises MlError: M11 if the output does not exist, and M15 while the pump is on."""

    @abstractmethod
    def digital_out(self, word: int, value: int, mask: int) -> None:
        """Copy bits of `value` to a digital output word. A bit is copied if the same bit of `mask` is 1. Raises
        MlError: M11 if the word does not exist, and M15 while the pump is on.
        """
