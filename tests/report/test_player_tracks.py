"""The tracks that a page is given say where everything was, within what nobody can see."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from player_bytes import SeenTracks
from recordings import record

from handeye.report.player import shown_poses
from handeye.report.player.tracks import tracks_bytes
from handeye.trace.messages import Poses
from handeye.trace.reading import read_trace
from handeye.trace.trace import Trace

FLOOR = -1.5
PLACE, TURN = 3e-4, np.radians(0.3)
"""As far as a page may be off: m, rad."""


def made(poses: Mapping[str, Poses]) -> bytes:
    """The bytes of bodies that were recorded sixty times a second."""
    periods = max(map(len, poses.values()), default=1)
    times = np.arange(1, periods + 1) / 60
    return tracks_bytes(poses, times=times, begin=0.0, end=float(times[-1]), lowest=FLOOR)


def wandering(periods: int, seed: int) -> NDArray[np.float32]:
    """Poses of a body that goes and turns smoothly about the cell, a little unsteadily."""
    rng = np.random.default_rng(seed)
    time = np.linspace(0, 6, periods)[:, None]
    place = np.sin(time * rng.uniform(0.5, 2, 3)) + rng.normal(0, 3e-5, (periods, 3))
    turn = np.sin(time * rng.uniform(0.2, 1, 4) + rng.uniform(0, 6, 4))
    turn *= rng.choice([-1, 1], (periods, 1)) / np.linalg.norm(turn, axis=1, keepdims=True)
    return np.concatenate([place, turn], axis=1, dtype=np.float32, casting="same_kind")


def off(seen: NDArray[np.float64] | None, true: NDArray[np.float32]) -> tuple[float, float]:
    """How far a pose is from the true one: m, rad."""
    assert seen is not None
    chord = min(np.linalg.norm(seen[3:] - true[3:]), np.linalg.norm(seen[3:] + true[3:]))
    return float(np.linalg.norm(seen[:3] - true[:3])), 4 * float(np.arcsin(chord / 2))


@pytest.fixture
def trace(tmp_path: Path) -> Trace:
    """A short run, in the middle of which a screw becomes part of a thread."""
    record(tmp_path / "short.mcap")
    return read_trace(tmp_path / "short.mcap")


@pytest.mark.parametrize("seed", range(3))
def test_every_pose_of_every_period_comes_back(seed: int) -> None:
    poses = {"base": wandering(700, seed), "hand": wandering(700, seed + 100)}
    seen = SeenTracks.of(made(poses))
    worst = np.max([off(seen.pose(name, k), rows[k]) for name, rows in poses.items() for k in range(700)], 0)
    assert worst[0] < PLACE
    assert worst[1] < TURN


def test_a_body_that_turns_where_it_is_is_seen_to_turn() -> None:
    half = np.pi / 2 * np.sin(np.linspace(0, 3, 400)) ** 2
    rows = np.zeros((400, 7), dtype=np.float32)
    rows[:, 3], rows[:, 6] = np.cos(half), np.sin(half)
    seen = SeenTracks.of(made({"rotor": rows}))
    assert max(off(seen.pose("rotor", k), rows[k])[1] for k in range(400)) < TURN


def test_most_poses_are_left_out() -> None:
    seen = SeenTracks.of(made({"hand": wandering(6000, 1)}))
    ((_, _, kept),) = seen.unpacked.header["moving"][0]["spans"]
    assert kept < 600


def test_a_body_that_never_moves_is_one_pose() -> None:
    pose = np.float32([0.1, 0.2, 0.3, 1, 0, 0, 0])
    header = SeenTracks.of(made({"block": np.tile(pose, (50, 1))})).unpacked.header
    assert header["still"]["block"] == pytest.approx(pose.tolist())
    assert header["moving"] == []


def test_a_screw_is_hidden_from_when_its_thread_has_it_and_shown_there(trace: Trace) -> None:
    poses = trace.poses
    seen = SeenTracks.of(made(poses))
    loose = [seen.pose("screw", k) is not None for k in range(len(trace.times))]
    driven = [seen.pose("carrier", k) is not None for k in range(len(trace.times))]
    assert loose == [not there for there in driven]
    assert driven == (~np.isnan(poses["carrier"][:, 0])).tolist()
    assert any(driven)
    assert any(loose)


def test_a_body_that_comes_back_is_where_it_came_back() -> None:
    rows = wandering(90, 4)
    rows[30:60, 2] = -2.0
    seen = SeenTracks.of(made({"screw": rows}))
    assert [seen.pose("screw", k) is None for k in (29, 30, 59, 60)] == [False, True, True, False]
    assert off(seen.pose("screw", 60), rows[60])[0] < PLACE


def test_a_body_that_is_never_there_has_no_track() -> None:
    seen = SeenTracks.of(made({"carrier": np.full((20, 7), np.nan, dtype=np.float32)}))
    assert seen.pose("carrier", 10) is None


@pytest.mark.slow
def test_what_no_run_moves_is_shown_as_drawn_but_the_hands_of_the_clock(trace: Trace) -> None:
    shown = shown_poses(trace)
    assert {"teletype", "second_hand"} <= shown.keys() - trace.poses.keys()
    assert np.ptp(shown["teletype"], axis=0).max() == 0
    turned = 2 * np.arccos(np.abs(np.sum(shown["second_hand"][0, 3:] * shown["second_hand"][60, 3:])))
    assert turned == pytest.approx(2 * np.pi * (trace.times[60] - trace.times[0]) / 60, rel=1e-3)


def test_the_clock_is_that_of_the_trace_where_the_run_waited_too() -> None:
    times = np.cumsum([1 / 60, 1 / 60, 0.25, 1 / 60])
    data = tracks_bytes({}, times=times, begin=0.0, end=0.4, lowest=FLOOR)
    assert SeenTracks.of(data).clock == pytest.approx(times, abs=1e-6)


def test_a_run_of_half_an_hour_has_all_its_periods() -> None:
    rows = np.tile(np.float32([0, 0, 0, 1, 0, 0, 0]), (108_000, 1))
    rows[90_000:, 0] = 1.0
    seen = SeenTracks.of(made({"base": rows}))
    assert [seen.pose("base", k)[0] for k in (89_999, 90_000, 107_999)] == pytest.approx([0, 1, 1])


def test_equal_runs_give_equal_bytes() -> None:
    assert made({"hand": wandering(300, 5)}) == made({"hand": wandering(300, 5)})
