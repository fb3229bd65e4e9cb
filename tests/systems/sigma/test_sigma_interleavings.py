"""Every order of a program's tasks is tried: planted deadlocks and races are found, with a schedule."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from mal_bench import PLANS, TWO_TASKS, mal

from handeye.systems.sigma.machine.perfect import PerfectMotors
from handeye.systems.sigma.mal.compiler import program_of
from handeye.systems.sigma.mal.interleavings import Interleavings, interleavings, schedule_lines
from handeye.systems.sigma.mal.virtual_machine import VirtualMachine

Command = Callable[..., tuple[int, str, str]]


def tried(text: str, most: int = 50_000) -> Interleavings:
    return interleavings(program_of("test.mal", text), most)


def kinds(text: str) -> list[str]:
    return [each.kind for each in tried(text).findings]


@pytest.mark.slow
@pytest.mark.sigma_row(35)
def test_the_hand_over_has_no_deadlock_and_no_race_in_any_order() -> None:
    result = tried(mal("handover"))
    assert (result.complete, result.findings, result.ends) == (True, (), 1)
    assert result.states > 1000


@pytest.mark.slow
def test_without_its_takes_the_hands_of_both_arms_may_meet() -> None:
    lines = [line for line in mal("handover").splitlines() if "TAKE" not in line and "NEXT" not in line]
    once = "\n".join(line for line in lines if "FOR" not in line)
    found = [each for each in tried(once).findings if each.kind == "hands"]
    assert found[0].lines == (170, 330)


@pytest.mark.sigma_row(33)
def test_the_planted_deadlock_is_found_with_a_schedule_that_leads_there() -> None:
    (found,) = tried(mal("dead")).findings
    assert found.kind == "deadlock"
    assert found.told.endswith("the task RIGHT, line 230, waits for flag JIGFREE")
    assert schedule_lines(found.schedule)[-1] == "RIGHT  220 goes on, 230"


def test_a_deadlock_that_the_usual_order_never_shows_is_found() -> None:
    """LEFT is quicker by far, so that the machine's own order always ends."""
    text = "5 SET A\n6 SET B\n" + TWO_TASKS.format(
        left="40 TAKE A\n42 TAKE B\n44 SET B\n46 SET A",
        right="70 DELAY 9\n72 TAKE B\n74 TAKE A\n76 SET A\n78 SET B",
    )
    vm = VirtualMachine(program_of("test.mal", text), PerfectMotors())
    vm.begin()
    while vm.turn:
        vm.statement()
        vm.settle()
    assert vm.memory.fault is None
    assert kinds(text) == ["deadlock"]


@pytest.mark.parametrize(
    ("left", "right", "wanted"),
    [
        ("40 A = A + 1", "70 A = A * 2", ["variable"]),
        ("40 A = 1", "70 PRINT A", ["variable"]),
        ("40 A = 1", "70 B = 1", []),
        ("40 A = 1\n45 SET F", "70 WAIT F\n75 PRINT A", []),
        ("40 MOVE Z1 TO 5", "70 MOVE Z1 TO 9", ["axis"]),
        ("40 MOVE Z1 TO 5\n45 SET F", "70 TAKE F\n75 MOVE Z1 TO 9", []),
        ("40 MOVE X1 TO 300", "70 MOVE X2 TO 300", ["hands"]),
        ("40 MOVE X1 TO 300", "70 MOVE X2 TO 200", []),
        ("40 SET F\n45 SET F", "70 TAKE F\n75 A = 1", ["flag"]),
        ("40 A = 1 / B", "70 END", ["stops"]),
        ("40 START RIGHT", "70 END", ["stops"]),
        ("40 GOTO 40", "70 WAIT NEVER", []),
    ],
)  # fmt: skip
def test_what_may_go_wrong_between_two_tasks_is_named(left: str, right: str, wanted: list[str]) -> None:
    assert sorted({*kinds(TWO_TASKS.format(left=left, right=right))}) == wanted


def test_an_endless_loop_of_one_task_does_not_hide_the_others() -> None:
    assert kinds(TWO_TASKS.format(left="40 GOTO 40", right="70 A = 1 / 0")) == ["stops"]


def test_the_bound_is_said_and_ways_to_end_are_counted() -> None:
    result = tried(mal("dead"), most=20)
    assert (result.states, result.complete) == (20, False)
    assert tried(TWO_TASKS.format(left="40 A = 1", right="70 A = 2")).ends == 2


def test_lines_that_no_order_reaches_are_named_because_nothing_is_known_about_them(
    command: Command, tmp_path: Path
) -> None:
    """Sensors answer 0, so the deadlock at the end is not seen."""
    file = tmp_path / "sees.mal"
    file.write_text("10 IF BEAM(1) = 0 THEN STOP\n20 A = 1\n30 REM\n40 WAIT NEVER\n", encoding="utf-8")
    code, out, _ = command("sigma", "check", str(file), "--interleavings")
    assert (code, out.splitlines()[0]) == (
        0, (
            "not checked: lines 20 to 40, which no order of the tasks reaches (in this check, sensors answer 0 and "
            "no motion is aborted)"
        ),
    )  # fmt: skip
    code, out, _ = command("sigma", "check", str(file), "--interleavings", "--json")
    assert json.loads(out)["unreached"] == [20, 40]
    assert tried(mal("dead"), most=20).unreached == ()  # not all orders were tried


@pytest.mark.slow
def test_the_command_tells_deadlock_schedule_and_bound(command: Command) -> None:
    code, out, _ = command("sigma", "check", str(PLANS / "dead.mal"), "--interleavings")
    assert (code, out.splitlines()[0]) == (1, "deadlock: no task can continue")
    assert "    LEFT   110, 120\n" in out
    assert out.endswith("dead.mal: 310 states, all orders were tried; 1 finding\n")
    code, out, _ = command(
        "sigma", "check", str(PLANS / "dead.mal"), "--interleavings", "--most", "9", "--json"
    )
    assert (code, json.loads(out)["complete"]) == (0, False)
    assert command("sigma", "check", str(PLANS / "dead.mal"))[:2] == (0, f"{PLANS / 'dead.mal'}: no errors\n")
