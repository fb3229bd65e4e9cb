"""Defines the events of a bus, for its log and its timing diagrams. Times are in picoseconds since power-on."""

from handeye.core.record import Record


class BusEvent(Record, frozen=True, kw_only=True, tag_field="kind"):
    """An event on the bus."""

    at: int


class CommandSent(BusEvent, frozen=True, kw_only=True, tag="sent"):
    """The central computer began to send a command."""

    frame: bytes
    falls: int  # ps: falling edge of /DATA READY
    rises: int


class FrameTaken(BusEvent, frozen=True, kw_only=True, tag="taken"):
    """A microcomputer took five bytes, and compared the first byte with its own number."""

    number: int
    frame: bytes
    sampled: tuple[int, ...]  # ps: time at which each byte was sampled
    noticed: int  # ps: time at which the strobe was noticed
    own: bool


class ByteSpoken(BusEvent, frozen=True, kw_only=True, tag="spoken"):
    """A microcomputer put a byte of an answer on the lines, and set the strobe. The byte and the strobe end at the
    time `until`.
    """

    number: int
    byte: int
    until: int
    turned: tuple[int, ...]  # segments whose regenerators change direction for the answer


class ByteHeard(BusEvent, frozen=True, kw_only=True, tag="heard"):
    """The central computer took a byte of an answer."""

    number: int  # the microcomputer that was asked
    byte: int


class AnswerEnded(BusEvent, frozen=True, kw_only=True, tag="answered"):
    """The wait for an answer ended, either with the answer or with a failure."""

    number: int
    answer: bytes
    failed: str  # `no answer`, `stray byte`, or empty


class StatusLines(BusEvent, frozen=True, kw_only=True, tag="status"):
    """The status lines of a microcomputer changed."""

    number: int
    status: int  # the levels of lines A (upper bit) and B (lower bit)


class InterruptLine(BusEvent, frozen=True, kw_only=True, tag="interrupt"):
    """The interrupt input of the central computer changed."""

    level: bool


AnyBusEvent = CommandSent | FrameTaken | ByteSpoken | ByteHeard | AnswerEnded | StatusLines | InterruptLine
