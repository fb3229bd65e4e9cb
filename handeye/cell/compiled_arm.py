"""Kinematics and dynamics of an arm in MuJoCo's C code. For a single configuration, this code is about twenty times as
fast as the formulas.

The model is made only from the arm model of the controller, so it contains nothing about the true cell.
"""

import mujoco
import numpy as np

from handeye.arm.arithmetic import ArmArithmetic
from handeye.arm.dynamics import GRAVITY, Dynamics
from handeye.arm.kinematics import link_rotations
from handeye.arm.model import ArmModel, constants
from handeye.core.pose import Array, Pose


class CompiledArm(ArmArithmetic):
    """An arm as a MuJoCo model of its links and joints. The object computes in one buffer, so several threads must not
    share one object.
    """

    def __init__(self, arm: ArmModel) -> None:
        """Compile the arm. This takes some milliseconds."""
        self._model = _model(arm)
        self._data = data = mujoco.MjData(self._model)
        self._joints, self._tool = self._model.nv, self._model.nbody - 1
        self._position, self._rotation = data.xpos[self._tool], data.xmat[self._tool].reshape(3, 3)

    def forward(self, q: Array) -> Pose:
        self._data.qpos[:] = q
        mujoco.mj_kinematics(self._model, self._data)
        X = np.zeros((4, 4))
        X[:3, :3], X[:3, 3], X[3, 3] = self._rotation, self._position, 1.0
        return X

    def gravity(self, q: Array) -> Array:
        model, data, bias = self._model, self._data, np.empty(self._joints)
        data.qpos[:] = q
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_rne(model, data, 0, bias)
        return bias

    def at_rest(self, q: Array) -> Dynamics:
        bias, J = self.statics(q)
        M = np.zeros((self._joints, self._joints))
        mujoco.mj_crb(self._model, self._data)
        mujoco.mj_fullM(self._model, self._data, M)
        return Dynamics(M=M, bias=bias, J=J)

    def statics(self, q: Array) -> tuple[Array, Array]:
        bias, J = self.gravity(q), np.empty((6, self._joints))
        mujoco.mj_jac(self._model, self._data, J[:3], J[3:], self._position, self._tool)
        return bias, J


def _model(arm: ArmModel) -> mujoco.MjModel:
    """Build a MuJoCo model of the links in their DH frames, each link nested in the previous one."""
    k, spec = constants(arm), mujoco.MjSpec()
    spec.option.gravity = np.array([0.0, 0.0, -GRAVITY])
    turns = link_rotations(
        k.theta, k.cos_alpha, k.sin_alpha
    )  # from each frame to the next, with its joint at zero
    body = spec.worldbody.add_body(pos=arm.X_WB[:3, 3].tolist(), quat=_quaternion(arm.X_WB[:3, :3]))
    for i, R in enumerate(turns):
        body = body.add_body(
            pos=[0.0, 0.0, k.d[i]], quat=_quaternion(R),
            mass=k.mass[i], ipos=k.centre[i].tolist(), inertia=k.inertia[i].tolist(), explicitinertial=True,
        )  # fmt: skip
        kind = mujoco.mjtJoint.mjJNT_SLIDE if k.prismatic[i] else mujoco.mjtJoint.mjJNT_HINGE
        z = R[2]  # the joint's axis in its link, where it is the z axis of the frame before
        body.add_joint(type=kind, axis=z.tolist(), pos=(-k.d[i] * z).tolist(), armature=k.armature[i])
    return spec.compile()


def _quaternion(R: Array) -> list[float]:
    quaternion = np.empty(4)
    mujoco.mju_mat2Quat(quaternion, np.ascontiguousarray(R).ravel())
    return quaternion.tolist()
