"""Writes an MCAP file while a run goes on. Everything written before a sync survives a crash of the program."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, Final, cast

import msgspec
from mcap.writer import Writer
from zstandard import compress

from handeye.core.errors import CannotWrite
from handeye.core.files import settle
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

CHUNK: Final = 1 << 20  # bytes of messages after which a chunk is closed
_HARDEST: Final = 19
"""Compression level of a plan. It takes a few tenths of a second, and leaves a tenth of the size."""


@dataclass(slots=True)
class _Sink:
    """Output of the MCAP writer. It writes every byte immediately, without a buffer, or raises OSError."""

    handle: int
    count: int = 0

    def write(self, data: bytes) -> int:
        view = memoryview(data)
        while view:
            view = view[os.write(self.handle, view) :]
        self.count += len(data)
        return len(data)

    def tell(self) -> int:
        return self.count

    def flush(self) -> None:
        """Do nothing, because there is no buffer."""


class GrowingFile:
    """A trace that is being written. The first write error raises CannotWrite.

    A chunk ends after `CHUNK` bytes, after the start of the run, and at the end of each stage. Equal messages
    therefore give equal bytes, unless a sync ends a chunk early. In that case the file is marked as `uneven`.
    """

    def __init__(self, file: Path) -> None:
        """Create the file, or empty it."""
        self.file = file
        self.uneven = False  # True if a sync has ended a chunk early
        self.broken = False  # something could not be written; the file ends there
        self.released = False
        self._pending = 0  # bytes in the chunk in progress
        with self._complaining():
            self._sink = _Sink(os.open(file, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o666))
        self._writer = Writer(cast(IO[Any], self._sink), chunk_size=1 << 62, enable_data_crcs=True)

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
        with self._complaining():
            self._writer.start(library=f"handeye {HANDEYE}")
            self._writer.add_metadata(METADATA, {key: str(value) for key, value in metadata.items()})
            time = nanoseconds(head.time)
            if thinned:
                self._writer.add_attachment(
                    0, time, PACKED_PLAN, "application/zstd", compress(plan, _HARDEST)
                )
            else:
                self._writer.add_attachment(0, time, PLAN, "application/json", plan)
            for channel in channels_of(head.system):
                schema = self._writer.register_schema(
                    channel.schema_name, channel.schema_encoding, channel.schema
                )
                self._writer.register_channel(channel.topic, channel.encoding, schema)

    def write(self, topic: str, time: int, data: bytes, *, boundary: bool = False) -> None:
        """Write a message; `time` is in ns. A `boundary` ends the chunk. After a failed write, nothing more is
        written.
        """
        if self.broken:
            return
        with self._complaining():
            self._writer.add_message(NUMBERS[topic], time, data, time)
            self._pending += len(data)
            if self._pending >= CHUNK or boundary:
                self._end_chunk()

    def sync(self) -> None:
        """Flush everything written so far to the disk."""
        if self.broken:
            return
        with self._complaining():
            if self._pending:
                self.uneven = True
                self._end_chunk()
            settle(self._sink.handle)

    def finish(self) -> None:
        """Write the summary, which completes the file. If the summary cannot be written, the messages can still
        be read.
        """
        with self._complaining():
            self._writer.finish()
            settle(self._sink.handle)

    def release(self) -> None:
        """Close the file without completing it."""
        if not self.released:
            os.close(self._sink.handle)
        self.released = True

    def move(self, file: Path) -> None:
        """Rename the file. A file that has the new name is replaced."""
        with self._complaining():
            os.replace(self.file, file)
        self.file = file

    def _end_chunk(self) -> None:
        self._pending = 0
        self._writer.flush()

    @contextmanager
    def _complaining(self) -> Iterator[None]:
        """Within this context, turn an error of the operating system into a CannotWrite. After such an error,
        nothing more is written.
        """
        try:
            yield
        except OSError as error:
            self.broken = True
            raise CannotWrite(f"{self.file} cannot be written: {error.strerror}") from None
        except BaseException:  # Ctrl-C in the middle of a chunk: the chunk may be incomplete
            self.broken = True
            raise


def _flat(fields: dict[str, Any], before: str = "") -> dict[str, Any]:
    """Flatten nested fields. Names of nested fields are joined by dots."""
    flat: dict[str, Any] = {}
    for name, value in fields.items():
        inner = isinstance(value, dict)
        flat |= (
            _flat(dict(sorted(value.items())), f"{before}{name}.") if inner else {f"{before}{name}": value}
        )
    return flat
