"""Which physics steps the pump's cell takes."""

from typing import Any

import mujoco
import pytest
from driving import tick
from finished import put, stacked, tightening

from handeye.cell.physics_stepper import FINER, MIDDLE
from handeye.core.pose import pose

pytestmark = pytest.mark.slow
SHORT = 1 / 960
SPEED = 6.0  # m/s; at 3 m/s the force is 960 N


@pytest.fixture
def last(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """Length (s) of the last step."""
    step, length = mujoco.mj_step, [0.0]

    def noted(model: mujoco.MjModel, *rest: Any) -> None:
        length[0] = model.opt.timestep
        step(model, *rest)

    monkeypatch.setattr(mujoco, "mj_step", noted)
    return length


def test_loose_parts_that_touch_take_middle_steps(last: list[float]) -> None:
    cell = stacked()
    dof = cell.truth.model.joint("top").dofadr[0]
    cell.truth.data.qfrc_applied[dof] = 0.1  # N; keeps the top awake
    lengths = []
    for _ in range(6):
        tick(cell.devices)
        lengths.append(last[0])
    assert lengths[2:] == [MIDDLE * SHORT] * 4  # the screwdriver sleeps in its rack


def test_a_screw_turns_in_short_steps_whatever_turns_it(last: list[float]) -> None:
    cell = stacked()
    turn = cell.truth.data.joint("thread_turn0")
    turning = 0
    for _ in tightening(cell, 0):
        if abs(turn.qvel[0]) > 0.1:
            assert last[0] == SHORT
            turning += 1
    assert turning >= 3


def test_a_finger_that_is_crushed_takes_fine_steps(last: list[float]) -> None:
    cell = stacked()
    data = cell.truth.data
    tool = data.site("stanford/tool")
    put(cell.truth, "pin0", pose(tool.xmat.reshape(3, 3), tool.xpos))
    for finger in ("stanford/finger_a", "stanford/finger_b"):
        data.joint(finger).qpos, data.joint(finger).qvel = 0.01, -SPEED
    tick(cell.devices)
    assert last[0] == SHORT / FINER
