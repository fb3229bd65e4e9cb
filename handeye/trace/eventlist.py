"""Event lists on disk (`events.jsonl`), and what of them counts."""

from collections.abc import Iterable
from pathlib import Path

import msgspec

from handeye.core.errors import BadFile
from handeye.core.files import read_whole
from handeye.program.event_reading import EventReader
from handeye.program.events import AnyEvent, WentBack


def read_events(path: Path, *, growing: bool = False) -> list[AnyEvent]:
    """The events in a file, one JSON object a line, those undone later included.

    Args:
        growing: a last line that is cut short is left out.

    Raises:
        InvalidInput: it cannot be read, or one of its lines is cut short or not an event.
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
    return events


def effective(events: Iterable[AnyEvent]) -> list[AnyEvent]:
    """The events that were not undone."""
    left: list[AnyEvent] = []
    for event in events:
        if isinstance(event, WentBack):
            del left[event.events :]
        else:
            left.append(event)
    return left
