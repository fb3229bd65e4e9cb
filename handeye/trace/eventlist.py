"""Reads and writes event lists (`events.jsonl`): one JSON object per line, appended as events happen, and never
changed afterwards."""

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Literal

import msgspec

from handeye.core.errors import BadFile, InvalidInput
from handeye.core.files import LineFile, read_whole
from handeye.program.event_reading import EventReader
from handeye.program.events import AnyEvent, RunStarted, WentBack, to_line


def read_events(path: Path, *, growing: bool = False) -> list[AnyEvent]:
    """Return the events in a file, including the events that were undone later because the run went back.

    Raises BadFile if a line is not an event, or if the run does not begin at time 0. If `growing` is False, also
    raises BadFile if the last line is incomplete.
    """
    text = read_whole(path)
    if growing:
        text = text[: text.rfind(b"\n") + 1]
    events, reader = [], EventReader()
    for number, line in enumerate(text.splitlines(keepends=True), 1):
        if not line.endswith(b"\n"):
            raise BadFile(f"line {number} of {path} is cut short")
        try:
            events.append(reader.read(line))
        except msgspec.DecodeError as error:
            raise BadFile(f"line {number} of {path} is not an event: {error}") from None
    if events and isinstance(events[0], RunStarted) and events[0].time:
        raise BadFile(
            f"{path} begins at {events[0].time:.2f} s, as in earlier versions of handeye; a run must begin at 0 s"
        )
    return events


def effective(events: Iterable[AnyEvent]) -> list[AnyEvent]:
    """Return the events, without the events that were undone because the run went back."""
    left: list[AnyEvent] = []
    for event in events:
        if isinstance(event, WentBack):
            del left[event.events :]
        else:
            left.append(event)
    return left


class Journal:
    """Appends events to a file. When the run goes back, the undone events stay in the file, and a `WentBack`
    event follows them."""

    def __init__(self, path: Path, events: Sequence[AnyEvent], *, again: bool) -> None:
        """Open the journal of a run in which `events` have happened. An incomplete last line of the file is dropped.
        If events are missing in the file, it is written again from the start.
        """
        self._owed: WentBack | None = None  # could not be written yet, because the disk was full
        self._file = LineFile(path, "another run", again=again)
        lacking = effective(read_events(path))[: len(events)] != list(events)
        self.lost = again and lacking  # True if the journal was started again because events were missing
        if lacking:
            self._file.clear()
            for event in events:
                self.append(event)

    @property
    def unlocked(self) -> str:
        """The reason why the file cannot be locked against writing by other runs; empty if it is locked."""
        return self._file.unlocked

    def append(self, event: AnyEvent) -> None:
        """Write one event. Raises CannotWrite if the disk is full."""
        owed, self._owed = self._owed, None
        if owed is not None and not isinstance(event, WentBack):
            self._write(owed)
        self._write(event)

    def undone(self, events: int, time: float, why: Literal["back", "resumed"]) -> None:
        """Record that all events except the first `events` were undone. If the disk is full now, the record is written
        later, before the next event.
        """
        self.append(WentBack(time=time, events=events, why=why))

    def close(self) -> None:
        self._file.close()

    def _write(self, event: AnyEvent) -> None:
        try:
            self._file.append(to_line(event))
        except InvalidInput:
            self._owed = event if isinstance(event, WentBack) else None
            raise
