from dataclasses import replace

import mujoco
import numpy as np
import pytest
from arm_in_mujoco import build, postures
from robots import ROBOTS

from handeye.arm.dynamics import bias, gravity, mass_matrix
from handeye.arm.model import ArmModel, digest
from handeye.arm.robots.stanford import STANFORD
from handeye.units import INCH

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


@pytest.mark.parametrize(("boom", "torque"), [(12, -7.5), (16.67, 0.0), (20, 5.4), (30, 21.5), (40, 37.6)])
def test_gravity_pulls_joint_2_as_the_reference_lists(boom: float, torque: float) -> None:
    """The listed figures put the three wrist links at the wrist centre and leave the fingers away."""
    lumped = tuple(replace(j, centre=(0.0, 0.0, -j.d)) for j in STANFORD.joints[3:])
    arm = replace(STANFORD, joints=STANFORD.joints[:3] + lumped, hand=replace(STANFORD.hand, mass=0.0))
    pull = -gravity(arm, np.array([0, np.pi / 2, boom * INCH, 0, 0, 0]))[1]
    assert pull == pytest.approx(torque, abs=0.1)


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
