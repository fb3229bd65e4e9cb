"""Both arms with physics: the rectilinear arm, and a Purbrick arm as the left one."""

from pathlib import Path

import pytest
from run_bench import begin, lines, printed, ran

from handeye.core.errors import BadFile
from handeye.program.events import OperatorCalled
from handeye.runs.advance import advance
from handeye.runs.checkpoint_file import read_checkpoint, write_checkpoint
from handeye.runs.runner import Runner
from handeye.systems.ml.machine.rectilinear import LEFT
from handeye.systems.ml.realtime.happenings import Froze, LimitCrossed
from handeye.systems.ml.run.jobs import job_plan
from handeye.systems.ml.run.plan import MlPlan, sound

UNIT = 25.4e-6  # m
BOTH = (
    "10 PUT MT 2 8 79\n20 MOTOR 2 8000\n30 SENSOR 4 -300 300\n40 PUT MT 2 8 10\n50 MOTOR 2 9500\n60 MOTOR 2 0\n"
    "70 GETPOS 1 2\n80 STOP\n"
    "100 MOTOR 3 1800\n110 MOTOR 2 600\n120 GETPOS 2 3\n130 PRINT &1 &2"
)
"""The right arm goes down to the table until its guard trips. The left arm moves its platter, then its column."""


@pytest.mark.ml_row(43)
@pytest.mark.slow
def test_the_table_freezes_the_right_arm_and_the_left_arm_goes_on() -> None:
    runner = ran(BOTH, arm="rectilinear", left=100)
    (crossed,) = (event for event in runner.events if isinstance(event, LimitCrossed))
    assert (crossed.arm, crossed.sensor) == ("right", 4)
    assert [event.arm for event in runner.events if isinstance(event, Froze)] == ["right"]
    assert not any(isinstance(event, OperatorCalled) for event in runner.events)
    data = runner.cell.truth.data
    frozen, told = data.joint("z").qpos[0] / UNIT, printed(runner)[-1].split()
    assert 8600 < frozen < 8750  # the wand is at the table, and the motion to 0 is nullified
    assert abs(int(told[1]) - 1800) <= 6
    assert data.joint("purbrick_y").qpos[0] / UNIT == pytest.approx(1800, abs=8)
    assert data.joint("purbrick_z").qpos[0] / UNIT == pytest.approx(600, abs=8)
    assert crossed.time < runner.system.time - 0.5  # the left arm was in motion then


@pytest.mark.slow
def test_two_simulated_arms_kept_in_the_middle_are_resumed_to_the_same_bytes(tmp_path: Path) -> None:
    whole = ran(BOTH, arm="rectilinear", left=100)
    whole.finish()
    for steps in (3, 7):
        first = Runner(begin(BOTH, arm="rectilinear", left=100))
        advance(first, steps=steps)
        write_checkpoint(tmp_path / "kept", first.checkpoint())
        second = Runner(read_checkpoint(tmp_path / "kept"))
        advance(second)
        second.finish()
        assert lines(second) == lines(whole)


@pytest.mark.slow
def test_the_slides_of_the_left_arm_reach_the_ends_of_their_travel_with_z_down() -> None:
    text = "10 STOP\n100 PUT MT 2 8 100\n110 PUT MT 3 8 100\n120 PUT MT 4 8 100\n130 MOVE 0 5905 7874 7874"
    runner = ran(text, arm="rectilinear", left=100)
    assert not any(isinstance(event, OperatorCalled) for event in runner.events)
    data = runner.cell.truth.data
    assert data.body("purbrick_yaw").xpos[2] == pytest.approx(
        0.15, abs=0.001
    )  # the fingertips are at the platter
    for motor in LEFT.motors[:3]:
        there = data.joint(f"purbrick_{motor.axis}").qpos[0]
        assert there == pytest.approx(motor.upper * motor.unit, abs=3e-4)


def test_no_job_has_a_left_arm() -> None:
    plan = job_plan("orient")
    with pytest.raises(
        BadFile, match=r"orient\.ml has a program for the left arm, but no job has a left arm"
    ):
        sound(MlPlan(name=plan.name, text=plan.text, arm="rectilinear", job="orient", left=10))
