"""The palletiser with physics in drawn worlds, judged by its referee: few blocks, so that it takes seconds."""

import pytest
from trig_bench import low_job

from handeye.judge.finding import Findings, all_right
from handeye.results.finishing import outcome
from handeye.runs.advance import Pause, advance
from handeye.runs.host_seconds import Meter
from handeye.runs.runner import Runner
from handeye.systems.trig.language.place import Place
from handeye.systems.trig.run.job import account, carried_out, carry_out, job_of

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
    done = carried_out(runner)
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
    done = carried_out(low_job(0, seed=2))
    assert (done.outcome, done.forward and done.forward.steps) == ("right", 5)


@pytest.mark.trig_row(27)
def test_a_run_that_is_broken_off_with_the_second_block_in_the_hand_is_taken_back() -> None:
    done = carried_out(low_job(2, seed=3), after=25)
    assert (done.outcome, done.wrong, done.checks) == ("right", (), {}), done.told
    assert (done.forward and done.forward.steps, done.back and done.back.steps) == (25, 25)
    assert done.checks_back["blocks"].ok


def test_a_job_that_is_undone_and_not_as_it_was_taught_is_not_right() -> None:
    runner = low_job(1, seed=1)
    pause = carry_out(runner)
    pallet = job_of(runner).job.session.program.positions["PALLET"]
    pallet.data = pallet.data.moved(Place(x=0.001))
    result = outcome(runner, pause, Meter(), judged=True)
    assert (result.assembled, result.apart, result.exit_code) == (True, False, 3)
    assert [name for name, check in result.referee.items() if check.refuses] == ["pallet"]
    assert account(runner, pause, result).outcome == "silent"


def test_a_job_that_is_undone_because_somebody_says_so_is_not_judged_by_what_it_had_built() -> None:
    runner = low_job(1, seed=1)
    advance(runner)
    runner.order_reversal(0, halts=True)
    result = outcome(runner, advance(runner), Meter(), judged=True)
    assert (result.assembled, result.apart) == (None, True)
    assert len(result.interventions) == 1


def test_a_job_that_turns_back_by_itself_is_told_as_that() -> None:
    runner = low_job(1, seed=1)
    result = outcome(runner, carry_out(runner), Meter(), judged=True)
    assert (result.assembled, result.apart, result.interventions) == (True, True, ())
    assert runner.touched is False
