"""The event list of a run on disk: one JSON object a line, appended as things happen, never rewritten."""

import errno
import os
from pathlib import Path
from typing import Literal

from handeye.errors import InvalidInput
from handeye.work.events import AnyEvent, WentBack, to_line


class Journal:
    """Appends events to a file; what is undone stays in it, followed by a line that says so."""

    def __init__(self, path: Path, *, anew: bool) -> None:
        """Begin a journal, or go on with one; a last line that was cut short is dropped.

        Raises:
            InvalidInput: the file cannot be written.
        """
        self._path = path
        self._owed: WentBack | None = None  # there was no room for it
        try:
            self._file = path.open("wb" if anew else "ab", buffering=0)
            if not anew:
                text = path.read_bytes()
                self._file.truncate(text.rfind(b"\n") + 1)
        except OSError as error:
            raise self._unwritable(error) from None

    def append(self, event: AnyEvent) -> None:
        """Write one event.

        Raises:
            InvalidInput: there is no room.
        """
        owed, self._owed = self._owed, None
        if owed is not None and not isinstance(event, WentBack):
            self.undone(owed.events, owed.time, owed.why)
        line = to_line(event)
        try:
            whole = self._file.seek(0, os.SEEK_END)
            if self._file.write(line) < len(line):
                self._file.truncate(whole)  # half a line would spoil the next
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        except OSError as error:
            raise self._unwritable(error) from None

    def undone(self, events: int, time: float, why: Literal["back", "resumed"]) -> None:
        """Note that only the first `events` events have happened; if there is no room, before the next one."""
        back = WentBack(time=time, events=events, why=why)
        try:
            self.append(back)
        except InvalidInput:
            self._owed = back
            raise

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def _unwritable(self, error: OSError) -> InvalidInput:
        return InvalidInput(f"{self._path} cannot be written: {error.strerror}")
