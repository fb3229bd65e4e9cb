"""The referee of a pump that was taken apart."""

import mujoco
import numpy as np
import pytest

from handeye.core.pose import rotation_z
from handeye.judge.finding import Findings, all_right
from handeye.tasks.water_pump.cell import build_cell
from handeye.tasks.water_pump.referee.findings import judge_apart
from handeye.tasks.water_pump.world.pump_world import PumpWorld

pytestmark = pytest.mark.slow


def found(
    *, moved: str = "", by: tuple[float, float, float] = (0.0, 0.0, 0.0), turned: float = 0.0
) -> Findings:
    """Findings in a cell in which nothing was done, but that somebody has moved or turned a part (mm, deg)."""
    cell = build_cell(PumpWorld.nominal(), camera="ray")
    truth = cell.truth
    if moved:
        body = truth.model.body(moved)
        start = int(truth.model.jnt_qposadr[body.jntadr[0]])
        truth.data.qpos[start : start + 3] += np.array(by) / 1e3
        R = rotation_z(np.radians(turned))[:3, :3] @ truth.data.body(moved).xmat.reshape(3, 3)
        mujoco.mju_mat2Quat(truth.data.qpos[start + 3 : start + 7], R.ravel())
        mujoco.mj_forward(truth.model, truth.data)
    return judge_apart(truth)


def wrong(findings: Findings) -> set[str]:
    return {name for name, finding in findings.items() if finding.refuses}


def test_a_cell_in_which_nothing_was_done_is_apart() -> None:
    assert all_right(found())


@pytest.mark.parametrize(
    ("part", "point"), [("base", "base_back"), ("top", "top_back"), ("pin1", "pins"), ("screw4", "dispenser")]
)
def test_a_part_that_lies_elsewhere_is_told(part: str, point: str) -> None:
    assert point in wrong(found(moved=part, by=(-4.0, 0.0, 60.0)))


def test_a_part_that_lies_turned_is_told() -> None:
    assert wrong(found(moved="base", turned=4.0)) == {"parts_turn"}
    assert not wrong(found(moved="base", turned=2.0))
