"""Forward kinematics, Jacobian and drift of each robot."""

import mujoco
import numpy as np
import pytest
from arm_in_mujoco import build, postures
from robots import ROBOTS

from handeye.arm.kinematics import chain, drift, forward, jacobian
from handeye.arm.model import ArmModel

ARMS = pytest.mark.parametrize("arm", [robot.arm for robot in ROBOTS.values()], ids=list(ROBOTS))


@ARMS
def test_forward_kinematics_and_jacobian_agree_with_mujoco(arm: ArmModel) -> None:
    model, q = build(arm), postures(arm, 100)
    data, site = mujoco.MjData(model), model.site("T").id
    J = np.zeros((6, len(arm.joints)))
    for here, X, J_ours in zip(q, forward(arm, q), jacobian(arm, q), strict=True):
        data.qpos[:] = here
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_jacSite(model, data, J[:3], J[3:], site)
        np.testing.assert_allclose(X[:3, 3], data.site_xpos[site], atol=1e-9)
        np.testing.assert_allclose(X[:3, :3].ravel(), data.site_xmat[site], atol=1e-9)
        np.testing.assert_allclose(J_ours, J, atol=1e-9)


@ARMS
def test_drift_is_the_acceleration_left_at_constant_joint_rates(arm: ArmModel) -> None:
    h, q = 1e-4, postures(arm, 50)
    qd = np.random.default_rng(2).normal(size=q.shape)
    J = [jacobian(arm, q + s * h * qd) for s in (1, -1)]
    np.testing.assert_allclose(
        drift(arm, *chain(arm, q), qd), (((J[0] - J[1]) / (2 * h)) @ qd[..., None])[..., 0], atol=1e-5
    )
