from dataclasses import replace

import mujoco
import numpy as np
import pytest
from arm_in_mujoco import build, postures

from handeye.arm.dynamics import bias, gravity, inverse_dynamics, mass_matrix
from handeye.arm.model import digest
from handeye.arm.robots.stanford import STANFORD
from handeye.units import INCH


def test_inertia_and_bias_agree_with_mujoco() -> None:
    model = build(STANFORD)
    data = mujoco.MjData(model)
    q, qd = postures(100), np.random.default_rng(2).normal(size=(100, 6))
    M, h = mass_matrix(STANFORD, q), inverse_dynamics(STANFORD, q, qd, np.zeros_like(q))
    theirs = np.zeros((6, 6))
    for i in range(100):
        data.qpos[:], data.qvel[:] = q[i], qd[i]
        mujoco.mj_forward(model, data)
        mujoco.mj_fullM(model, data, theirs)
        np.testing.assert_allclose(M[i], theirs, atol=1e-9)
        np.testing.assert_allclose(h[i], data.qfrc_bias, atol=1e-9)


def test_a_motion_at_once_equals_its_ticks_one_by_one() -> None:
    rng = np.random.default_rng(3)
    q, qd, qdd = postures(5), rng.normal(size=(5, 6)), rng.normal(size=(5, 6))
    singly = [inverse_dynamics(STANFORD, *args) for args in zip(q, qd, qdd, strict=True)]
    np.testing.assert_allclose(inverse_dynamics(STANFORD, q, qd, qdd), singly, atol=1e-12)


def test_gravity_is_the_bias_at_rest() -> None:
    q = postures(20)
    np.testing.assert_allclose(gravity(STANFORD, q), bias(STANFORD, q, np.zeros_like(q)), atol=1e-12)


def test_bias_counts_friction() -> None:
    q, qd = postures(1)[0], np.array([0.0, 0, 0, 0, 0, 1.0])
    friction = bias(STANFORD, q, qd) - inverse_dynamics(STANFORD, q, qd, np.zeros(6))
    np.testing.assert_allclose(friction, [0, 0, 0, 0, 0, 0.1], atol=1e-12)


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


def test_inertia_of_every_link_is_physically_possible() -> None:
    for joint in STANFORD.joints:
        assert min(joint.inertia) > 0
        assert 2 * max(joint.inertia) <= sum(joint.inertia), joint.name


def test_digest_changes_with_any_figure() -> None:
    assert digest(STANFORD) == digest(replace(STANFORD, X_WB=STANFORD.X_WB.copy()))
    assert digest(STANFORD) != digest(replace(STANFORD, hand=replace(STANFORD.hand, mass=0.25)))
    assert digest(STANFORD) != digest(replace(STANFORD, X_WB=np.eye(4)))
    assert digest(STANFORD) != digest(replace(STANFORD, held={"boom": 0.5}))
