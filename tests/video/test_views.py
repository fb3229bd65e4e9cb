"""From where a video is taken: round the cell, near to the hand, or by a camera that stands still."""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from recordings import record, started

from handeye.cell.photograph import Near
from handeye.core.errors import InvalidInput
from handeye.program.events import AnyEvent, StageFinished, StageStarted, StepFinished
from handeye.trace.reading import read_trace
from handeye.trace.trace import Trace
from handeye.video.storyboard import views

PLACES = {
    "left": ((0.9, 0.9, 0.3), (0.2, 0.5, 0.0), (0.2, 0.6, 0.1)),
    "still": ((0.4, 0.4, 0.3), (0.4, 0.4, 0.3)),
    "right": ((0.1, 0.1, 0.2), (0.8, 0.7, 0.0), (0.9, 0.8, 0.03)),
}
"""Where the hand is in each stage."""
NAMES = ("tv", "studio")
RATE = 12


def happened() -> list[AnyEvent]:
    events: list[AnyEvent] = [started()]
    for number, (name, hands) in enumerate(PLACES.items()):
        begin = 10.0 * number
        events.append(StageStarted(time=begin, stage=name))
        events += [
            StepFinished(time=begin + 1 + k, step=0, hand=hand, planned=None, gap=None)
            for k, hand in enumerate(hands)
        ]
        events.append(StageFinished(time=begin + 9, stage=name, status="done"))
    return events


@pytest.fixture
def trace(tmp_path: Path) -> Trace:
    """A run of three stages, in a scene of two cameras."""
    record(tmp_path / "short.mcap")
    trace = replace(read_trace(tmp_path / "short.mcap"), events=tuple(happened()))
    cameras = [SimpleNamespace(name=name) for name in NAMES]
    stat = SimpleNamespace(center=np.array([0.7, 0.9, 0.1]), extent=1.6)
    trace.__dict__["scene"] = SimpleNamespace(ncam=len(NAMES), camera=cameras.__getitem__, stat=stat)
    return trace


def near(trace: Trace, camera: str, stages: list[int]) -> list[Near]:
    """The views, of which all are from nearby."""
    found = views(trace, camera, stages, RATE)
    assert all(isinstance(view, Near) for view in found)
    return [view for view in found if isinstance(view, Near)]


def test_the_orbit_stays_round_the_middle_and_ends_where_it_began(trace: Trace) -> None:
    seen = near(trace, "orbit", [0] * 25)
    assert {(view.place, view.camera) for view in seen} == {((0.7, 0.9, 0.1), "studio")}
    turns = [view.turned for view in seen]
    assert (turns[0], turns[-1]) == pytest.approx((0, 0))
    assert turns[12] == max(turns) > 20
    assert np.abs(np.diff(turns)).max() < 5


def test_each_stage_is_looked_at_where_its_hand_works_most_and_as_near_as_that_allows(trace: Trace) -> None:
    seen = near(trace, "follow", [0] * 40 + [2] * 40)
    assert seen[0].place[:2] == pytest.approx((0.2, 0.55))
    assert seen[-1].place[:2] == pytest.approx((0.85, 0.75))
    assert seen[0].distance < seen[-1].distance


def test_where_the_hand_stays_the_next_stage_is_looked_at(trace: Trace) -> None:
    assert near(trace, "follow", [1] * 30)[15] == near(trace, "follow", [2] * 30)[15]


def test_the_eye_glides_from_stage_to_stage(trace: Trace) -> None:
    seen = near(trace, "follow", [0] * 30 + [2] * 30)
    ways = np.linalg.norm(np.diff([view.place for view in seen], axis=0), axis=1)
    whole = np.linalg.norm(np.subtract(seen[-1].place, seen[0].place))
    assert ways.sum() == pytest.approx(whole)
    assert ways.max() < 0.25 * whole
    assert ways[:20].max() < 1e-9


def test_before_the_first_stage_the_first_is_looked_at(trace: Trace) -> None:
    assert near(trace, "follow", [-1] * 5) == near(trace, "follow", [0] * 5)


def test_a_run_without_stages_is_seen_whole(trace: Trace) -> None:
    bare = replace(trace, events=(started(),))
    bare.__dict__["scene"] = trace.scene
    assert near(bare, "follow", [-1] * 5)[2].place == pytest.approx((0.7, 0.9, 0.1))


def test_a_camera_of_the_scene_stands_still(trace: Trace) -> None:
    assert views(trace, "tv", [0, 1, 2], RATE) == ["tv"] * 3


def test_there_is_no_other_camera(trace: Trace) -> None:
    with pytest.raises(
        InvalidInput, match=r"^there is no camera belt; the cameras are orbit, follow, tv, studio$"
    ):
        views(trace, "belt", [0], RATE)
