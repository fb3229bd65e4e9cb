"""A taught job that is killed, paused, sent back and stopped comes to the same as one that nobody interrupts."""

from pathlib import Path

import pytest
from conftest import Command
from trig_bench import low_setup

from handeye.core.entries import entry_named
from handeye.systems.trig.run.running_job import RunningJob
from handeye.systems.trig.run.state import TaughtState
from handeye.trials.chaos.schedule import parse_schedule
from handeye.trials.chaos.trials import try_schedule
from handeye.trials.sound_run import NEAR_END, SoundRun, sound_run


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> SoundRun:
    """The palletiser with three blocks, its hand no higher than it must be for these."""
    setup = low_setup(3, seed=3).setup
    return sound_run(tmp_path_factory.mktemp("sound"), setup, setup.world)


@pytest.mark.slow
def test_what_interrupts_a_taught_job_changes_nothing_and_what_is_not_put_back_is_found(
    sound: SoundRun, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert 0 < max(sound.starts) <= 48 - NEAR_END
    whole = "seed=3 start=9 steps=5 breaks=kill:2,pause:2,panic:40,back:2 answers=retry"
    assert try_schedule(parse_schedule(whole), sound).broken == ()
    put = RunningJob.restore

    def forgetting(self: RunningJob, state: TaughtState) -> None:
        put(self, state)
        self.job.session.program.trail.clear()

    monkeypatch.setattr(RunningJob, "restore", forgetting)
    assert try_schedule(parse_schedule("seed=3 start=9 steps=5 breaks=pause:2"), sound).names == {"resume"}


def test_chaos_asks_the_system_whether_it_can_be_broken_off(
    command: Command, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr("handeye.cli.trials.require", lambda name, what: calls.append((name, what)) or 1 / 0)
    calls: list[tuple[str, str]] = []
    with pytest.raises(ZeroDivisionError):
        command("trials", "chaos", "--task", "bucket", "--schedule", "seed=3 start=0")
    assert (calls, "chaos" in entry_named("trig").can) == ([("trig", "chaos")], True)
