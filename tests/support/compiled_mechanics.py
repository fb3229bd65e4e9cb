"""The mechanics of the fake arm in C, twenty times as fast as by the formulas."""

import mujoco
import numpy as np

from handeye.arm.robots.stanford import STANFORD
from handeye.cell.compiled_arm import _model
from handeye.core.pose import Array


class CompiledMechanics:
    """What `fakes.by_formulas` computes."""

    def __init__(self) -> None:
        self._model = _model(STANFORD)
        self._data = mujoco.MjData(self._model)

    def __call__(self, q: Array, qd: Array) -> tuple[Array, Array]:
        model, data = self._model, self._data
        data.qpos[:], data.qvel[:] = q, qd
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_comVel(model, data)
        mujoco.mj_crb(model, data)
        M, bias = np.zeros((len(q), len(q))), np.empty(len(q))
        mujoco.mj_fullM(model, data, M)
        mujoco.mj_rne(model, data, 0, bias)
        return M, bias
