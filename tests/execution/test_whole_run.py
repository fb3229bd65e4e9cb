"""One whole run in one drawn world: eleven stages, their senses, their times, and the referee's word.

The run is that of the first notebook; `teaching/test_seventh_screw.py` has the only
other one that assembles a pump.
"""

import math
import re
from collections.abc import Sequence
from pathlib import Path

import pytest
from running_notebooks import SCRIPTS, runs_to_its_end
from whole_runs import STAGES, Whole, whole_in

from handeye.core.errors import NO_FORCE
from handeye.program.events import (
    AnyEvent,
    ErrorRaised,
    FrictionMeasured,
    GuardTripped,
    OperatorCalled,
    PartInspected,
    PartSeen,
    StepFinished,
    StepStarted,
)
from handeye.tasks.water_pump.referee.findings import judge

pytestmark = [pytest.mark.slow, pytest.mark.render]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What the first notebook leaves."""
    here = tmp_path_factory.mktemp("notebook")
    runs_to_its_end(SCRIPTS[0], here)
    return here / "pump"


@pytest.fixture(scope="module")
def whole(folder: Path) -> Whole:
    return whole_in(folder)


def count(events: Sequence[AnyEvent], kind: type[AnyEvent]) -> int:
    return sum(isinstance(event, kind) for event in events)


@pytest.mark.row(55, drawn=1)
def test_row_55_the_eleven_stages_are_done_in_order(whole: Whole) -> None:
    assert whole.started() == whole.done() == STAGES


def test_row_55_nobody_calls_the_operator(whole: Whole) -> None:
    assert count(whole.events, OperatorCalled) == 0
    assert (whole.result.completed, whole.result.error) == (True, None)


@pytest.mark.row(60, drawn=1)
@pytest.mark.parametrize(
    ("stage", "screws"), [("drive the first two screws", 2), ("drive the last four screws", 4)]
)
def test_row_55_every_screw_ends_by_torque(whole: Whole, stage: str, screws: int) -> None:
    assert whole.torques(stage) == screws


@pytest.mark.parametrize("stage", ["insert the aligning pins", "take out the aligning pins"])
def test_row_55_two_pins_go_in_and_two_come_out(whole: Whole, stage: str) -> None:
    texts = [e.text for e in whole.during(stage) if isinstance(e, StepStarted)]
    places = {m[1] for text in texts if (m := re.match(r"MOVE\s+([PTQ]\d)(?:UP)?\b", text))}
    assert places == (
        {"P1", "P2", "T1", "T2", "Q2"} if stage.startswith("insert") else {"P1", "P2", "Q1", "Q2"}
    )


def test_row_55_the_rotor_is_turned_without_resistance(whole: Whole) -> None:
    turning = whole.during("turn the rotor")
    assert count(turning, GuardTripped) == 0
    assert [event.number for event in turning if isinstance(event, ErrorRaised)] == [
        NO_FORCE
    ] * 2  # to and fro
    assert abs(math.degrees(whole.runner.cell.truth.data.joint("rotor").qpos[0])) < 10
    assert whole.result.referee["rotor"].ok


def test_what_the_arm_has_measured_of_itself_outlasts_the_calibration_of_the_camera(whole: Whole) -> None:
    assert count(whole.events, FrictionMeasured) == 1


def test_the_base_is_found_by_sight_and_refined_by_touch(whole: Whole) -> None:
    assert count(whole.during("find the base"), PartSeen) == 2
    texts = [e.text.split()[0] for e in whole.during("feel for the grasp") if isinstance(e, StepStarted)]
    assert (texts.count("CENTER"), texts.count("SAVE"), texts.count("RESTORE")) == (2, 2, 0)


def test_the_gasket_is_accepted_by_sight(whole: Whole) -> None:
    (seen,) = [e for e in whole.during("check the gasket") if isinstance(e, PartInspected)]
    assert seen.ok, seen.cause


@pytest.mark.row(22, drawn=1)
def test_row_22_after_the_first_hole_the_others_need_one_more_try_at_most(whole: Whole) -> None:
    assert whole.searched() <= {"T1"}


@pytest.mark.row(58, drawn=1)
def test_row_58_the_times_of_the_stages_and_of_the_lens_add_up(whole: Whole) -> None:
    result, timing = whole.result, whole.result.timing
    assert sum(stage.arm_s for stage in result.stages) == pytest.approx(timing.manipulation_s, abs=0.1)
    assert whole.lens() == pytest.approx(timing.lens_s, abs=0.01)
    assert timing.working_s == pytest.approx(timing.manipulation_s + timing.lens_s, abs=0.01)


@pytest.mark.row(58)
def test_row_58_vision_is_a_tiny_share_and_the_lens_a_large_one(whole: Whole) -> None:
    """Of the eleven stages of the paper: its table has no inspection."""
    timing, eleven = whole.result.timing, sum(stage.arm_s for stage in whole.result.stages[:11])
    assert timing.vision_cpu_s < 0.02 * timing.working_s
    assert 0.15 < timing.lens_s / (eleven + timing.lens_s) < 0.4


def test_the_referee_agrees_with_the_program(whole: Whole) -> None:
    wrong = {name: check for name, check in whole.result.referee.items() if not check.ok}
    assert wrong == {}
    assert whole.result.exit_code == 0


def test_the_referee_says_the_same_again(whole: Whole) -> None:
    findings = judge(whole.runner.cell.truth)
    assert {name: f.value for name, f in findings.items()} == {
        name: check.value for name, check in whole.result.referee.items()
    }


def test_time_never_goes_back(whole: Whole) -> None:
    times = [event.time for event in whole.events]
    assert times == sorted(times)


def test_every_step_that_began_has_ended(whole: Whole) -> None:
    events = list(whole.events)
    assert count(events, StepStarted) == count(events, StepFinished) > 200
