"""Tasks are found by name, and plans are made for the arm of one."""

import re
import subprocess
import sys
from dataclasses import replace

import msgspec
import pytest
from short_runs import begin

from handeye import tasks
from handeye.arm import robots
from handeye.arm.robots.stanford import STANFORD
from handeye.core.errors import InvalidInput
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
        ("clock", "no task is called `clock`; known: `bucket`, `insertion`, `palletise`, `water_pump`"),
    ],
)
def test_an_unknown_task_is_refused_with_the_nearest_name(
    name: str, sentence: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tasks, "_REGISTERED", {})  # those of other tests
    with pytest.raises(
        InvalidInput,
        match=f"^{re.escape(sentence)} \\(one of your own is given as `--task MODULE:NAME`, comes by",
    ):
        task(name)


@pytest.mark.parametrize("wrong", [None, 3, ["water_pump"]])
def test_what_is_no_name_of_a_task_is_refused(wrong: object) -> None:
    with pytest.raises(InvalidInput, match=r"^a task is given by its name, not "):
        task(wrong)


def test_a_run_of_a_task_that_is_not_there_is_refused() -> None:
    start = begin("OPEN 1")
    plan = msgspec.structs.replace(start.setup.plan, task="water_pmup")
    setup = msgspec.structs.replace(start.setup, plan=plan)
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


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ({"name": ""}, r"^a task needs a name, which is a text; '' is none$"),
        ({"name": None}, r"^a task needs a name, which is a text; None is none$"),
        (
            {"name": "odd", "park": [0.0] * 5},
            r"^the task `odd` parks .* \(5,\); the Stanford arm has 6 joints$",
        ),
    ],
)
def test_a_task_that_cannot_be_one_is_refused(words: dict[str, object], sentence: str) -> None:
    with pytest.raises(InvalidInput, match=sentence):
        register(type("Odd", (WaterPump,), words)())


@pytest.mark.parametrize("wrong", [None, "water_pump", WaterPump])
def test_what_is_no_task_is_refused(wrong: object) -> None:
    with pytest.raises(
        InvalidInput, match=r"^a task is an object of a class that is derived from handeye\.Task, not "
    ):
        register(wrong)


def test_an_equal_arm_may_be_made_known_again() -> None:
    robots.register(replace(STANFORD))
    with pytest.raises(InvalidInput, match=r"^there is an arm called `Stanford` already$"):
        robots.register(replace(STANFORD, servo=replace(STANFORD.servo, period=STANFORD.servo.period / 2)))


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [(3, r"^an arm is an ArmModel, not 3$"), (replace(STANFORD, name=""), r"^an arm needs a name$")],
)
def test_an_arm_that_cannot_be_one_is_refused(wrong: object, sentence: str) -> None:
    with pytest.raises(InvalidInput, match=sentence):
        robots.register(wrong)
