"""A run that is put behind a kept measurement of its joints equals one that has measured them."""

import pytest
from kept_measurements import RUN, keeping
from msgspec.structs import replace
from short_runs import FEEL, begin, history, through

from handeye.core.packed import encoded
from handeye.core.variation import Overrides, WorldSpec
from handeye.execution.servo import Halted
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.systems.stanford.executor_run import RunningPlan

pytestmark = pytest.mark.slow


@pytest.fixture
def counted(monkeypatch: pytest.MonkeyPatch) -> list[WorldSpec]:
    """The worlds in which the arm has really measured."""
    found: list[WorldSpec] = []
    measure = RunningPlan._measure_joints.__wrapped__

    def really(self: RunningPlan) -> float:
        found.append(self._setup.world)
        return measure(self)

    monkeypatch.setattr(RunningPlan, "_measure_joints", keeping(really))
    return found


def ended(start: Checkpoint) -> tuple[bytes, bytes]:
    """What happens in a run, and its last state."""
    runner = through(Runner(start))
    return history(list(runner.events)), encoded(runner.checkpoint().snapshot)


def test_a_run_behind_a_kept_measurement_is_to_the_byte_one_that_measures_anew(
    counted: list[WorldSpec], monkeypatch: pytest.MonkeyPatch
) -> None:
    first, second = ended(begin(FEEL, seed=1)), ended(begin(FEEL, seed=1))
    assert len(counted) == 1
    monkeypatch.undo()
    monkeypatch.setattr(RunningPlan, "_measure_joints", RunningPlan._measure_joints.__wrapped__)
    assert first == second == ended(begin(FEEL, seed=1))


def test_every_world_is_measured_for_itself_and_none_where_a_test_replaces_the_measurement(
    counted: list[WorldSpec], monkeypatch: pytest.MonkeyPatch
) -> None:
    worlds = [
        WorldSpec(seed=1),
        WorldSpec(seed=2),
        WorldSpec(seed=1, overrides=Overrides(set={"arm.friction.1": 0.3})),
    ]
    setup = begin(FEEL).setup
    starts = [Checkpoint(setup=replace(setup, world=world)) for world in worlds]
    for start in (*starts, *starts):
        Runner(start)
    assert counted == worlds
    monkeypatch.setattr(f"{RUN}.measure_joints", lambda *_: pytest.fail("it is asked"))
    with pytest.raises(pytest.fail.Exception, match="it is asked"):
        Runner(starts[0])


def test_a_run_that_is_halted_while_it_measures_is_halted_behind_a_kept_measurement_too(
    counted: list[WorldSpec],
) -> None:
    Runner(begin(FEEL, seed=1))
    with pytest.raises(Halted):
        Runner(begin(FEEL, seed=1), halt=lambda: True)
    assert len(counted) == 2
