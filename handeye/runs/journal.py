"""The event list of a run on disk: one JSON object a line, appended as things happen, never rewritten."""

from collections.abc import Sequence
from pathlib import Path
from typing import Literal

from handeye.core.errors import InvalidInput
from handeye.core.line_file import LineFile
from handeye.program.events import AnyEvent, WentBack, to_line
from handeye.trace.eventlist import effective, read_events


class Journal:
    """Appends events to a file; what is undone stays in it, followed by a line that says so."""

    def __init__(self, path: Path, events: Sequence[AnyEvent], *, again: bool) -> None:
        """Begin a journal with these events, or go on with one.

        A last line that was cut short is dropped; a journal that has lost some of the events is begun anew.

        Raises:
            InvalidInput: the file cannot be written, is being written by another run, or is no event list.
        """
        self._owed: WentBack | None = None  # there was no room for it
        self._file = LineFile(path, "another run", again=again)
        lacking = effective(read_events(path))[: len(events)] != list(events)
        self.lost = again and lacking
        """Some of the events were not there, and it was begun anew: what was undone before is told nowhere."""
        if lacking:
            self._file.clear()
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
        try:
            self._file.append(to_line(event))
        except InvalidInput:
            self._owed = event if isinstance(event, WentBack) else None
            raise
