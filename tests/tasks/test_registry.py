"""Tasks are found by name, and plans are made for the arm of one."""

import re
import subprocess
import sys

import msgspec
import pytest
from short_runs import begin

from handeye import tasks
from handeye.arm.robots.stanford import STANFORD
from handeye.errors import InvalidInput
from handeye.runs.runner import Runner
from handeye.tasks import DEFAULT, register, task
from handeye.tasks.water_pump.task import WaterPump


def test_the_water_pump_is_the_task_that_is_meant_where_none_is_named() -> None:
    assert task().name == DEFAULT == "water_pump"
    assert task() is task("water_pump")


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("water_pmup", "no task is called `water_pmup`; did you mean `water_pump`?"),
        ("clock", "no task is called `clock`; known: `water_pump`"),
    ],
)
def test_an_unknown_task_is_refused_with_the_nearest_name(
    name: str, sentence: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tasks, "_REGISTERED", {})  # those of other tests
    with pytest.raises(
        InvalidInput,
        match=f"^{re.escape(sentence)} \\(a task of your own is known to the Python program that calls",
    ):
        task(name)


def test_a_run_of_a_task_that_is_not_there_is_refused() -> None:
    start = begin("OPEN 1")
    setup = msgspec.structs.replace(start.setup, task="water_pmup")
    with pytest.raises(InvalidInput, match="did you mean `water_pump`"):
        Runner(msgspec.structs.replace(start, setup=setup))


def test_no_other_task_takes_the_name_of_one() -> None:
    with pytest.raises(InvalidInput, match=r"^there is a task called `water_pump` already$"):
        register(WaterPump())


def test_a_plan_for_another_arm_is_refused_by_the_task() -> None:
    plan = msgspec.structs.replace(begin("OPEN 1").setup.plan, arm_digest="0" * 12)
    assert task().arm is STANFORD
    with pytest.raises(InvalidInput, match=r"another arm \(Stanford, 0+\); plan it again$"):
        task().check_arm(plan)


def test_a_task_can_be_asked_of_its_arm_without_a_simulator() -> None:
    code = "import sys; from handeye.tasks import task; task().arm; sys.exit('mujoco' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
