"""Reads the records of an MCAP file, and checks that the file is complete and undamaged.

The MCAP library verifies only some of a file's checksums. This module verifies all checksums, and so detects every
changed bit.
"""

import struct
import zlib
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from io import BytesIO
from typing import Final, TypeVar

from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, Chunk, Message, Metadata
from mcap.stream_reader import breakup_chunk
from mcap.writer import MCAP0_MAGIC
from zstandard import ZstdDecompressor, ZstdError, frame_content_size

from handeye.program.events import Event, to_line
from handeye.trace.channels import EVENTS, METADATA, PACKED_PLAN, PLAN

_HEAD: Final = struct.Struct("<BQ")  # head of a record: its kind and its length
_DATA_END: Final = _HEAD.size + 4
_FOOTER: Final = _HEAD.size + 20
_TROUBLE: Final = (McapError, ZstdError, ValueError, KeyError, struct.error, MemoryError, OverflowError)

LARGEST: Final = 1 << 26  # bytes, unpacked, of a chunk or plan: fifty times the largest chunk of a trace

Kind = TypeVar("Kind", Attachment, Chunk, Metadata)


class DamagedTrace(Exception):
    """Raised if a file is damaged. The message describes the damage."""


@dataclass(frozen=True, slots=True)
class RawMessage:
    """A message as stored in the file; `time` is in ns."""

    topic: str
    time: int
    data: bytes


@dataclass(frozen=True, slots=True)
class Front:
    """The beginning of a trace, before the first message."""

    metadata: dict[str, str]
    plan: bytes | None


def is_mcap(data: bytes) -> bool:
    """Return True if a file begins like an MCAP file."""
    return data.startswith(MCAP0_MAGIC)


def is_ended(data: bytes) -> bool:
    """Return True if a file ends like an MCAP file that was written completely."""
    return data.endswith(MCAP0_MAGIC) and len(data) >= 2 * len(MCAP0_MAGIC) + _DATA_END + _FOOTER


def check(data: bytes) -> None:
    """Raise DamagedTrace unless an MCAP file is complete and every bit is as written.

    Two checksums cover the whole file: one covers the records up to the end of the data, and the other covers the
    summary.
    """
    if not is_ended(data):
        raise DamagedTrace("is cut short")
    footer = len(data) - len(MCAP0_MAGIC) - _FOOTER
    summary, _, summary_crc = struct.unpack_from("<QQI", data, footer + _HEAD.size)
    if zlib.crc32(data[min(summary, footer) : footer + _FOOTER - 4]) != summary_crc:
        raise DamagedTrace("is damaged")
    end = summary - _DATA_END
    if not 0 <= end <= footer or _HEAD.unpack_from(data, end) != (Opcode.DATA_END, 4):
        raise DamagedTrace("is damaged")
    if struct.unpack_from("<I", data, end + _HEAD.size) != (zlib.crc32(data[:end]),):
        raise DamagedTrace("is damaged")


def front(data: bytes) -> Front:
    """Return the trace's own metadata, which may be empty, and its plan."""
    metadata: dict[str, str] = {}
    plan = None
    for opcode, body in _records(data):
        if opcode == Opcode.METADATA and (found := _parsed(Metadata, body)).name == METADATA:
            metadata = found.metadata
        elif opcode == Opcode.ATTACHMENT:
            attached = _parsed(Attachment, body)
            if attached.name in (PLAN, PACKED_PLAN):
                plan = attached.data if attached.name == PLAN else _unpacked(attached.data)
        elif opcode == Opcode.CHUNK:
            break
    return Front(metadata, plan)


def _unpacked(data: bytes) -> bytes:
    """Decompress bytes. Raises DamagedTrace if the bytes are damaged, or if the result would be larger than
    `LARGEST`.
    """
    try:
        if not 0 <= frame_content_size(data) <= LARGEST:
            raise DamagedTrace("is damaged")
        return ZstdDecompressor().decompress(data)
    except ZstdError:
        raise DamagedTrace("is damaged") from None


def read_messages(data: bytes, *, lenient: bool = False) -> Iterator[RawMessage]:
    """Yield the messages in the complete chunks of a file. A damaged chunk raises DamagedTrace. If `lenient` is True,
    the messages end before the first damaged chunk, and nothing is raised.
    """
    topics: dict[int, str] = {}
    for opcode, body in _records(data):
        if opcode != Opcode.CHUNK:
            continue
        try:
            content = breakup_chunk(_modest(_parsed(Chunk, body)), validate_crc=True)
        except (DamagedTrace, *_TROUBLE):
            if lenient:
                return
            raise DamagedTrace("is damaged") from None
        for record in content:
            if isinstance(record, Channel):
                topics[record.id] = record.topic
            elif isinstance(record, Message):
                yield RawMessage(topics.get(record.channel_id, ""), record.log_time, record.data)


def _modest(chunk: Chunk) -> Chunk:
    """Return a chunk unchanged. Raises DamagedTrace if the decompressed chunk would be larger than `LARGEST`."""
    packed = chunk.compression == "zstd"
    size = max(chunk.uncompressed_size, frame_content_size(chunk.data) if packed else len(chunk.data))
    if size > LARGEST or not (packed or chunk.compression == ""):
        raise DamagedTrace("is damaged")
    return chunk


def _records(data: bytes) -> Iterator[tuple[int, bytes]]:
    at = len(MCAP0_MAGIC)
    while at + _HEAD.size <= len(data):
        opcode, length = _HEAD.unpack_from(data, at)
        at += _HEAD.size
        if at + length > len(data):
            return
        yield opcode, data[at : at + length]
        at += length


def _parsed(kind: type[Kind], body: bytes) -> Kind:
    """Parse a record of one kind. Raises DamagedTrace if the bytes are not such a record."""
    try:
        found: Kind = kind.read(ReadDataStream(BytesIO(body)))
    except _TROUBLE:
        raise DamagedTrace("is damaged") from None
    return found


def event_data(event: Event) -> bytes:
    """Encode an event as a trace stores it."""
    return to_line(event)[:-1]


def until(messages: Iterable[RawMessage], events: int | None) -> Iterator[RawMessage]:
    """Yield the messages up to event number `events`, or all messages if `events` is None."""
    if events == 0:
        return
    count = 0
    for message in messages:
        yield message
        count += message.topic == EVENTS
        if count == events:
            return


def known(data: bytes, events: Sequence[Event]) -> int:
    """Compare `events` with the events in a trace. Return the number of equal events before the first difference."""
    written = (message.data for message in read_messages(data, lenient=True) if message.topic == EVENTS)
    count = 0
    for event, there in zip(events, written, strict=False):
        if event_data(event) != there:
            break
        count += 1
    return count
