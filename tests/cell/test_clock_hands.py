"""Hands of a clock in a scene show the cell's clock."""

import mujoco
import numpy as np
import pytest

from handeye.cell.posed import drawn_poses, posed

SCENE = """
<mujoco>
  <custom><numeric name="turns/second_hand" data="60"/><numeric name="other" data="1"/></custom>
  <worldbody>
    <body name="second_hand" pos="-2 1 .5" quat=".5 .5 .5 .5">
      <geom name="tip" size=".01" pos="0 .1 0" group="1"/>
    </body>
  </worldbody>
</mujoco>"""
"""The hand turns on a wall that is looked at along -x, y to its right and z up."""


@pytest.mark.parametrize(
    ("seconds", "right", "up"), [(0, 0, 0.1), (15, 0.1, 0), (30, 0, -0.1), (105, -0.1, 0)]
)
def test_a_hand_turns_clockwise_as_who_looks_at_the_clock_sees_it(
    seconds: float, right: float, up: float
) -> None:
    _, data = posed(mujoco.MjModel.from_xml_string(SCENE), {}, seconds)
    assert np.allclose(data.geom("tip").xpos, (-2.0, 1.0 + right, 0.5 + up), atol=1e-12)


def test_poses_of_a_run_are_those_of_its_moments() -> None:
    model = mujoco.MjModel.from_xml_string(SCENE)
    rows = drawn_poses(model, ["second_hand"], np.array([0.0, 15.0]))["second_hand"]
    assert rows.shape == (2, 7)
    assert np.allclose(np.linalg.norm(rows[:, 3:], axis=1), 1.0)
    assert np.allclose(rows[:, :3], (-2.0, 1.0, 0.5))


def test_what_does_not_turn_stands_as_drawn() -> None:
    model = mujoco.MjModel.from_xml_string(SCENE.replace("turns/", ""))
    rows = drawn_poses(model, ["second_hand"], np.array([0.0, 15.0]))["second_hand"]
    assert np.array_equal(rows, np.tile((-2.0, 1.0, 0.5, 0.5, 0.5, 0.5, 0.5), (2, 1)))
