"""A bus of microcomputers, as the computer that runs the user's program sees it.

Commands of five bytes, levels of status lines, one interrupt, bytes of answers, and a clock in whole microseconds.
Nothing else of the machine crosses this wall.
"""

from abc import ABC, abstractmethod
from enum import IntEnum
from typing import Annotated, Final

from msgspec import Meta

from handeye.core.errors import HandeyeError
from handeye.core.mutable_records import MutableRecord
from handeye.core.plain_text import counted
from handeye.core.record import Record

COMMAND_BYTES: Final = 5
PAGE: Final = 5  # microcomputers whose status lines are read at once


class Status(IntEnum):
    """The two status lines of a microcomputer: line A is the upper bit, line B the lower one."""

    FREE = 0b00
    BUSY = 0b01  # still executing the previous command
    RAIL = 0b10  # free; the previous command was aborted at the end of a rail
    FORCE = 0b11  # free; the previous command was aborted by excessive force

    @property
    def aborted(self) -> bool:
        """Line A is high."""
        return self >= Status.RAIL


class Command(Record, frozen=True, kw_only=True):
    """A command: its five bytes are number, operation, `detail`, and `value` with the high byte first."""

    number: Annotated[int, Meta(ge=0, le=0xFF)]  # of the microcomputer
    op: Annotated[int, Meta(ge=0, le=0xFF)]
    detail: Annotated[int, Meta(ge=0, le=0xFF)] = 0
    value: Annotated[int, Meta(ge=0, le=0xFFFF)] = 0

    @property
    def frame(self) -> bytes:
        """Its five bytes."""
        return bytes((self.number, self.op, self.detail, *self.value.to_bytes(2, "big")))

    @classmethod
    def of(cls, frame: bytes) -> "Command":
        """The command that five bytes are."""
        number, op, detail, *value = frame
        return cls(number=number, op=op, detail=detail, value=int.from_bytes(bytes(value), "big"))


class BusFault(HandeyeError):
    """The bus did not carry an answer as the protocol says."""


class NoAnswer(BusFault):
    """A microcomputer did not answer in full before the time limit."""

    def __init__(self, number: int, got: int, wanted: int) -> None:
        super().__init__(
            f"NOANSWER {number}: {got} of {counted(wanted, 'byte')} arrived before the time limit"
        )
        self.number, self.got, self.wanted = number, got, wanted


class StrayAnswer(BusFault):
    """A byte arrived that belongs to no question: an answer is longer than was asked for."""

    def __init__(self, number: int) -> None:
        super().__init__(f"STRAY {number}: a byte arrived that no question asked for")
        self.number = number


class MicrobusPort(ABC):
    """The bus of one central computer.

    `begin` only begins a command; time passes in `wait` alone, so that a state may be kept with bytes under way.
    `send` and `ask` wait until all is done.
    """

    @property
    @abstractmethod
    def now(self) -> int:
        """Microseconds since power-on."""

    @property
    @abstractmethod
    def next_event(self) -> int | None:
        """A moment before which no status line, nor interrupt nor `free` changes; None: none changes by itself."""

    @abstractmethod
    def wait(self, until: int) -> int:
        """Let time pass until a moment, or until a status line, interrupt or `free` first changes; the time it is then.

        It is later than `until` where the machine goes in longer steps.
        """

    @property
    @abstractmethod
    def free(self) -> bool:
        """No command and no answer is under way."""

    @abstractmethod
    def begin(self, command: Command, answer: int = 0) -> None:
        """Begin a command, and expect this many bytes of answer; raises Refused unless the bus is free."""

    @abstractmethod
    def answer(self) -> bytes:
        """The answer to the last question; raises BusFault if it failed, Refused while it is under way."""

    @abstractmethod
    def page(self, number: int) -> int:
        """Ten status lines at once: of microcomputers 5n to 5n + 4, A in bits 1, 3, 5, 7, 9, B in the bit below each.

        No time passes.
        """

    @property
    @abstractmethod
    def interrupt(self) -> bool:
        """The interrupting input, to which line A of every motor is tied."""

    @property
    @abstractmethod
    def memory(self) -> MutableRecord:
        """All that is remembered below this wall, bytes under way included: a record to keep in a run's state."""

    @abstractmethod
    def remember(self, memory: MutableRecord) -> None:
        """Continue from a memory; raises BadFile if it does not fit."""

    # -- made of these -------------------------------------------------------------------------------------

    def status(self, number: int) -> Status:
        """The status lines of a microcomputer. No time passes."""
        return Status(self.page(number // PAGE) >> 2 * (number % PAGE) & 0b11)

    def send(self, command: Command) -> None:
        """Send a command, and wait until its last byte has left."""
        self.begin(command)
        self._finish()

    def ask(self, command: Command, count: int) -> bytes:
        """Send a question, and wait for this many bytes of answer; raises NoAnswer or StrayAnswer."""
        self.begin(command, answer=count)
        self._finish()
        return self.answer()

    def wait_free(self, number: int, limit: int) -> Status:
        """Wait until a microcomputer is not busy; its status then: BUSY only after this time, in microseconds."""
        end = self.now + limit
        while (status := self.status(number)) is Status.BUSY and self.now < end:
            self.wait(end)
        return status

    def _finish(self) -> None:
        while not self.free:
            event = self.next_event
            self.wait(self.now + 1 if event is None else max(self.now + 1, event))
