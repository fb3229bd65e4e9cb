from dataclasses import replace

import mujoco
import numpy as np
import pytest
from arm_in_mujoco import build, postures
from robots import ROBOTS

from handeye.arm.dynamics import GRAVITY, bias, gravity, mass_matrix, moving
from handeye.arm.kinematics import jacobian
from handeye.arm.model import ArmModel, digest
from handeye.arm.robots.stanford import STANFORD
from handeye.core.units import INCH

ARMS = pytest.mark.parametrize("arm", [robot.arm for robot in ROBOTS.values()], ids=list(ROBOTS))


@ARMS
def test_inertia_and_bias_agree_with_mujoco(arm: ArmModel) -> None:
    model = build(arm)
    data = mujoco.MjData(model)
    q = postures(arm, 100)
    qd = np.random.default_rng(2).normal(size=q.shape)
    M, h = mass_matrix(arm, q), bias(arm, q, qd)
    theirs = np.zeros(M[0].shape)
    for i in range(100):
        data.qpos[:], data.qvel[:] = q[i], qd[i]
        mujoco.mj_forward(model, data)
        mujoco.mj_fullM(model, data, theirs)
        np.testing.assert_allclose(M[i], theirs, atol=1e-9)
        np.testing.assert_allclose(h[i], data.qfrc_bias - data.qfrc_passive, atol=1e-9)


@ARMS
def test_a_motion_at_once_equals_its_ticks_one_by_one(arm: ArmModel) -> None:
    rng, q = np.random.default_rng(3), postures(arm, 5)
    qd = rng.normal(size=q.shape)
    np.testing.assert_allclose(mass_matrix(arm, q), [mass_matrix(arm, one) for one in q], atol=1e-12)
    singly = [bias(arm, *args) for args in zip(q, qd, strict=True)]
    np.testing.assert_allclose(bias(arm, q, qd), singly, atol=1e-12)


@ARMS
def test_gravity_is_the_bias_at_rest(arm: ArmModel) -> None:
    q = postures(arm, 20)
    np.testing.assert_allclose(gravity(arm, q), bias(arm, q, np.zeros_like(q)), atol=1e-12)


@ARMS
def test_bias_counts_friction(arm: ArmModel) -> None:
    q, qd = postures(arm, 1)[0], np.eye(len(arm.joints))[-1]
    smooth = replace(arm, joints=tuple(replace(joint, damping=0.0) for joint in arm.joints))
    friction = bias(arm, q, qd) - bias(smooth, q, qd)
    np.testing.assert_allclose(friction, arm.joints[-1].damping * qd, atol=1e-12)


def pull(arm: ArmModel, boom: float) -> float:
    """Torque (N m) that gravity has on joint 2, the boom level and out so far (in), the wrist straight."""
    return -float(gravity(arm, np.array([0, np.pi / 2, boom * INCH, 0, 0, 0]))[1])


LUMPED = tuple(replace(joint, centre=(0.0, 0.0, -joint.d)) for joint in STANFORD.joints[3:])
"""The three links of the wrist with their mass at the wrist's centre."""
BARE = replace(STANFORD, hand=replace(STANFORD.hand, mass=0.0))
"""The arm without fingers."""


@pytest.mark.row(33)
@pytest.mark.parametrize(("boom", "torque"), [(16.67, 2.5), (20, 8.1), (30, 24.8)])
def test_gravity_pulls_joint_2_of_the_arm_as_modelled(boom: float, torque: float) -> None:
    assert pull(STANFORD, boom) == pytest.approx(torque, abs=0.1)


@pytest.mark.parametrize("boom", [16.67, 20, 30])
def test_gravity_pulls_joint_2_of_the_scene_as_it_does_that_of_the_arm(boom: float) -> None:
    model = ROBOTS["stanford"].model()
    data = mujoco.MjData(model)
    data.qpos[:6] = 0, np.pi / 2, boom * INCH, 0, 0, 0
    mujoco.mj_forward(model, data)
    assert -data.qfrc_bias[1] == pytest.approx(pull(STANFORD, boom), abs=1e-3)


@pytest.mark.parametrize(("boom", "torque"), [(12, -7.5), (16.67, 0.0), (20, 5.4), (30, 21.5), (40, 37.6)])
def test_without_fingers_and_with_the_wrist_in_one_point_it_is_what_the_reference_lists(
    boom: float, torque: float
) -> None:
    assert pull(replace(BARE, joints=STANFORD.joints[:3] + LUMPED), boom) == pytest.approx(torque, abs=0.1)


@pytest.mark.parametrize("boom", [16.67, 20, 30])
def test_the_rest_is_the_fingers_and_the_wrist_reaching_beyond_its_centre(boom: float) -> None:
    """Fingers of .24 kg, .20 m beyond the wrist's centre; the mass centres of links 4 to 6 as published."""
    listed = pull(replace(BARE, joints=STANFORD.joints[:3] + LUMPED), boom)
    fingers = 0.24 * GRAVITY * (boom * INCH + 0.20)
    wrist = GRAVITY * (-1.08 * 0.0092 + 0.63 * 0.0566 + 0.51 * 0.1554)
    assert pull(STANFORD, boom) - listed == pytest.approx(fingers + wrist, abs=0.01)


def test_fingers_weigh_on_every_joint_that_carries_them() -> None:
    q = np.array([0.3, np.pi / 2, 0.7, 0.0, np.pi / 2, 0.0])  # hand straight down: they hang below the wrist
    bare = replace(STANFORD, hand=replace(STANFORD.hand, mass=0.0))
    more = gravity(bare, q)[1] - gravity(STANFORD, q)[1]
    assert more == pytest.approx(0.24 * 9.81 * 0.7)


@ARMS
def test_inertia_of_every_link_is_physically_possible(arm: ArmModel) -> None:
    for joint in arm.joints:
        assert min(joint.inertia) > 0
        assert 2 * max(joint.inertia) <= sum(joint.inertia), joint.name


def test_a_robot_whose_figures_do_not_fit_together_is_refused() -> None:
    twice = (*STANFORD.joints[:5], STANFORD.joints[0])
    for wrong in ({"joints": twice}, {"joints": STANFORD.joints[:5]}, {"held": {"rail": 0.5}}):
        with pytest.raises(ValueError, match=r"^Stanford: "):
            replace(STANFORD, **wrong)


def test_digest_changes_with_any_figure_that_a_plan_rests_on() -> None:
    assert digest(STANFORD) == digest(replace(STANFORD, X_WB=STANFORD.X_WB.copy()))
    assert digest(STANFORD) != digest(replace(STANFORD, hand=replace(STANFORD.hand, mass=0.25)))
    assert digest(STANFORD) != digest(replace(STANFORD, X_WB=np.eye(4)))
    assert digest(STANFORD) != digest(replace(STANFORD, held={"boom": 0.5}))


def test_digest_tells_nothing_of_figures_that_no_plan_rests_on() -> None:
    yielding = replace(STANFORD.compliance, gain=0.1)
    gentle = replace(STANFORD.hand, grasp=replace(STANFORD.hand.grasp, settle=1))
    assert digest(STANFORD) == digest(replace(STANFORD, compliance=yielding, hand=gentle))


@ARMS
def test_a_moving_arm_has_the_bytes_that_its_parts_have_alone(arm: ArmModel) -> None:
    q = postures(arm, 5)
    qd = np.random.default_rng(4).normal(size=q.shape)
    found = moving(arm, q, qd)
    assert found.M.tobytes() == mass_matrix(arm, q).tobytes()
    assert found.bias.tobytes() == bias(arm, q, qd).tobytes()
    assert found.at(3).J.tobytes() == jacobian(arm, q)[3].tobytes()
