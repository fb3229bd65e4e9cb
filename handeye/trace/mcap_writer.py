"""Writes an MCAP file while a run goes on. Everything written before a sync survives a crash of the program."""

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import msgspec
from mcap.records import Attachment, Channel, Metadata, Schema
from zstandard import compress

from handeye.core.errors import CannotWrite
from handeye.core.files import settle, write_whole
from handeye.core.versions import HANDEYE
from handeye.program.events import RunStarted
from handeye.trace.channels import (
    FORMAT,
    METADATA,
    NUMBERS,
    PACKED_PLAN,
    PLAN,
    THINNED,
    VERSION,
    channels_of,
    nanoseconds,
)
from handeye.trace.mcap_encoder import McapEncoder

CHUNK: Final = 1 << 20  # bytes of messages after which a chunk is closed
_HARDEST: Final = 19
"""Level at which a plan is compressed. The compression takes a few tenths of a second, and reduces the plan to a tenth
of its size.
"""


class GrowingFile:
    """A trace that is being written. The first write error raises CannotWrite.

    A new chunk begins when the present chunk has `CHUNK` bytes. A new chunk also begins after the message that starts
    the run, and at the end of each stage. Because chunks do not depend on the time of writing, equal messages give
    equal bytes. A sync writes parts of the chunk in progress. The whole chunk later replaces these parts.
    """

    def __init__(self, file: Path) -> None:
        """Create the file, or empty an existing file."""
        self.file = file
        self.broken = False  # something could not be written; the file ends there
        self.released = False
        self._encoder = McapEncoder()
        self._pending = 0  # bytes of messages in the chunk in progress
        self._partly = False  # the file ends with parts of the chunk in progress
        self._complaining = _Complaining(self)
        with self._complaining:
            self._handle = os.open(file, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o666)

    def begin(self, head: RunStarted, plan: bytes, *, thinned: bool = False) -> None:
        """Write everything that precedes the messages. `thinned` means that the file will contain only some of
        the run's servo periods.
        """
        said = msgspec.to_builtins(head)
        said["seed"], said["world"] = head.world.seed, msgspec.json.encode(head.world).decode()
        metadata = {
            "format": FORMAT,
            "version": VERSION,
            **({THINNED: "yes"} if thinned else {}),
            **_flat(said),
        }
        time = nanoseconds(head.time)
        attachment = (
            Attachment(0, time, PACKED_PLAN, "application/zstd", compress(plan, _HARDEST))
            if thinned
            else Attachment(0, time, PLAN, "application/json", plan)
        )
        channels = [
            (
                Schema(number, channel.schema, channel.schema_encoding, channel.schema_name),
                Channel(number, channel.topic, channel.encoding, {}, number),
            )
            for number, channel in enumerate(channels_of(head.system), 1)
        ]
        described = Metadata(METADATA, {key: str(value) for key, value in metadata.items()})
        with self._complaining:
            self._append(self._encoder.front(f"handeye {HANDEYE}", described, attachment, channels))

    def write(self, topic: str, time: int, data: bytes, *, boundary: bool = False) -> None:
        """Write a message; `time` is in ns. A `boundary` ends the chunk. After a failed write, nothing more is
        written.
        """
        if self.broken:
            return
        with self._complaining:
            self._encoder.add(NUMBERS[topic], time, data)
            self._pending += len(data)
            if self._pending >= CHUNK or boundary:
                self._end_chunk()

    def sync(self) -> None:
        """Flush everything written so far to the disk."""
        if self.broken:
            return
        with self._complaining:
            if part := self._encoder.part():
                self._partly = True
                self._append(part)
            settle(self._handle)

    def finish(self) -> None:
        """Write the summary, which completes the file. If the summary cannot be written, the messages can still
        be read.
        """
        with self._complaining:
            self._end_chunk()
            self._append(self._encoder.end())
            settle(self._handle)

    def release(self) -> None:
        """Close the file without completing it."""
        if not self.released:
            os.close(self._handle)
        self.released = True

    def move(self, file: Path) -> None:
        """Rename the file. A file that has the new name is replaced."""
        with self._complaining:
            os.replace(self.file, file)
        self.file = file

    def _end_chunk(self) -> None:
        """Write the chunk in progress. If parts of the chunk were written earlier, these parts stay in the file until
        the whole chunk is on the disk.
        """
        whole, chunk, self._pending = self._encoder.size, self._encoder.chunk(), 0
        if not self._partly:
            self._append(chunk)
            return
        self._partly = False
        write_whole(self.file, self.file.read_bytes()[:whole] + chunk)
        os.close(self._handle)
        self._handle = os.open(self.file, os.O_WRONLY | os.O_APPEND)

    def _append(self, data: bytes) -> None:
        """Write every byte immediately, without a buffer, or raise OSError."""
        view = memoryview(data)
        while view:
            view = view[os.write(self._handle, view) :]


@dataclass(frozen=True, slots=True)
class _Complaining:
    """A context that turns an error of the operating system into a CannotWrite. After any exception, nothing more is
    written, because the chunk may be incomplete (for example, after Ctrl-C).
    """

    about: GrowingFile

    def __enter__(self) -> None:
        pass

    def __exit__(self, _: object, error: BaseException | None, __: object) -> None:
        if error is not None:
            self.about.broken = True
        if isinstance(error, OSError):
            raise CannotWrite(f"{self.about.file} cannot be written: {error.strerror}") from None


def _flat(fields: dict[str, Any], before: str = "") -> dict[str, Any]:
    """Flatten nested fields. Names of nested fields are joined by dots."""
    flat: dict[str, Any] = {}
    for name, value in fields.items():
        inner = isinstance(value, dict)
        flat |= (
            _flat(dict(sorted(value.items())), f"{before}{name}.") if inner else {f"{before}{name}": value}
        )
    return flat
