"""Append-only files of lines."""

import errno
import os
from contextlib import suppress
from pathlib import Path

from handeye.core.errors import CannotWrite, InvalidInput


class LineFile:
    """Appends whole lines to a file; one writer at a time."""

    def __init__(self, path: Path, writer: str, *, again: bool = True) -> None:
        """Continue a file, without a last line cut short, or begin anew unless `again`; raises CannotWrite.

        Args:
            writer: who else may be writing to it, with its article.
        """
        self.path = path
        if path.exists() and not path.is_file():  # to open a pipe that nobody reads would wait for ever
            raise CannotWrite(f"{path} cannot be written: it is not a file")
        try:
            self._file = path.open("ab", buffering=0)
            self._lock(writer)
            text = path.read_bytes() if again else b""
            self._file.truncate(text.rfind(b"\n") + 1)
        except OSError as error:
            raise self._unwritable(error) from None

    def append(self, line: bytes) -> None:
        """Write a line, its end included, whole or not at all; raises CannotWrite."""
        try:
            whole = self._file.seek(0, os.SEEK_END)
            if self._file.write(line) < len(line):
                self._file.truncate(whole)  # half a line would spoil the next
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        except OSError as error:
            raise self._unwritable(error) from None

    def clear(self) -> None:
        """Drop all lines."""
        self._file.truncate(0)

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def _lock(self, writer: str) -> None:
        """Lock the file where the platform can; raises CannotWrite if it is locked."""
        with suppress(ImportError):
            import fcntl

            try:
                fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                self._file.close()
                raise CannotWrite(f"{writer} is writing to {self.path} now") from None

    def _unwritable(self, error: OSError) -> InvalidInput:
        return CannotWrite(f"{self.path} cannot be written: {error.strerror}")
