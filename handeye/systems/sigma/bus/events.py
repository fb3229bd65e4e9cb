"""What happens on a bus, for its log and its timing diagram. Times are picoseconds since power-on."""

from handeye.core.record import Record


class BusEvent(Record, frozen=True, kw_only=True, tag_field="kind"):
    """Something that happened on the bus."""

    at: int


class CommandSent(BusEvent, frozen=True, kw_only=True, tag="sent"):
    """The central computer begins a command."""

    frame: bytes
    falls: int  # ps, of /DATA READY
    rises: int


class FrameTaken(BusEvent, frozen=True, kw_only=True, tag="taken"):
    """A microcomputer has taken five bytes, and compared the first with its number."""

    number: int
    frame: bytes
    sampled: tuple[int, ...]  # ps, of each byte
    noticed: int  # ps, of the strobe
    own: bool


class ByteSpoken(BusEvent, frozen=True, kw_only=True, tag="spoken"):
    """A microcomputer puts a byte of an answer on the lines, with the strobe, until `until`."""

    number: int
    byte: int
    until: int
    turned: tuple[int, ...]  # segments whose regenerators turn round for it


class ByteHeard(BusEvent, frozen=True, kw_only=True, tag="heard"):
    """The central computer has taken a byte of an answer."""

    number: int  # the one that was asked
    byte: int


class AnswerEnded(BusEvent, frozen=True, kw_only=True, tag="answered"):
    """A question is over."""

    number: int
    answer: bytes
    failed: str  # `no answer`, `stray byte`, or empty


class StatusLines(BusEvent, frozen=True, kw_only=True, tag="status"):
    """The status lines of a microcomputer have changed."""

    number: int
    status: int  # A is the upper bit, B the lower


class InterruptLine(BusEvent, frozen=True, kw_only=True, tag="interrupt"):
    """The interrupting input of the central computer has changed."""

    level: bool


AnyBusEvent = CommandSent | FrameTaken | ByteSpoken | ByteHeard | AnswerEnded | StatusLines | InterruptLine
