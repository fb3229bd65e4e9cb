"""The palletiser with physics in drawn worlds, judged by its referee: few blocks, so that it takes seconds."""

import pytest
from trig_bench import low_job

from handeye.judge.finding import Findings, all_right
from handeye.report.taught_job import carry_out
from handeye.runs.advance import Pause, advance
from handeye.runs.runner import Runner

pytestmark = pytest.mark.slow


def findings(runner: Runner) -> Findings:
    """What the referee says of the blocks as they lie."""
    return runner.task.judge(runner.cell.truth)


@pytest.mark.trig_row(25)
@pytest.mark.trig_row(26)
@pytest.mark.trig_row(28)
def test_blocks_are_palletised_taken_back_and_palletised_alike() -> None:
    runner = low_job(2, seed=1)
    assert not findings(runner)["placed"].ok  # by a referee that can be displeased
    done = carry_out(runner, blocks=2).report
    assert (done.outcome, done.wrong) == ("right", ()), done.told
    assert done.checks["placed"].value > 0.1  # a person who teaches is a little off
    assert done.forward is not None
    assert done.forward.steps == 33
    runner.answer("proceed")
    assert advance(runner) == Pause(kind="end", done=33)
    again = findings(runner)
    assert all_right(again)
    assert again["placed"].value == pytest.approx(done.checks["placed"].value, abs=0.2)


@pytest.mark.trig_row(25)
def test_where_there_are_no_blocks_nothing_is_placed() -> None:
    done = carry_out(low_job(0, seed=2), blocks=0).report
    assert (done.outcome, done.forward and done.forward.steps) == ("right", 5)


@pytest.mark.trig_row(27)
def test_a_run_that_is_broken_off_with_the_second_block_in_the_hand_is_taken_back() -> None:
    done = carry_out(low_job(2, seed=3), blocks=2, after=25).report
    assert (done.outcome, done.wrong, done.checks) == ("right", (), {}), done.told
    assert (done.forward and done.forward.steps, done.back and done.back.steps) == (25, 25)
    assert done.checks_back["blocks"].ok
