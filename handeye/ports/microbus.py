"""Defines a bus of microcomputers as it appears to the central computer, which runs the user's program.

The interface carries commands of five bytes, levels of status lines, one interrupt, bytes of answers, and a
clock in whole microseconds. The interface reveals nothing else of the machine.
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
PAGE: Final = 5  # microcomputers whose status lines are read together


class Status(IntEnum):
    """The two status lines of a microcomputer as one number. Line A is the upper bit, line B the lower bit."""

    FREE = 0b00
    BUSY = 0b01  # still executing the previous command
    RAIL = 0b10  # free; the previous command was aborted at the end of a rail
    FORCE = 0b11  # free; the previous command was aborted by excessive force

    @property
    def aborted(self) -> bool:
        """True if line A is high, which means that the motion was aborted."""
        return self >= Status.RAIL


class Command(Record, frozen=True, kw_only=True):
    """A command of five bytes: the number of the microcomputer, the operation, `detail`, and the two bytes of
    `value`, the high byte first.
    """

    number: Annotated[int, Meta(ge=0, le=0xFF)]  # of the microcomputer
    op: Annotated[int, Meta(ge=0, le=0xFF)]
    detail: Annotated[int, Meta(ge=0, le=0xFF)] = 0
    value: Annotated[int, Meta(ge=0, le=0xFFFF)] = 0

    @property
    def frame(self) -> bytes:
        """The five bytes of the command."""
        return bytes((self.number, self.op, self.detail, *self.value.to_bytes(2, "big")))

    @classmethod
    def of(cls, frame: bytes) -> "Command":
        """Decode the command in five bytes."""
        number, op, detail, *value = frame
        return cls(number=number, op=op, detail=detail, value=int.from_bytes(bytes(value), "big"))


class BusFault(HandeyeError):
    """Base class of the errors raised if an answer breaks the protocol: the answer is incomplete, or has too many
    bytes.
    """

    number: int  # number of the microcomputer that was asked


class NoAnswer(BusFault):
    """Raised if a microcomputer did not send its whole answer before the time limit."""

    def __init__(self, number: int, got: int, wanted: int) -> None:
        super().__init__(
            f"NOANSWER {number}: {got} of {counted(wanted, 'byte')} arrived before the time limit"
        )
        self.number, self.got, self.wanted = number, got, wanted


class StrayAnswer(BusFault):
    """Raised if a microcomputer sent more bytes than belong to the answer."""

    def __init__(self, number: int) -> None:
        super().__init__(f"STRAY {number}: a byte arrived that no question asked for")
        self.number = number


class MicrobusPort(ABC):
    """The bus of one central computer.

    `begin` begins to send a command, and returns at once. Time passes only in `wait`, so a state can be saved
    while bytes are on the bus. `send` and `ask` wait until the transfer is complete.
    """

    @property
    @abstractmethod
    def now(self) -> int:
        """Microseconds since power-on."""

    @property
    @abstractmethod
    def next_event(self) -> int | None:
        """The earliest time (microseconds) at which a status line, the interrupt or `free` can change. The value is
        None if they cannot change without a command.
        """

    @abstractmethod
    def wait(self, until: int) -> int:
        """Let time pass until `until` (microseconds), or until a status line, the interrupt or `free` first
        changes. Returns the new time (microseconds).

        The new time may be later than `until` if the machine is simulated in longer steps.

        If the simulation of the machine is slow, `wait` may also return before `until`, so that a person can interrupt
        the simulation. The caller must then call `wait` again.
        """

    @property
    @abstractmethod
    def free(self) -> bool:
        """True if no command and no answer is being transferred."""

    @abstractmethod
    def begin(self, command: Command, answer: int = 0) -> None:
        """Begin to send a command. `answer` is the number of bytes in the answer to the command. Raises Refused unless
        the bus is free.
        """

    @abstractmethod
    def answer(self) -> bytes:
        """Return the answer to the last question. Raises BusFault if the transfer failed, and Refused if the transfer
        is still in progress.
        """

    @abstractmethod
    def page(self, number: int) -> int:
        """Return ten status lines. For page n, these are the lines of microcomputers 5n to 5n + 4. Lines A are
        in bits 1, 3, 5, 7 and 9; each line B is in the bit below its line A.

        No time passes.
        """

    @property
    @abstractmethod
    def interrupt(self) -> bool:
        """Level of the interrupt input, which is connected to line A of every motor."""

    @property
    @abstractmethod
    def memory(self) -> MutableRecord:
        """The complete state of the machine, including the bytes that are being transferred on the bus, as a record
        for checkpoints.
        """

    @abstractmethod
    def remember(self, memory: MutableRecord) -> None:
        """Restore the machine to a state. Raises BadFile if the state does not fit the machine."""

    # -- built from these ----------------------------------------------------------------------------------

    def status(self, number: int) -> Status:
        """Return the status lines of one microcomputer. No time passes."""
        return Status(self.page(number // PAGE) >> 2 * (number % PAGE) & 0b11)

    def begun(self, number: int) -> bool:
        """Return True if the status of a microcomputer shows that its command is being executed or was refused. Call
        this method after the last byte of a command that takes time.
        """
        return self.status(number) is not Status.FREE

    def send(self, command: Command) -> None:
        """Send a command, and wait until its last byte has been sent."""
        self.begin(command)
        self._finish()

    def ask(self, command: Command, count: int) -> bytes:
        """Send a question, and wait for `count` bytes of answer. Raises NoAnswer or StrayAnswer."""
        self.begin(command, answer=count)
        self._finish()
        return self.answer()

    def wait_free(self, number: int, limit: int) -> Status:
        """Wait until a microcomputer is not busy, for at most `limit` microseconds. Returns its status, which
        is BUSY only if the time limit was reached.
        """
        end = self.now + limit
        while (status := self.status(number)) is Status.BUSY and self.now < end:
            self.wait(end)
        return status

    def _finish(self) -> None:
        while not self.free:
            event = self.next_event
            self.wait(self.now + 1 if event is None else max(self.now + 1, event))
