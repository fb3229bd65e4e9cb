"""A replay shows the run as it was, at any time, in any order."""

from pathlib import Path

import numpy as np
import pytest
from recordings import HISTORY, Recording, record

from handeye.errors import InvalidInput
from handeye.ports.workcell import Sensed
from handeye.trace.reading import read_trace
from handeye.trace.replay import Replay

TICKS = [moment for moment in HISTORY if isinstance(moment.what, Sensed)]


@pytest.fixture
def replay(tmp_path: Path) -> Replay:
    record(tmp_path / "short.mcap")
    return Replay(read_trace(tmp_path / "short.mcap"))


def test_joints_and_frames_are_where_they_were_in_every_servo_period(replay: Replay) -> None:
    for moment in reversed(TICKS):
        assert isinstance(moment.what, Sensed)
        state = replay.seek(moment.what.time + 1e-3)
        assert np.array_equal(state.joints, moment.what.q)
        assert state.poses["finger"] == tuple(moment.poses[1].tolist())


def test_the_stage_and_the_step_under_way_are_told(replay: Replay) -> None:
    state = replay.seek(10.6)
    assert state.stage == "close"
    assert state.step is not None
    assert (state.step.line, state.step.text) == (4, "OPEN 1")


def test_a_picture_is_there_from_when_it_was_taken(replay: Replay) -> None:
    taken = next(moment.what.time for moment in HISTORY if moment.picture is not None)
    assert replay.seek(taken - 0.01).picture is None
    picture = replay.seek(taken).picture
    assert picture is not None
    assert picture.name == "WIDE"


def test_what_was_not_to_be_seen_yet_has_no_pose(replay: Replay) -> None:
    assert "carrier" not in replay.seek(10.1).poses
    assert "carrier" in replay.seek(11.1).poses


def test_before_the_beginning_and_after_the_end_it_stands_still(replay: Replay) -> None:
    assert replay.seek(0.0).time == pytest.approx(TICKS[0].what.time, abs=1e-6)
    assert replay.seek(99.0).time == pytest.approx(TICKS[-1].what.time, abs=1e-6)
    assert replay.seek(0.0).stage is None


def test_a_trace_without_motion_is_refused(tmp_path: Path) -> None:
    Recording(tmp_path / "short.mcap").begin().play(last=2).close()
    with pytest.raises(InvalidInput, match=r"short\.mcap holds no motion to be shown$"):
        Replay(read_trace(tmp_path / "short.mcap"))
