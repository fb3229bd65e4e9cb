"""Rerun opens a trace and finds in it what we say is there.

It is large, so the ordinary suite does without it: `pip install --group xcheck`, then `pytest tests/xcheck`.
"""

import shutil
import subprocess
import sysconfig
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pytest
from recordings import EVENTS, HISTORY, record
from rerun.chunk import RrdReader

from handeye.ports.workcell import Sensed
from handeye.trace.channels import CHANNELS
from handeye.trace.reading import read_trace

TIME = "message_log_time"
PERIODS = [moment for moment in HISTORY if isinstance(moment.what, Sensed)]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a trace, and what Rerun's converter makes of it."""
    folder = tmp_path_factory.mktemp("rerun")
    record(folder / "short.mcap")
    _rerun(folder, "mcap", "convert", "short.mcap", "-o", "short.rrd")
    return folder


def _rerun(folder: Path, *arguments: str) -> str:
    """What Rerun's command says. Its home is a new one, in which it sends nothing anywhere."""
    command = shutil.which("rerun", path=sysconfig.get_path("scripts"))
    assert command is not None
    done = subprocess.run(
        [command, *arguments],
        cwd=folder,
        env={"HOME": str(folder)},
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout


def _rows(folder: Path, entity: str) -> Iterator[dict[str, Any]]:
    """What Rerun has on an entity, row by row; times in ns."""
    for chunk in RrdReader(str(folder / "short.rrd")).stream():
        batch = chunk.to_record_batch()
        if chunk.entity_path == entity and TIME in batch.schema.names:
            times = batch.column(TIME).cast(pa.int64())
            place = batch.schema.get_field_index(TIME)
            yield from batch.set_column(place, TIME, times).to_pylist()


def test_rerun_finds_no_fault_in_the_file(folder: Path) -> None:
    said = _rerun(folder, "mcap", "check", "short.mcap", "--full")
    assert [line.split()[0] for line in said.splitlines() if "/" in line and line[0] != "s"] == ["ok"] * len(
        CHANNELS
    )


def test_the_transforms_are_at_the_right_times_and_places(folder: Path) -> None:
    rows = [row for row in _rows(folder, "/tf") if row.get("Transform3D:child_frame") == ["finger"]]
    found = {row[TIME]: row["Transform3D:translation"][0] for row in rows}
    for moment in PERIODS:
        assert np.allclose(found[round(moment.what.time * 1e6) * 1000], moment.poses[1, :3], atol=1e-6)
    assert {row["Transform3D:parent_frame"][0] for row in rows} == {"world"}


def test_the_joint_states_are_at_the_right_times(folder: Path) -> None:
    times = {row[TIME] for row in _rows(folder, "/joint_states")}
    assert times == {round(moment.what.time * 1e6) * 1000 for moment in PERIODS}


def test_the_picture_is_an_image_at_the_right_time(folder: Path) -> None:
    (row,) = [row for row in _rows(folder, "/camera/picture") if row.get("Image:buffer")]
    (taken,) = read_trace(folder / "short.mcap").pictures
    assert row[TIME] == round(taken.time * 1e9)
    assert np.array_equal(row["Image:buffer"][0], 17 * taken.picture.ravel())


def test_the_log_tells_of_the_stages_at_the_right_times(folder: Path) -> None:
    rows = [row for row in _rows(folder, "/log") if row.get("TextLog:text")]
    stages = [(row[TIME], row["TextLog:text"][0]) for row in rows if "stage" in row["TextLog:text"][0]]
    begun = [event for event in EVENTS if type(event).__name__ in {"StageStarted", "StageFinished"}]
    assert [time for time, _ in stages] == [round(event.time * 1e6) * 1000 for event in begun]
    assert stages[0][1] == "stage “open”"
