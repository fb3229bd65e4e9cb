"""The palletiser with physics in drawn worlds, judged by its referee: few blocks, so that it takes seconds."""

import pytest
from trig_bench import low_job

from handeye.judge.finding import all_right
from handeye.report.taught_job import JobReport, carry_out
from handeye.tasks.blocks.jobs import PalletJob
from handeye.trig.script import Script

pytestmark = pytest.mark.slow


def carried_out(job: PalletJob, blocks: int, after: int | None = None) -> JobReport:
    """A job that has been taught, carried out, undone and judged."""
    return carry_out(job, "palletise", Script(()), seed=1, blocks=blocks, after=after)


@pytest.mark.trig_row(25)
@pytest.mark.trig_row(26)
@pytest.mark.trig_row(28)
def test_blocks_are_palletised_taken_back_and_palletised_alike() -> None:
    job = low_job(2, seed=1)
    assert not job.findings()["placed"].ok  # by a referee that can be displeased
    done = carried_out(job, 2)
    assert (done.outcome, done.wrong) == ("right", ()), done.told
    assert done.checks["placed"].value > 0.1  # a person who teaches is a little off
    assert done.forward is not None
    assert done.forward.steps == 33
    job.session.runner.run()
    assert job.session.program.active.name == "FINISH"
    again = job.findings()
    assert all_right(again)
    assert again["placed"].value == pytest.approx(done.checks["placed"].value, abs=0.2)


@pytest.mark.trig_row(25)
def test_where_there_are_no_blocks_nothing_is_placed() -> None:
    job = low_job(0, seed=2)
    done = carried_out(job, 0)
    assert (done.outcome, done.forward and done.forward.steps) == ("right", 5)


@pytest.mark.trig_row(27)
def test_a_run_that_is_broken_off_with_the_second_block_in_the_hand_is_taken_back() -> None:
    job = low_job(2, seed=3)
    done = carried_out(job, 2, after=25)
    assert (done.outcome, done.wrong, done.checks) == ("right", (), {}), done.told
    assert all_right(job.findings_back())
