"""The event list of a run on disk: one JSON object a line, appended as things happen, never rewritten."""

import errno
import os
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Literal

from handeye.errors import InvalidInput
from handeye.events import AnyEvent, WentBack, to_line
from handeye.trace.eventlist import effective, read_events


class Journal:
    """Appends events to a file; what is undone stays in it, followed by a line that says so."""

    def __init__(self, path: Path, events: Sequence[AnyEvent], *, again: bool) -> None:
        """Begin a journal with these events, or go on with one.

        A last line that was cut short is dropped; a journal that has lost some of the events is begun anew.

        Raises:
            InvalidInput: the file cannot be written, is being written by another run, or is no event list.
        """
        self._path = path
        self._owed: WentBack | None = None  # there was no room for it
        if path.exists() and not path.is_file():  # to open a pipe that nobody reads would wait for ever
            raise InvalidInput(f"{path} cannot be written: it is not a file")
        try:
            self._file = path.open("ab", buffering=0)
            self._lock()
            text = path.read_bytes() if again else b""
            self._file.truncate(text.rfind(b"\n") + 1)
        except OSError as error:
            raise self._unwritable(error) from None
        lacking = effective(read_events(path))[: len(events)] != list(events)
        self.lost = again and lacking
        """Some of the events were not there, and it was begun anew: what was undone before is told nowhere."""
        if lacking:
            self._file.truncate(0)
            for event in events:
                self.append(event)

    def append(self, event: AnyEvent) -> None:
        """Write one event.

        Raises:
            InvalidInput: there is no room.
        """
        owed, self._owed = self._owed, None
        if owed is not None and not isinstance(event, WentBack):
            self._write(owed)
        self._write(event)

    def undone(self, events: int, time: float, why: Literal["back", "resumed"]) -> None:
        """Note that only the first `events` events have happened; if there is no room, before the next one."""
        self.append(WentBack(time=time, events=events, why=why))

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def _write(self, event: AnyEvent) -> None:
        line = to_line(event)
        try:
            whole = self._file.seek(0, os.SEEK_END)
            if self._file.write(line) < len(line):
                self._file.truncate(whole)  # half a line would spoil the next
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        except OSError as error:
            self._owed = event if isinstance(event, WentBack) else None
            raise self._unwritable(error) from None

    def _lock(self) -> None:
        """Keep other runs from writing here, where the platform can. Raises InvalidInput if one does already."""
        with suppress(ImportError):
            import fcntl

            try:
                fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                self._file.close()
                raise InvalidInput(f"another run is writing to {self._path} now") from None

    def _unwritable(self, error: OSError) -> InvalidInput:
        return InvalidInput(f"{self._path} cannot be written: {error.strerror}")
