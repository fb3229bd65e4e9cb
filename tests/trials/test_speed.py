"""What `handeye bench speed` measures, and that measuring changes nothing."""

import json
from collections.abc import Sequence
from dataclasses import replace
from itertools import chain
from pathlib import Path

import msgspec
import mujoco
import pytest
from conftest import Command
from short_runs import begin, history, through

from handeye.cell.bare_physics import Bare
from handeye.execution import drive
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.trials.run_components import COMPONENTS
from handeye.trials.run_cost import RunCost, Speed
from handeye.trials.speed import Watching, bare, carry_out

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
    assert drive.run.__qualname__ == "run"


def test_the_physics_alone_ends_every_step_in_the_state_of_the_run(
    measured: tuple[RunCost, Checkpoint],
) -> None:
    alone = bare(measured[1])
    assert (alone.same, alone.apart_s) == (alone.stretches, None)
    assert alone.stretches == 4  # of three steps, and what the last leaves is put back, too
    assert alone.physics_steps == round(measured[0].simulated_s * 960)


ALONE = Bare(seconds=2.0, physics_steps=960, stretches=4, same=4, apart_s=None)


def speed_of(run: RunCost, alone: Bare) -> Speed:
    return Speed(
        start_cpu_s=1.0, planning_cpu_s=0.5, stages=STAGES, runs=(replace(run, bare=alone),), peak_memory_mib=None
    )  # fmt: skip


def test_the_run_is_told_as_a_multiple_of_its_physics(measured: tuple[RunCost, Checkpoint]) -> None:
    run = replace(measured[0], bare=ALONE)
    assert run.ratio == pytest.approx(run.spent.work_cpu_s / 2)
    assert run.ratio_without_pictures == run.ratio


def told(command: Command, monkeypatch: pytest.MonkeyPatch, found: Speed, *words: str) -> tuple[int, str]:
    """Exit code and answer of the command, if this is what is measured."""
    asked = []

    def measure(setups: Sequence[Setup], stages: tuple[str, ...], **_: object) -> Speed:
        asked.extend(setup.world.seed for setup in setups)
        return found

    Path("short.al").write_text("OPEN 1\n", encoding="utf-8")
    monkeypatch.setattr("handeye.cli.speed.default_script", lambda: Path("short.al"))
    monkeypatch.setattr("handeye.trials.speed.measure", measure)
    code, out, _ = command("bench", "speed", "--seed", "3", "--worlds", "2", *words)
    assert asked == [3, 4]
    return code, out


def test_the_bench_tells_people_phases_components_and_stages(
    command: Command, monkeypatch: pytest.MonkeyPatch, measured: tuple[RunCost, Checkpoint]
) -> None:
    code, out = told(command, monkeypatch, speed_of(measured[0], ALONE))
    assert code == 1
    for word in (
        "planning",
        *COMPONENTS,
        *STAGES,
        "world 0: not right",
        "bit for bit",
        "memory: not measured on this system",
    ):
        assert word in out


def test_the_bench_tells_programs_the_same(
    command: Command, monkeypatch: pytest.MonkeyPatch, measured: tuple[RunCost, Checkpoint]
) -> None:
    found = speed_of(measured[0], replace(ALONE, same=3, apart_s=1.5))
    (world,) = json.loads(told(command, monkeypatch, found, "--json")[1])["worlds"]
    assert world["work_cpu_s"] == pytest.approx(sum(stage["cpu_s"] for stage in world["stages"]))
    assert world["components"]["physics_cpu_s"] == pytest.approx(found.spent.components()["physics"])
    assert (world["physics_alone"]["cpu_s"], world["physics_alone"]["apart_simulated_s"]) == (2.0, 1.5)


def test_an_hour_of_one_processor_is_reckoned_with_all_that_the_process_took(
    measured: tuple[RunCost, Checkpoint],
) -> None:
    accepted = replace(measured[0], result=msgspec.structs.replace(measured[0].result, assembled=True))
    found = speed_of(accepted, ALONE)
    assert found.cpu_s == pytest.approx(1.5 + accepted.spent.cpu_s)
    assert found.accepted_per_core_hour == pytest.approx(3600 / found.cpu_s)


def test_the_bench_wants_a_world(command: Command) -> None:
    said = "handeye: at least one world is needed; 0 is too few\n"
    assert command("bench", "speed", "--worlds", "0") == (2, "", said)
