"""Executes commands addressed to a microcomputer, independently of the bus.

Times are in picoseconds on the clock of the machine. In this unit, the intervals of a clock are whole numbers
even if the clock has an error of some parts per million.
"""

from abc import ABC, abstractmethod
from typing import Final

from handeye.core.mutable_records import MutableRecord
from handeye.ports.microbus import Command, Status
from handeye.systems.sigma.protocol import Op

PS: Final = 1_000_000  # picoseconds in a microsecond
_TICKS: Final = 2  # ticks of the 2 MHz clock in a microsecond


class Crystal:
    """The clock of a microcomputer."""

    def __init__(self, ppm: int = 0) -> None:
        self.ppm = ppm  # by how much the intervals are too long; negative for a fast clock

    def micros(self, micros: int) -> int:
        """Return the true time (ps) that passes while the microcomputer's clock counts `micros` microseconds."""
        return micros * (PS + self.ppm)

    def ticks(self, ticks: int) -> int:
        """Return the duration of a number of ticks of the microcomputer's 2 MHz clock (ps)."""
        return ticks * (PS + self.ppm) // _TICKS

    def ticks_in(self, picoseconds: int) -> int:
        """Return the number of ticks of the microcomputer's 2 MHz clock in a duration (ps)."""
        return picoseconds * _TICKS // (PS + self.ppm)

    def after(self, since: int, micros: int, at: int) -> int:
        """An action repeats at intervals of `micros` (microseconds), first at the time `since`. Return the first of
        its times that is not before `at`.
        """
        step = self.micros(micros)
        return since + max(0, -(-(at - since) // step)) * step


class Device(ABC):
    """The firmware of one kind of microcomputer, and its state."""

    memory: MutableRecord
    by_interrupt = False  # True: it is always busy, but takes commands, because the strobe interrupts it
    tied = False  # True: its line A is tied to the interrupt input of the central computer

    def __init__(self, crystal: Crystal) -> None:
        self.crystal = crystal

    @property
    @abstractmethod
    def status(self) -> Status:
        """The levels of the status lines between commands."""

    @property
    def due(self) -> int | None:
        """Time of the next action that needs no command (ps), or None if no action is due without a command."""
        return None

    def elapse(self, at: int) -> None:
        """Perform the action that is due."""
        return

    def take(self, command: Command, at: int) -> bytes:
        """Execute a command. Returns the bytes of the answer, which is empty if the command is not a question."""
        if command.op == Op.SELF_TEST:
            return b"\0"
        if command.op == Op.ECHO:
            return command.frame[2:]
        return self.execute(command, at)

    @abstractmethod
    def execute(self, command: Command, at: int) -> bytes:
        """Execute a command that only this kind of device has. An unknown command has no effect."""
