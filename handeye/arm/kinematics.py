"""Forward kinematics and the Jacobian, of any chain."""

import numpy as np

from handeye.arm.chain import centripetal, chain, tool_jacobian
from handeye.arm.model import ArmModel
from handeye.core.pose import Array, Pose


def forward(arm: ArmModel, q: Array) -> Pose:
    """`X_WT` at joint positions `q`, shape (..., n) to (..., 4, 4)."""
    R, p = chain(arm, q)
    X = np.zeros((*R.shape[:-3], 4, 4))
    X[..., :3, :3], X[..., :3, 3], X[..., 3, 3] = R[..., -1, :, :], p[..., -1, :], 1.0
    return X


def jacobian(arm: ArmModel, q: Array) -> Array:
    """Geometric Jacobian at T in world axes, shape (..., n) to (..., 6, n): linear rows, then angular."""
    return tool_jacobian(arm, *chain(arm, q))


def drift(arm: ArmModel, q: Array, qd: Array) -> Array:
    """Acceleration of T at joint rates `qd` without joint accelerations (dJ/dt qd), shape (..., 6)."""
    R, p = chain(arm, q)
    linear, angular = centripetal(arm, R, p, p[..., -1:, :], np.full(1, len(arm.joints) - 1), qd)
    return np.concatenate([linear[..., 0, :], angular[..., 0, :]], axis=-1)
