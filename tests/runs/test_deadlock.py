"""A run whose tasks wait for each other stops, says which waits for what, and can be taken back."""

import pytest
from toy_system import CounterMachine, begin_toy

from handeye.execution.scheduler import Deadlock
from handeye.results.pauses import pause_sentence
from handeye.runs.advance import advance
from handeye.runs.runner import Runner


def test_a_deadlock_ends_a_run_with_its_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    runner = Runner(begin_toy())
    advance(runner, steps=2)

    def locked(_: CounterMachine) -> None:
        raise Deadlock({"LEFT": "flag 2", "RIGHT": "flag 1"})

    with monkeypatch.context() as patch:
        patch.setattr(CounterMachine, "step", locked)
        pause = advance(runner)
    assert pause.kind == "trouble"
    assert "no task can continue: LEFT waits for flag 2, RIGHT waits for flag 1" in pause_sentence(pause)
    runner.rollback()
    assert (runner.trouble, runner.position) == (None, 2)
