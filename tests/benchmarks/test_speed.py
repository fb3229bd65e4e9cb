"""What `python -m benchmarks speed` measures, and that measuring changes nothing."""

from itertools import chain

import mujoco
import pytest
from short_runs import begin, history, through

from benchmarks.run_components import COMPONENTS
from benchmarks.run_cost import RunCost
from benchmarks.speed import Watching, bare, carry_out
from handeye.execution.drive import ArmDrive
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint

pytestmark = pytest.mark.slow
SHORT = """
        STAGE   "lift"
        OPEN    1
        CHANGE  [0 0 1] .1
        STAGE   "lower"
        CHANGE  [0 0 -1] .1
"""
STAGES = ("lift", "lower")


class Kept(Observer):
    """Keeps the last checkpoint."""

    def checkpoint(self, checkpoint: Checkpoint) -> None:
        self.last = checkpoint


@pytest.fixture(scope="module")
def kept() -> Kept:
    return Kept()


@pytest.fixture(scope="module")
def measured(kept: Kept, tmp_path_factory: pytest.TempPathFactory) -> tuple[RunCost, Checkpoint]:
    folder = tmp_path_factory.mktemp("measured") / "run"
    return carry_out(begin(SHORT).setup, Watching(observers=[kept]), folder=folder)


def test_a_measured_run_is_the_same_to_the_byte(measured: object, kept: Kept) -> None:
    end, plain = kept.last.snapshot, through(Runner(begin(SHORT)))
    alike = plain.history[-1].cell
    assert end is not None
    assert end.cell is not None
    assert alike is not None
    assert history(list(kept.last.events)) == history(plain.events)
    assert (end.cell.physics.tobytes(), end.cell.noise) == (alike.physics.tobytes(), alike.noise)


def test_every_second_of_the_work_is_in_one_component_of_one_stage(
    measured: tuple[RunCost, Checkpoint],
) -> None:
    spent = measured[0].spent
    components = spent.components()
    assert [*components] == [*COMPONENTS]
    assert sum(chain.from_iterable(spent.components(stage).values() for stage in STAGES)) == pytest.approx(
        spent.work_cpu_s
    )
    assert all(spent.components(stage)["physics"] > 0 for stage in STAGES)
    assert sum(spent.of_preparation().values()) == pytest.approx(spent.preparation_cpu_s)
    assert spent.cpu_s == pytest.approx(spent.preparation_cpu_s + spent.work_cpu_s + spent.referee_cpu_s)


def test_a_run_without_pictures_has_time_in_every_component_but_those(
    measured: tuple[RunCost, Checkpoint],
) -> None:
    components = measured[0].spent.components()
    assert {component for component, seconds in components.items() if seconds == 0} == {"rendering", "vision"}
    assert components["physics"] > components["motions"]


def test_functions_are_their_own_again(measured: object) -> None:
    assert mujoco.mj_step.__name__ == "mj_step"
    assert ArmDrive._pass.__qualname__ == "ArmDrive._pass"


def test_the_physics_alone_ends_every_step_in_the_state_of_the_run(
    measured: tuple[RunCost, Checkpoint],
) -> None:
    alone = bare(measured[1])
    assert (alone.same, alone.apart_s) == (alone.stretches, None)
    assert alone.stretches == 4  # of three steps, and what the last leaves is put back, too
    simulated = measured[0].simulated_s  # rounded to milliseconds
    assert (simulated - 0.001) * 240 <= alone.physics_steps <= (simulated + 0.001) * 960
