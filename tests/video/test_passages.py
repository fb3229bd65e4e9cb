"""What a video shows of a run, and for how long."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from recordings import record, started

from handeye.core.errors import InvalidInput
from handeye.program.events import AnyEvent, CameraBusy, StageFinished, StageStarted
from handeye.trace.reading import read_trace
from handeye.trace.trace import Trace
from handeye.video.passages import Passage, at_speed, passage_at, passages, within


@pytest.fixture
def trace(tmp_path: Path) -> Trace:
    record(tmp_path / "short.mcap")
    return read_trace(tmp_path / "short.mcap")


def stage(name: str, begin: float, end: float) -> tuple[AnyEvent, ...]:
    return (StageStarted(time=begin, stage=name), StageFinished(time=end, stage=name, status="done"))


def run_of(trace: Trace, *events: AnyEvent) -> Trace:
    """The run, with other things happening in it."""
    return replace(trace, events=(started(), *events))


def spans(shown: tuple[Passage, ...]) -> list[tuple[float, float, int]]:
    return [(passage.begin, passage.end, passage.stage) for passage in shown]


def test_of_a_long_wait_for_the_camera_one_second_is_left(trace: Trace) -> None:
    run = run_of(trace, CameraBusy(time=40.0, action="lens", seconds=20.0))
    assert spans(passages(run, (10.0, 60.0), looks=False)) == [(10.0, 21.0, -1), (40.0, 60.0, -1)]


def test_a_short_wait_is_shown(trace: Trace) -> None:
    run = run_of(trace, CameraBusy(time=40.0, action="digitise", seconds=0.5))
    assert spans(passages(run, (10.0, 60.0), looks=False)) == [(10.0, 60.0, -1)]


def test_a_wait_before_the_beginning_or_after_the_end_changes_nothing(trace: Trace) -> None:
    waits = [CameraBusy(time=time, action="lens", seconds=5.0) for time in (9.0, 90.0)]
    assert spans(passages(run_of(trace, *waits), (10.0, 60.0), looks=False)) == [(10.0, 60.0, -1)]


def test_a_passage_is_of_one_stage(trace: Trace) -> None:
    run = run_of(trace, *stage("one", 10, 20), *stage("two", 20, 50))
    assert spans(passages(run, (15, 40), looks=False)) == [(15, 20, 0), (20, 40, 1)]


def test_the_run_stands_still_where_a_picture_was_taken(trace: Trace) -> None:
    shown = passages(trace, trace.covers, looks=True)
    assert [passage.looked_at.name for passage in shown if passage.looked_at] == ["WIDE"]
    still = next(passage for passage in shown if passage.looked_at)
    assert (still.begin, still.stage) == (still.end, 1)


@pytest.mark.parametrize("begun", [1 / 3, 9.7, 161.933333 % 10])
def test_a_picture_taken_as_a_stage_ends_is_of_that_stage(trace: Trace, begun: float) -> None:
    shown = passages(replace(trace, head=started(begun)), trace.covers, looks=True)
    assert [passage.stage for passage in shown if passage.looked_at] == [1]


def test_where_nothing_was_recorded_there_is_nothing_to_show(trace: Trace) -> None:
    with pytest.raises(
        InvalidInput, match=r"^.*short\.mcap has no motion in the part that the video would show$"
    ):
        passages(trace, (10.5, 10.5), looks=False)


def test_at_a_speed_all_stages_are_equally_fast(trace: Trace) -> None:
    run = run_of(trace, *stage("one", 10, 12), *stage("two", 12, 100))
    assert at_speed(passages(run, (10, 100), looks=False), 4.0).tolist() == [0.5, 22.0]


@pytest.mark.parametrize("seconds", [1.0, 14.0])
def test_in_a_length_each_stage_has_two_thirds_of_an_equal_share_at_least(
    trace: Trace, seconds: float
) -> None:
    run = run_of(trace, *stage("one", 10, 12), *stage("two", 12, 14), *stage("three", 14, 100))
    lasts = within(passages(run, (10, 100), looks=False), seconds)
    assert lasts.sum() == pytest.approx(seconds)
    assert lasts[:2] == pytest.approx(2 / 9 * seconds)


def test_pictures_take_no_more_than_four_tenths_of_a_video(trace: Trace) -> None:
    shown = passages(trace, trace.covers, looks=True)
    for seconds, look in ((0.5, 0.2), (10.0, 0.7)):
        lasts = within(shown, seconds)
        assert lasts.sum() == pytest.approx(seconds)
        assert lasts[[passage.looked_at is not None for passage in shown]] == pytest.approx(look)


def test_each_moment_of_the_video_is_one_of_a_passage() -> None:
    at, over = passage_at(np.array([1.0, 3.0]), np.array([0.0, 0.5, 1.0, 2.5, 4.0]))
    assert at.tolist() == [0, 0, 1, 1, 1]
    assert over.tolist() == [0.0, 0.5, 0.0, 0.5, 1.0]
