"""Event lists on disk are read as they were written, and what was undone does not count."""

from pathlib import Path

import pytest
from recordings import EVENTS

from handeye.core.errors import InvalidInput
from handeye.program.events import WentBack, to_line
from handeye.trace.eventlist import effective, read_events


def _written(path: Path, data: bytes) -> Path:
    path.write_bytes(data)
    return path


def test_a_list_is_read_as_it_was_written(tmp_path: Path) -> None:
    path = _written(tmp_path / "events.jsonl", b"".join(to_line(event) for event in EVENTS))
    assert read_events(path) == EVENTS


def test_a_line_that_is_cut_short_is_named(tmp_path: Path) -> None:
    path = _written(tmp_path / "events.jsonl", to_line(EVENTS[0]) + to_line(EVENTS[1])[:-1])
    with pytest.raises(InvalidInput, match=r"^line 2 of .*events\.jsonl is cut short$"):
        read_events(path)


@pytest.mark.parametrize(
    "garbage", [b"\xff\xfe\n", b"{}\n", b"\n", b'{"event":"Sneezed","time":1.0}\n', b"[" * 100_000 + b"\n"]
)
def test_a_line_that_is_no_event_is_named(tmp_path: Path, garbage: bytes) -> None:
    path = _written(tmp_path / "events.jsonl", to_line(EVENTS[0]) + garbage + to_line(EVENTS[1]))
    with pytest.raises(InvalidInput, match=r"^line 2 of .*events\.jsonl is not an event: "):
        read_events(path)


def test_a_list_that_is_not_there_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match=r"^.*none\.jsonl: there is no such file$"):
        read_events(tmp_path / "none.jsonl")


def test_what_was_undone_does_not_count_however_often_one_went_back() -> None:
    a, b, c, d, e, *_ = EVENTS
    back, again = (WentBack(time=11.0, events=count, why="back") for count in (2, 1))
    assert effective([a, b, c, back, d, again, e]) == [a, e]
