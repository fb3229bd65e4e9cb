"""The television shows the picture that was taken or examined last, with what was found in it, and changes nothing."""

import json
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from fake_runs import FakeRun, fake_run
from looked_runs import PART, SCRIPT, looked
from toy_system import begin_toy

from handeye.execution.state import VisionResult
from handeye.program.events import ErrorRaised, PartSeen
from handeye.report.facts.seen import SeenPicture
from handeye.runs.runner import Runner
from handeye.runs.system import RunningSystem
from handeye.view.moment import Newest, Television, shown


def seen(run: FakeRun) -> SeenPicture | None:
    """The picture that is shown of a run."""
    state = run.executor.state
    system = SimpleNamespace(
        shots=state.shots, marks=lambda name: state.found.get(name, VisionResult()).marks()
    )
    return shown(run.events, run.executor.run.plan.program, cast("RunningSystem", system)).picture


@pytest.fixture(scope="module")
def run() -> FakeRun:
    return looked()


def test_before_the_first_picture_nothing_is_shown() -> None:
    assert seen(fake_run("LENS 25", parts={"PUMP": PART}).go()) is None
    assert json.loads(Television().message) == {"television": ""}


def test_the_last_picture_is_shown_with_what_was_found(run: FakeRun) -> None:
    picture, state = seen(run), run.executor.state
    assert picture is not None
    assert (picture.name, picture.lens) == ("NEAR", 0.050)
    assert picture.marks == tuple(state.found["NEAR"].marks())
    assert [type(finding) for finding in picture.findings] == [PartSeen]
    np.testing.assert_array_equal(picture.picture, state.shots["NEAR"].picture)


def test_a_picture_that_was_not_examined_yet_has_no_marks() -> None:
    picture = seen(fake_run("LENS 25\nAIM PUMP\nLOOK WIDE", parts={"PUMP": PART}).go())
    assert picture is not None
    assert (picture.name, picture.marks, picture.findings) == ("WIDE", (), ())


def test_a_picture_that_is_taken_anew_has_no_marks_of_the_one_before() -> None:
    picture = seen(looked(end="LOOK NEAR"))
    assert picture is not None
    assert (picture.name, picture.marks) == ("NEAR", ())


def test_the_picture_that_is_examined_is_shown_though_another_was_taken_later() -> None:
    script = SCRIPT.replace("GENERAL PUMP WIDE\n", "").replace("SPECIFIC PUMP NEAR", "GENERAL PUMP WIDE")
    run = fake_run(script, parts={"PUMP": PART}).go()
    picture = seen(run)
    assert picture is not None
    assert (picture.name, picture.marks) == ("WIDE", ())
    assert [type(finding) for finding in picture.findings] == [ErrorRaised]


def test_what_is_shown_is_a_copy(run: FakeRun) -> None:
    picture = seen(run)
    assert picture is not None
    assert not np.shares_memory(picture.picture, run.executor.state.shots["NEAR"].picture)


def test_pages_are_told_picture_marks_and_findings(run: FakeRun) -> None:
    told = json.loads(Television(seen(run)).message)["television"]
    assert told.count("data:image/png") == 1
    assert "<polygon" in told
    assert "<b>NEAR</b> through the 50 mm lens" in told
    assert "PUMP lies at" in told


def test_a_system_that_carries_out_no_program_has_an_empty_television() -> None:
    assert Newest(Runner(begin_toy())).television.picture is None
