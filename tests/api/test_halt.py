"""The panic button of a run that a Python program controls."""

from itertools import count
from pathlib import Path

import pytest

import handeye
from handeye.core.errors import Refused

SCRIPT = "OPEN 1\nOPEN 3\nOPEN 2\n"


@pytest.mark.slow
def test_a_halted_run_pauses_before_the_step_that_was_interrupted() -> None:
    pressed = False
    run = handeye.begin(SCRIPT, task="insertion", halt=lambda: pressed)
    assert run.step().position == 1
    pressed = True
    assert run.until().why == "stopped by the panic button; the brakes are set"
    assert run.state.position == 1
    pressed = False
    assert run.until().why == "the program finished"


def test_a_run_that_takes_no_time_is_halted_after_its_step() -> None:
    calls = count()
    run = handeye.begin("L: SAVE A\nJUMP L\n", task="insertion", halt=lambda: next(calls) > 20)
    assert run.until().why == "paused on request"


def test_a_run_that_is_halted_while_its_cell_is_prepared_does_not_begin(tmp_path: Path) -> None:
    needs_friction = "STOP [0 0 -25]\nCHANGE [0 0 -1] .1\n"
    with pytest.raises(
        Refused, match="the run was halted while its cell was being prepared, so the run did not begin"
    ):
        handeye.begin(needs_friction, task="insertion", out=tmp_path / "run", halt=lambda: True)
    assert not (tmp_path / "run").exists()
