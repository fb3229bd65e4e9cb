"""The arm as URDF is the arm of the cell: read by MuJoCo, it stands and weighs as the formulas say."""

import json
from pathlib import Path

import mujoco
import numpy as np
import pytest

from handeye.arm import STANFORD, forward, gravity
from handeye.cell.urdf import roll_pitch_yaw
from handeye.cli import app

POSTURES = 100


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> mujoco.MjModel:
    """What MuJoCo makes of the exported file."""
    file = tmp_path_factory.mktemp("urdf") / "arm.urdf"
    assert app(["export", "urdf", "-o", str(file)], result_action="return_value") == 0
    return mujoco.MjModel.from_xml_path(str(file))


@pytest.fixture(scope="module")
def postures() -> np.ndarray:
    """Joint positions within the limits."""
    return np.random.default_rng(49).uniform(STANFORD.lower, STANFORD.upper, size=(POSTURES, 6))


def stand(model: mujoco.MjModel, q: np.ndarray) -> mujoco.MjData:
    """The arm in a posture, at rest, with closed fingers."""
    data = mujoco.MjData(model)
    for number, position in enumerate(q, 1):
        data.joint(f"j{number}").qpos = position
    mujoco.mj_forward(model, data)
    return data


def test_the_hand_is_where_the_formulas_say(model: mujoco.MjModel, postures: np.ndarray) -> None:
    for q, X in zip(postures, forward(postures), strict=True):
        tool = stand(model, q).body("tool")
        assert tool.xpos == pytest.approx(X[:3, 3], abs=1e-9)
        assert tool.xmat.reshape(3, 3) == pytest.approx(X[:3, :3], abs=1e-9)


def test_the_arm_weighs_what_the_formulas_say(model: mujoco.MjModel, postures: np.ndarray) -> None:
    for q, torque in zip(postures, gravity(postures), strict=True):
        assert stand(model, q).qfrc_bias[:6] == pytest.approx(torque, abs=1e-5)


def test_the_joints_have_the_names_and_limits_that_the_command_lists(
    model: mujoco.MjModel, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    app(["export", "urdf", "-o", str(tmp_path / "it.urdf"), "--json"], result_action="return_value")
    for joint, drawn in zip(json.loads(capsys.readouterr().out)["joints"], STANFORD.joints, strict=True):
        assert model.joint(joint["name"]).range == pytest.approx([drawn.lower, drawn.upper])
        assert joint["called"] == drawn.name


@pytest.mark.parametrize("pitch", [0.3, np.pi / 2, -np.pi / 2])
def test_angles_give_the_rotation_that_they_came_from(pitch: float) -> None:
    def turned(axis: int, angle: float) -> np.ndarray:
        quaternion, matrix = np.empty(4), np.empty(9)
        mujoco.mju_axisAngle2Quat(quaternion, np.eye(3)[axis], angle)
        mujoco.mju_quat2Mat(matrix, quaternion)
        return matrix.reshape(3, 3)

    R = turned(2, 0.7) @ turned(1, pitch) @ turned(0, -0.4)
    roll, up, yaw = roll_pitch_yaw(R)
    assert turned(2, yaw) @ turned(1, up) @ turned(0, roll) == pytest.approx(R, abs=1e-9)
