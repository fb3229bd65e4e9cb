"""A thinned trace holds what it takes to show the run, and says that it is thinned."""

from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from mcap.writer import Writer
from recordings import record
from zstandard import compress

from handeye.core.errors import InvalidInput
from handeye.runs.verify import difference
from handeye.trace import thinning
from handeye.trace.channels import (
    FORMAT,
    FRAMES,
    HAND,
    JOINTS,
    METADATA,
    PACKED_PLAN,
    SCENE,
    THINNED,
    VERSION,
)
from handeye.trace.reading import read_trace
from handeye.trace.records import LARGEST
from handeye.trace.thinning import STEP, write_thinned
from handeye.trace.trace import Trace

MOTION = (JOINTS, HAND, FRAMES, SCENE)


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Trace:
    path = tmp_path_factory.mktemp("whole") / "trace.mcap"
    record(path)
    return read_trace(path)


@pytest.fixture
def thin(whole: Trace, tmp_path: Path) -> Trace:
    write_thinned(whole, tmp_path / "thin.mcap")
    return read_trace(tmp_path / "thin.mcap")


def test_it_is_a_trace_and_says_that_it_is_thinned(whole: Trace, thin: Trace) -> None:
    assert (whole.thinned, thin.thinned) == (False, True)
    assert 0 < len(thin.times) < len(whole.times)


def test_all_but_the_motion_is_as_it_was(whole: Trace, thin: Trace) -> None:
    kept = [message for message in whole.messages if message.topic not in MOTION]
    assert [message for message in thin.messages if message.topic not in MOTION] == kept
    assert (thin.head, thin.plan, thin.events) == (whole.head, whole.plan, whole.events)


def test_the_periods_that_it_has_are_as_they_were(whole: Trace, thin: Trace) -> None:
    rows = np.searchsorted(whole.times, thin.times)
    assert np.array_equal(whole.joints[rows], thin.joints)
    assert np.array_equal(whole.forces().force[rows], thin.forces().force, equal_nan=True)


def test_bodies_are_where_they_were_but_for_rounding_and_there_when_they_were(
    whole: Trace, thin: Trace
) -> None:
    rows = np.searchsorted(whole.times, thin.times)
    for name, poses in whole.poses.items():
        assert np.array_equal(np.isnan(poses[rows]), np.isnan(thin.poses[name])), name
        assert np.nanmax(np.abs(poses[rows] - thin.poses[name])) <= STEP / 2 + 1e-7, name


def test_between_its_periods_no_body_is_far_off_the_straight_way(whole: Trace, thin: Trace) -> None:
    for name, poses in whole.poses.items():
        there = ~np.isnan(poses[:, 2]) & (poses[:, 2] > -1)
        shown = [np.interp(whole.times, thin.times, column) for column in thin.poses[name][:, :3].T]
        far = np.linalg.norm(np.column_stack(shown) - poses[:, :3], axis=1)[there]
        assert (far <= thinning.PLACE_M + 2 * STEP).all(), name


def test_a_body_that_becomes_another_is_there_until_it_is_not(whole: Trace, thin: Trace) -> None:
    gone = int(np.flatnonzero(whole.poses["screw"][:, 2] < -1)[0])
    assert {whole.times[gone - 1], whole.times[gone]} <= {*thin.times}


def test_where_a_guard_begins_and_ends_and_most_is_felt_is_kept(whole: Trace, thin: Trace) -> None:
    before, after = whole.forces(), thin.forces()
    for step in (event for event in whole.events if type(event).__name__ == "StepStarted"):
        span = (before.times > step.time) & (before.guard != "") & (before.times < step.time + 10 / 60)
        kept = (after.times > step.time) & (after.guard != "") & (after.times < step.time + 10 / 60)
        assert before.times[span][[0, -1]].tolist() == after.times[kept][[0, -1]].tolist()
        assert before.value[span].max() == after.value[kept].max()


def test_periods_are_not_far_apart_however_still_all_stands(
    whole: Trace, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(thinning, "LONGEST_GAP_S", 0.1)
    write_thinned(whole, tmp_path / "thin.mcap")
    assert np.diff(read_trace(tmp_path / "thin.mcap").times).max() < 2 * thinning.LONGEST_GAP_S


def test_the_same_trace_is_thinned_to_the_same_bytes(whole: Trace, tmp_path: Path) -> None:
    files = [tmp_path / "a.mcap", tmp_path / "b.mcap"]
    for file in files:
        write_thinned(whole, file)
    assert files[0].read_bytes() == files[1].read_bytes()


def test_what_is_thinned_is_neither_thinned_again_nor_verified(thin: Trace, tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match=r"is already thinned$"):
        write_thinned(thin, tmp_path / "again.mcap")
    with pytest.raises(InvalidInput, match=r"is thinned and cannot be verified; verify the original trace$"):
        difference(thin, tmp_path / "run")


def test_nothing_is_left_where_it_cannot_be_written(
    whole: Trace, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("handeye.trace.mcap_writer.GrowingFile.finish", lambda _: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        write_thinned(whole, tmp_path / "thin.mcap")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "packed", [b"", b"no zstd", compress(b" " * (LARGEST + 1))], ids=["none", "other", "bomb"]
)
def test_a_packed_plan_that_is_none_or_would_fill_the_memory_is_refused(
    tmp_path: Path, packed: bytes
) -> None:
    out = BytesIO()
    writer = Writer(out, enable_data_crcs=True)
    writer.start()
    writer.add_metadata(METADATA, {"format": FORMAT, "version": str(VERSION), THINNED: "yes"})
    writer.add_attachment(0, 0, PACKED_PLAN, "application/zstd", packed)
    writer.finish()
    (tmp_path / "forged.mcap").write_bytes(out.getvalue())
    with pytest.raises(InvalidInput, match=r"forged\.mcap is damaged$"):
        read_trace(tmp_path / "forged.mcap")
