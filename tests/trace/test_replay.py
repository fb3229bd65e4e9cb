"""A replay shows the run as it was, at any time, in any order."""

from pathlib import Path

import numpy as np
import pytest
from recordings import HISTORY, Recording, record

from handeye.core.errors import InvalidInput
from handeye.ports.workcell import Sensed
from handeye.trace.reading import read_trace
from handeye.trace.trace import Trace

TICKS = [moment for moment in HISTORY if isinstance(moment.what, Sensed)]


@pytest.fixture
def trace(tmp_path: Path) -> Trace:
    record(tmp_path / "short.mcap")
    return read_trace(tmp_path / "short.mcap")


def test_what_is_no_time_is_refused(trace: Trace) -> None:
    with pytest.raises(InvalidInput, match=r"^a time must be a number of seconds, not '3'$"):
        trace.at("3")


def test_joints_and_frames_are_where_they_were_in_every_servo_period(trace: Trace) -> None:
    for moment in reversed(TICKS):
        assert isinstance(moment.what, Sensed)
        state = trace.at(moment.what.time + 1e-3)
        assert np.array_equal(state.joints, moment.what.q)
        assert state.poses["finger"] == tuple(moment.poses[1].tolist())


def test_the_stage_and_the_step_under_way_are_told(trace: Trace) -> None:
    state = trace.at(0.6)
    assert state.stage == "close"
    assert state.step is not None
    assert (state.step.line, state.step.text) == (4, "OPEN 1")


def test_a_picture_is_there_from_when_it_was_taken(trace: Trace) -> None:
    taken = next(moment.what.time for moment in HISTORY if moment.picture is not None)
    assert trace.at(taken - 0.01).picture is None
    picture = trace.at(taken).picture
    assert picture is not None
    assert picture.name == "WIDE"


def test_what_was_not_to_be_seen_yet_has_no_pose(trace: Trace) -> None:
    assert "carrier" not in trace.at(0.1).poses
    assert "carrier" in trace.at(1.1).poses


def test_before_the_first_servo_period_and_after_the_last_it_stands_still(trace: Trace) -> None:
    assert trace.at(0.0).time == pytest.approx(TICKS[0].what.time, abs=1e-6)
    assert trace.at(trace.events[-1].time + 0.005).time == pytest.approx(TICKS[-1].what.time, abs=1e-6)
    assert trace.at(-0.005).stage is None


@pytest.mark.parametrize("time", [-0.1, 2.0, float("nan")])
def test_a_time_outside_the_run_is_refused(trace: Trace, time: float) -> None:
    with pytest.raises(
        InvalidInput,
        match=rf"short\.mcap covers 0\.00 to 1\.20 s; {time:g} s is outside$",
    ):
        trace.at(time)


def test_a_trace_without_motion_is_refused(tmp_path: Path) -> None:
    Recording(tmp_path / "short.mcap").begin().play(last=2).close()
    with pytest.raises(InvalidInput, match=r"short\.mcap contains no motion to show$"):
        read_trace(tmp_path / "short.mcap").at(0.0)
