"""What a microcomputer does with the commands that are addressed to it, whatever bus they came by.

Times are picoseconds on the clock of the machine, so that intervals of clocks that are some parts per million fast or
slow are whole numbers.
"""

from abc import ABC, abstractmethod
from typing import Final

from handeye.core.mutable_records import MutableRecord
from handeye.ports.microbus import Command, Status
from handeye.systems.sigma.protocol import Op

PS: Final = 1_000_000  # in a microsecond
_TICKS: Final = 2  # of the clock of 2 MHz in a microsecond


class Crystal:
    """The clock of a microcomputer."""

    def __init__(self, ppm: int = 0) -> None:
        self.ppm = ppm  # by how much its intervals are too long; a fast clock has a negative one

    def micros(self, micros: int) -> int:
        """Picoseconds that an interval of its own microseconds takes."""
        return micros * (PS + self.ppm)

    def ticks(self, ticks: int) -> int:
        """Duration of a number of ticks of its 2 MHz clock, picoseconds."""
        return ticks * (PS + self.ppm) // _TICKS

    def ticks_in(self, picoseconds: int) -> int:
        """Its ticks of 2 MHz that are over after a time."""
        return picoseconds * _TICKS // (PS + self.ppm)

    def after(self, since: int, micros: int, at: int) -> int:
        """The first moment from `at` on that is a multiple of an interval after `since`."""
        step = self.micros(micros)
        return since + max(0, -(-(at - since) // step)) * step


class Device(ABC):
    """The firmware of one kind of microcomputer, and what it remembers."""

    memory: MutableRecord
    by_interrupt = False  # always busy, yet it takes commands: the strobe interrupts it
    tied = False  # its line A is tied to the interrupting input of the central computer

    def __init__(self, crystal: Crystal) -> None:
        self.crystal = crystal

    @property
    @abstractmethod
    def status(self) -> Status:
        """What its status lines show between commands."""

    @property
    def due(self) -> int | None:
        """When it does something by itself next."""
        return None

    def elapse(self, at: int) -> None:
        """Do what is due."""
        return

    def take(self, command: Command, at: int) -> bytes:
        """Carry out a command; the bytes of its answer, none if it asks for nothing."""
        if command.op == Op.SELF_TEST:
            return b"\0"
        if command.op == Op.ECHO:
            return command.frame[2:]
        return self.execute(command, at)

    @abstractmethod
    def execute(self, command: Command, at: int) -> bytes:
        """Carry out a command of its own kind; one that it does not know does nothing."""
