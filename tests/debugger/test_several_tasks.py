"""A run that stands at several places, one for each of its tasks, is told so wherever it is stepped."""

import msgspec
import pytest
from toy_system import Registers, begin_toy

from handeye.debugger.formatting import as_json, as_text
from handeye.debugger.stepper import Stepper
from handeye.program.system_state import TaskPlace
from handeye.runs.runner import Runner


@pytest.fixture
def stepper(monkeypatch: pytest.MonkeyPatch) -> Stepper:
    """The counter machine, with a second task that waits at line 4."""

    def places(state: Registers) -> tuple[TaskPlace, ...]:
        at = () if state.at is None else (TaskPlace("LEFT", state.at),)
        return (*at, TaskPlace("RIGHT", 3, "flag 2"))

    monkeypatch.setattr(Registers, "places", property(places))
    return Stepper(Runner(begin_toy()))


def test_the_arrow_stands_before_the_task_that_is_next_and_a_dot_before_the_others(stepper: Stepper) -> None:
    assert as_text(stepper.do("step")).splitlines()[-4:] == [
        "    1  ADD A 5",
        "  → 2  ADD B 1   [LEFT]",
        "    3  ADD A -1",
        "  · 4  JUMP A 1   [RIGHT]",
    ]


def test_they_are_shown_with_what_they_wait_for(stepper: Stepper) -> None:
    assert [line.strip() for line in as_text(stepper.do("show tasks")).splitlines()[1:]] == [
        "tasks     LEFT       1  ADD A 5",
        "RIGHT      4  JUMP A 1, waiting for flag 2",
    ]


def test_programs_and_the_live_page_are_told_all_of_them(stepper: Stepper) -> None:
    told = msgspec.json.decode(as_json(stepper.do("step")))
    assert [(task["task"], task["line"], task.get("waits_for")) for task in told["tasks"]] == [
        ("LEFT", 2, None),
        ("RIGHT", 4, "flag 2"),
    ]


def test_a_breakpoint_holds_for_the_task_that_is_next(stepper: Stepper) -> None:
    stepper.do("break 4")
    assert stepper.do("continue").line == 4


def test_a_run_of_one_task_is_told_as_ever() -> None:
    reply = Stepper(Runner(begin_toy())).do("step")
    assert "tasks" not in msgspec.json.decode(as_json(reply))
    assert all("tasks" not in line for line in msgspec.to_builtins(reply.source))
