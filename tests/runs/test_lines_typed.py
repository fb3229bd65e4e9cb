"""A line that a person types at the console of a system is an event, and is typed again where a run is repeated."""

import msgspec
import pytest
from short_runs import history
from toy_system import CounterMachine, Registers, begin_toy

from handeye.core import entries
from handeye.core.entries import entry_named
from handeye.core.errors import InvalidInput
from handeye.debugger.stepper import Stepper
from handeye.program.events import LineTyped
from handeye.results.summary import interventions
from handeye.runs.advance import advance
from handeye.runs.checkpoint_file import decode, encode
from handeye.runs.runner import Runner
from handeye.trace.account import account


def add(machine: CounterMachine, text: str, task: str) -> None:
    """A console: `REGISTER n` adds to a register."""
    name, number = text.split()
    if task != "COUNT":
        raise InvalidInput(f"there is no task {task}")
    machine._around.emit(LineTyped(time=machine.time, text=text, task=task))
    machine.state.values[name] = machine.state.values.get(name, 0) + int(number)


@pytest.fixture
def typed(monkeypatch: pytest.MonkeyPatch) -> Runner:
    """A run in which a line was typed after three steps, and that went on to its end."""
    monkeypatch.setattr(CounterMachine, "type_line", add)
    console = msgspec.structs.replace(entry_named("toy"), can=("console",))
    monkeypatch.setitem(entries._registered, "toy", console)
    runner = Runner(begin_toy())
    advance(runner, steps=3)
    runner.type_line("B 100", "COUNT")
    advance(runner)
    return runner


def values(runner: Runner) -> dict[str, int]:
    assert isinstance(runner.system.state, Registers)
    return runner.system.state.values


def test_it_is_typed_again_where_it_was_typed(typed: Runner) -> None:
    again = Runner(begin_toy())
    again.repeat(typed.events)
    assert history(again.events) == history(typed.events)
    assert values(again) == values(typed) == {"A": 0, "B": 105}


def test_going_back_before_it_takes_it_out_and_behind_it_keeps_it(typed: Runner) -> None:
    typed.back_to(5)
    assert values(typed)["B"] == 102
    typed.back_to(2)
    assert (values(typed), typed.touched) == ({"A": 5, "B": 1}, False)


def test_a_run_with_a_typed_line_is_no_longer_the_plans_alone(typed: Runner) -> None:
    kept = decode(encode(typed.checkpoint()), "it")
    assert kept.touched
    assert any(line.endswith("*** typed to COUNT: B 100") for line in account(kept.events))
    assert list(interventions(kept.events)) == ["at 3.0 s typed to COUNT: B 100"]


def test_a_line_that_is_refused_has_not_happened(typed: Runner) -> None:
    events = len(typed.events)
    with pytest.raises(InvalidInput, match=r"^there is no task NONE$"):
        typed.type_line("B 1", "NONE")
    assert len(typed.events) == events


def test_a_system_without_a_console_refuses_politely() -> None:
    with pytest.raises(InvalidInput, match=r"^the counter machine cannot accept typed lines$"):
        Runner(begin_toy()).type_line("B 1")


@pytest.mark.usefixtures("typed")
def test_the_stepper_types_it() -> None:
    stepper = Stepper(Runner(begin_toy()))
    reply = stepper.do("type COUNT B 7")
    assert (reply.error, [step.text for step in reply.did]) == (None, ["typed to COUNT: B 7"])
    assert "type TASK TEXT" in str(stepper.do("help").said)


def test_a_stepper_without_a_console_does_not_tell_of_one() -> None:
    assert "type TASK TEXT" not in str(Stepper(Runner(begin_toy())).do("help").said)
