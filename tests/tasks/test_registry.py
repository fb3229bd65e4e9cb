"""Tasks are found by name, and plans are made for the arm of one."""

import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import msgspec
import pytest
from block_task import BLOCK
from short_runs import begin

from handeye import tasks
from handeye.arm import robots
from handeye.arm.robots.stanford import STANFORD
from handeye.core.entries import OWN, loaded
from handeye.core.errors import InvalidInput
from handeye.core.variation import WorldSpec
from handeye.runs.runner import Runner
from handeye.tasks import DEFAULT, register, task
from handeye.tasks.water_pump.task import WaterPump


def test_the_water_pump_is_the_task_that_is_meant_where_none_is_named() -> None:
    assert task().name == DEFAULT == "water_pump"
    assert task() is task("water_pump")


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("water_pmup", "there is no task `water_pmup`; did you mean `water_pump`?"),
        (
            "clock",
            "there is no task `clock`; the tasks are `arrange`, `bin`, `blocks`, `bucket`, `chess`, `follow`, "
            "`gantries`, `handover`, `insert`, `insertion`, `line`, `mal`, `ml`, `orient`, `palletise`, `prco`, "
            "`rectilinear`, `support`, `train`, `typewriter`, `water_pump`",
        ),
    ],
)
def test_an_unknown_task_is_refused_with_the_nearest_name(
    name: str, sentence: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tasks, "_REGISTERED", {})  # those of other tests
    monkeypatch.setattr("handeye.core.entries._registered", {})
    monkeypatch.setattr("handeye.core.entries._found", [loaded(place) for place in OWN])
    with pytest.raises(
        InvalidInput,
        match=f"^{re.escape(sentence)} \\(for your own task, give `--task MODULE:NAME`, install",
    ):
        task(name)


@pytest.mark.parametrize("wrong", [None, 3, ["water_pump"]])
def test_what_is_no_name_of_a_task_is_refused(wrong: object) -> None:
    with pytest.raises(InvalidInput, match=r"^give a task by its name, not by "):
        task(wrong)


def test_a_run_of_a_task_that_is_not_there_is_refused() -> None:
    start = begin("OPEN 1")
    plan = msgspec.structs.replace(start.setup.plan, task="water_pmup")
    setup = msgspec.structs.replace(start.setup, plan=plan)
    with pytest.raises(InvalidInput, match="did you mean `water_pump`"):
        Runner(msgspec.structs.replace(start, setup=setup))


def test_no_other_task_takes_the_name_of_one() -> None:
    with pytest.raises(InvalidInput, match=r"^there is already a task called `water_pump`$"):
        register(WaterPump())


def test_a_plan_for_another_arm_is_refused_by_the_task() -> None:
    plan = msgspec.structs.replace(begin("OPEN 1").setup.plan, arm_digest="0" * 12)
    assert task().arm is STANFORD
    with pytest.raises(InvalidInput, match=r"another arm \(Stanford, 0+\); make the plan again$"):
        task().check_arm(plan)


def test_a_task_can_be_asked_of_its_arm_without_a_simulator() -> None:
    code = "import sys; from handeye.tasks import task; task().arm; sys.exit('mujoco' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ({"name": ""}, r"^the name of a task must be a non-empty text, not ''$"),
        ({"name": None}, r"^the name of a task must be a non-empty text, not None$"),
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
        InvalidInput, match=r"^a task must be an instance of a class derived from handeye\.Task, not "
    ):
        register(wrong)


def test_an_equal_arm_may_be_made_known_again() -> None:
    robots.register(replace(STANFORD))
    with pytest.raises(InvalidInput, match=r"^there is already an arm called `Stanford`$"):
        robots.register(replace(STANFORD, servo=replace(STANFORD.servo, period=STANFORD.servo.period / 2)))


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [(3, r"^an arm must be an ArmModel, not 3$"), (replace(STANFORD, name=""), r"^an arm needs a name$")],
)
def test_an_arm_that_cannot_be_one_is_refused(wrong: object, sentence: str) -> None:
    with pytest.raises(InvalidInput, match=sentence):
        robots.register(wrong)


def test_a_task_of_an_entry_point_is_found_by_its_name(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tasks, "_REGISTERED", {})
    monkeypatch.setattr(
        tasks, "_entry_points", lambda: {"block": "block_task:BLOCK", "gone": "no_module:TASK"}
    )
    assert task("block").arm.name == "cartesian"
    with pytest.raises(
        InvalidInput, match=r"^the task `no_module:TASK` cannot be imported: ModuleNotFoundError: "
    ):
        task("gone")


def test_a_task_whose_module_fails_is_told_in_a_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [*sys.path])
    Path("broken_task.py").write_text("1 / 0\n", encoding="utf-8")
    with pytest.raises(
        InvalidInput, match=r"`broken_task:TASK` cannot be imported: ZeroDivisionError: division by"
    ):
        tasks.named("broken_task:TASK")


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (
            {"camera": "front"},
            "does not have the camera `front` that the task names; its cameras are `studio`",
        ),
        (
            {"photographs": ("end",)},
            "does not have the camera `end` that the task names; its cameras are `studio`",
        ),
    ],
)
def test_a_scene_without_a_camera_that_its_task_names_is_refused(
    words: dict[str, object], sentence: str
) -> None:
    wrong = type("Wrong", (type(BLOCK),), words)()
    with pytest.raises(InvalidInput, match=f"^the scene of the task `block` {sentence}$"):
        wrong.shown(WorldSpec(seed=0))


def test_a_scene_in_which_people_are_shown_nothing_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = BLOCK.scene(WorldSpec(seed=0))
    scene.geom_group[:] = 0
    monkeypatch.setattr(type(BLOCK), "scene", lambda *_: scene)
    with pytest.raises(
        InvalidInput, match=r"^the scene of the task `block` shows nothing: none of its shapes "
    ):
        BLOCK.shown(WorldSpec(seed=0))
