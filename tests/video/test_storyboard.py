"""What each frame of a video shows: the moment, the words, and how long the last one stands."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from recordings import record
from report_pages import renamed

from handeye.core.errors import InvalidInput
from handeye.program.events import OperatorCalled, StageFinished, StageUndone, UndoOrdered, UndoStarted
from handeye.report.recorded import RecordedRun
from handeye.trace.reading import read_trace
from handeye.trace.trace import Trace
from handeye.video import storyboard as module
from handeye.video.passages import Passage
from handeye.video.request import VideoRequest
from handeye.video.storyboard import storyboard


@pytest.fixture(autouse=True)
def one_view(monkeypatch: pytest.MonkeyPatch) -> None:
    """No scene is built for what is not drawn."""
    monkeypatch.setattr(module, "views", lambda trace, camera, stages, rate: [camera] * len(stages))


@pytest.fixture
def trace(tmp_path: Path) -> Trace:
    """A run of the stages open, close and again, from 0 to 1.2 s; `close` ends with a picture."""
    record(tmp_path / "short.mcap")
    return read_trace(tmp_path / "short.mcap")


def test_it_goes_from_the_beginning_to_the_end_in_the_time_that_it_has(trace: Trace) -> None:
    board = storyboard(trace, VideoRequest(seconds=3))
    times = [frame.time for frame in board.frames]
    assert (times[0], times[-1]) == pytest.approx(trace.covers)
    assert (np.diff(times) > 0).all()
    assert board.seconds == 3


@pytest.mark.parametrize(("seconds", "held"), [(0.01, 0), (2.0, 2), (14.0, 17), (60.0, 18)])
def test_the_last_frame_stands_for_a_tenth_of_it(trace: Trace, seconds: float, held: int) -> None:
    assert storyboard(trace, VideoRequest(seconds=seconds)).held == held


def test_without_a_word_it_takes_fourteen_seconds(trace: Trace) -> None:
    assert storyboard(trace, VideoRequest()).seconds == 14


def test_at_a_speed_it_takes_what_the_run_took(trace: Trace) -> None:
    board = storyboard(trace, VideoRequest(speed=0.25))
    assert len(board.frames) == 58  # 1.2 s four times as slow, twelve a second
    assert np.diff([frame.time for frame in board.frames]) == pytest.approx(1.2 / 57)


@pytest.mark.parametrize(
    ("first", "last", "span"),
    [("2", None, (0.4, 1.2)), (None, "op", (0.0, 0.4)), (2, "close", (0.4, 0.8))],
)
def test_it_goes_from_stage_to_stage(
    trace: Trace, first: str | int | None, last: str | int | None, span: tuple[float, float]
) -> None:
    board = storyboard(trace, VideoRequest(first=first, last=last))
    assert (board.frames[0].time, board.frames[-1].time) == pytest.approx(span)


def test_a_stage_that_was_not_come_to_is_told_with_those_that_are_there(trace: Trace) -> None:
    short = replace(trace, events=tuple(event for event in trace.events if event.time < 0.4))
    with pytest.raises(InvalidInput, match=r"short\.mcap does not show stage `again`; it shows `open`$"):
        storyboard(short, VideoRequest(first="again"))


def test_captions_tell_stage_clock_and_place_among_all(trace: Trace) -> None:
    frames = storyboard(trace, VideoRequest(captions=True, speed=0.1)).frames
    assert {(f.caption.words, f.caption.begun, f.caption.stages) for f in frames if f.caption} == {
        ("1  open", 1, 3),
        ("2  close", 2, 3),
        ("3  again", 3, 3),
    }
    assert {f.caption.clock for f in frames if f.caption} == {"0:00", "0:01"}
    assert not any(f.caption.stopped for f in frames if f.caption)


def test_each_picture_is_looked_at_for_a_while_and_in_its_stage(trace: Trace) -> None:
    frames = storyboard(trace, VideoRequest(captions=True, speed=0.1)).frames
    looking = [frame for frame in frames if frame.looked_at]
    assert 7 <= len(looking) <= 9
    assert {
        (f.time, f.caption.words, len(f.looked_at.marks)) for f in looking if f.caption and f.looked_at
    } == {(0.8, "2  close", 3)}


def test_without_captions_nothing_is_said_and_nothing_stands_still(trace: Trace) -> None:
    frames = storyboard(trace, VideoRequest(speed=0.1)).frames
    assert {(frame.caption, frame.looked_at) for frame in frames} == {(None, None)}


def test_a_stage_that_was_stopped_says_so_when_it_is(trace: Trace) -> None:
    events = tuple(
        StageFinished(time=event.time, stage=event.stage, status="stopped")
        if isinstance(event, StageFinished) and event.stage == "again"
        else event
        for event in trace.events
    )
    captions = [
        f.caption for f in storyboard(replace(trace, events=events), VideoRequest(captions=True)).frames
    ]
    assert captions[-1] is not None
    assert (captions[-1].words, captions[-1].stopped) == ("3  again: stopped", True)
    assert sum(caption.stopped for caption in captions if caption) <= 3


def test_captions_tell_which_stage_the_arm_undoes(trace: Trace) -> None:
    back = (
        UndoOrdered(time=1.2, left=0, halts=True),
        UndoStarted(time=1.2, step=3, line=4, text="CLOSE"),
        StageUndone(time=1.3, stage="again"),
        UndoStarted(time=1.3, step=2, line=3, text="CLOSE"),
        OperatorCalled(time=1.4, message="the hand has met 24 N"),
    )
    undone = replace(trace, events=(*trace.events, *back))
    shown = {
        stage.begin: module._caption(
            undone, ("open", "close", "again"), Passage(begin=0, end=0, stage=number), 0
        )
        for number, stage in enumerate(undone.stages_both_ways)
    }
    words = [(at, caption.words, caption.begun) for at, caption in shown.items()]
    assert words[2:] == [(0.8, "3  again", 3), (1.2, "3  undo: again", 3), (1.3, "2  undo: close", 2)]
    assert [stage.name for stage in undone.stages] == ["open", "close", "again"]


def test_a_stage_is_called_what_it_is_called(trace: Trace) -> None:
    evil = renamed(RecordedRun(trace=trace), stage="</script>\x1b[31m").trace
    (words,) = {
        frame.caption.words for frame in storyboard(evil, VideoRequest(captions=True)).frames if frame.caption
    }
    assert words == "</script>␛[31m"
