"""A run as ten frames a second: what was sensed before a moment, and what the arm did after it."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from handeye.core.errors import Refused
from handeye.datasets.frames import Frames, frames_of
from handeye.program.events import StageFinished, StageStarted, StepFinished, StepStarted
from handeye.trace.forces import Forces
from handeye.trace.replay import Motion

PERIODS = 30  # half a second
FELT = slice(6, 10)  # periods in which force was estimated


def step(time: float, text: str) -> StepStarted:
    """An instruction begins."""
    return StepStarted(time=time, step=0, file="", line=1, text=text)


def trace(*, kept: slice = slice(None), thinned: bool = False, pictures: tuple[float, ...] = ()) -> Any:
    """A recorded run of an arm with two joints, with readings that count the servo periods."""
    times = np.arange(1, PERIODS + 1)[kept] / 60
    count, felt = np.arange(PERIODS)[kept].astype(float), np.zeros(PERIODS, dtype=np.bool_)
    felt[FELT] = True
    joints = np.stack([count, -count], axis=1)
    wrench = np.where(felt[kept][:, None], count[:, None] + [0.0, 100.0, 200.0], np.nan)
    nothing = np.full(len(times), np.nan)
    forces = Forces(
        times=times, force=wrench, moment=-wrench, estimated=felt[kept], guard=np.array([""] * len(times)),
        axis=wrench, value=nothing, limit=nothing,
    )  # fmt: skip
    events = [
        StageStarted(time=0.0, stage="feel"),
        step(0.0, "OPEN    1"),
        StepFinished(time=0.2, step=0, hand=(0, 0, 0), planned=None, gap=0.0),
        step(0.2, "CHANGE  [0 0 -1] 1"),
        StepFinished(time=0.35, step=1, hand=(0, 0, 0), planned=None, gap=0.0),
        StageFinished(time=0.35, stage="feel", status="done"),
    ]
    return SimpleNamespace(
        name="trace.mcap", thinned=thinned, events=events, forces=lambda: forces,
        pictures=[SimpleNamespace(time=time) for time in pictures],
        motion=Motion(
            names=("a", "b"), times=times, joints=joints, rates=joints * 10, efforts=joints * 100, gaps=count / 1000
        ),
    )  # fmt: skip


@pytest.fixture(scope="module")
def frames() -> Frames:
    return frames_of(trace(pictures=(0.15, 0.3)))


def test_there_are_ten_frames_a_second(frames: Frames) -> None:
    assert frames.times == pytest.approx([0.1, 0.2, 0.3, 0.4, 0.5])


def test_a_frame_has_the_last_reading_before_its_moment_and_the_mean_of_six(frames: Frames) -> None:
    assert frames.state[1] == pytest.approx([11, -11, 0.011])
    assert frames.state_mean[1] == pytest.approx([8.5, -8.5, 0.0085])
    assert frames.rate[1] == pytest.approx([110, -110])
    assert frames.torque[1] == pytest.approx([850, -850])


def test_the_action_is_where_the_arm_is_at_the_next_moment(frames: Frames) -> None:
    assert frames.action[:-1] == pytest.approx(frames.state[1:])
    assert frames.action[-1] == pytest.approx(frames.state[-1])


def test_force_counts_only_where_it_was_estimated(frames: Frames) -> None:
    assert frames.force_share == pytest.approx([0, 4 / 6, 0, 0, 0])
    assert frames.force[1] == pytest.approx([9, 109, 209, -9, -109, -209])
    assert frames.force_mean[1] == pytest.approx([7.5, 107.5, 207.5, -7.5, -107.5, -207.5])
    assert not frames.force[[0, 2, 3, 4]].any()


def test_a_frame_shows_the_last_picture_and_its_age(frames: Frames) -> None:
    assert frames.picture.tolist() == [-1, 0, 1, 1, 1]
    assert frames.picture_age == pytest.approx([-1, 0.05, 0, 0.1, 0.2])


def test_a_frame_names_the_stage_and_the_instruction_that_make_its_action(frames: Frames) -> None:
    assert frames.stage == ("feel", "feel", "feel", "", "")
    assert frames.instruction == ("OPEN 1", "CHANGE [0 0 -1] 1", "CHANGE [0 0 -1] 1", "", "")


def test_while_the_brakes_hold_the_arm_a_frame_keeps_the_last_reading() -> None:
    found = frames_of(trace(kept=np.r_[0:6, 29:30]))  # type: ignore[arg-type]
    assert len(found) == 5
    assert found.state[:, 0].tolist() == [5, 5, 5, 5, 29]
    assert found.state_mean[1:4, 0].tolist() == [5, 5, 5]


def test_a_thinned_recording_makes_no_frames() -> None:
    with pytest.raises(Refused, match=r"^trace\.mcap is thinned, so most sensor readings are missing"):
        frames_of(trace(thinned=True))


def test_a_recording_without_motion_makes_no_frames() -> None:
    still = trace()
    still.motion = replace(still.motion, times=np.empty(0))
    with pytest.raises(Refused, match=r"^trace\.mcap holds no motion of the arm$"):
        frames_of(still)
