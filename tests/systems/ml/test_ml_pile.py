"""The pile of the bin comes to rest, and statements that take no time do not disturb it."""

import mujoco
import numpy as np
import pytest

from handeye.cell.snapshot_cell import SnapshotCell
from handeye.cell.state import CellState
from handeye.core.variation import WorldSpec
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.systems.ml.bin.task import BIN
from handeye.systems.ml.run.jobs import job_plan, job_setup

ROCKING = {
    2: (-0.0228, 0.0255, 0.009, 0.7164, 0, 0.0001, -0.6977),
    3: (0.0202, -0.0278, 0.009, 0, 0.6368, -0.7711, 0),
    4: (0.0209, 0.0376, 0.009, 0.7546, 0, 0, 0.6562),
    7: (0.0288, -0.0323, 0.023, 0.2425, -0.0004, 0.0001, 0.9702),
    8: (-0.003, -0.0011, 0.0229, -0.6513, 0.2753, -0.651, -0.276),
}  # a pile of bars, two of which lie on the edges of others: position (m) and quaternion of each


@pytest.mark.slow
def test_bars_that_lie_on_the_edges_of_others_come_to_rest() -> None:
    """With contacts that begin hard, five bodies of this pile stay awake, because a bar rocks for ever."""
    model = BIN.station(8, BIN.world(WorldSpec(seed=62001))).bench.model
    data = mujoco.MjData(model)
    for part in range(1, 9):
        away = (0.3, 0.1 * part - 0.4, 0.007, 1, 0, 0, 0)
        data.joint(f"part_{part}").qpos[:] = ROCKING.get(part, away)
    mujoco.mj_step(model, data, 1000)
    assert data.ntree_awake == 0


@pytest.mark.slow
def test_a_part_that_falls_off_the_table_comes_to_rest_on_the_floor() -> None:
    model = BIN.station(1, BIN.world(WorldSpec(seed=7))).bench.model
    data = mujoco.MjData(model)
    data.joint("part_1").qpos[:3] = (0.5, 0, 0.1)
    mujoco.mj_step(model, data, 2500)
    assert data.ntree_awake == 0
    assert data.body("part_1").xpos[2] == pytest.approx(-0.743, abs=0.001)


@pytest.mark.slow
def test_a_cell_is_restored_only_after_statements_in_which_time_passes(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    times: list[float] = []
    monkeypatch.setattr(SnapshotCell, "restore", lambda _, state: times.append(state.time))
    runner = Runner(Checkpoint(setup=job_setup(job_plan("bin", "1"), WorldSpec(seed=7))))
    for _ in range(25):
        runner.step()
    assert len(times) == len({*times}) < len(runner.history)
    assert {snapshot.cell.time for snapshot in runner.history if snapshot.cell} == {*times}


def test_states_are_equal_only_if_nothing_differs() -> None:
    def state(place: float = 1, gain: float = 2, noise: str = "3", goal: int = 4) -> CellState:
        figures = {"gain": np.array([gain])}
        return CellState(
            physics=np.array([0, place]), figures=figures, noise=noise, mechanisms={"arm": {"goal": goal}}
        )

    assert state().equals(state())
    others = state(place=5), state(gain=5), state(noise="5"), state(goal=5)
    assert not any(state().equals(other) for other in others)
