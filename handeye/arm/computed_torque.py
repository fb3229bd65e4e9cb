"""Computed-torque control: the servo law, its precomputation for a motion, and the estimate of the external force
from the torque residual.

Torque = planned inertia x (planned acceleration - velocity error - position error) + planned gravity, Coriolis and
friction torques (Paul 1972). The torque is computed once in each servo period and held for that period.
"""

from dataclasses import dataclass

import numpy as np

from handeye.arm.dynamics import Dynamics, moving
from handeye.arm.model import ArmModel, constants
from handeye.arm.samples import Samples
from handeye.core.pose import Array


def torque(
    arm: ArmModel, M: Array, bias: Array, q_des: Array, qd_des: Array, qdd_des: Array, q: Array, qd: Array,
    exerted: Array | float = 0.0,
) -> Array:  # fmt: skip
    """Compute the drive torques for one servo period, shape (n,), in N m (in N for prismatic joints).

    `M`, shape (n, n), and `bias`, shape (n,), belong to the planned state at the moment when `q` and `qd` are read.
    `exerted` is J^T F, where F is a force that the hand is to exert or a load that it carries.
    """
    k = constants(arm)
    acceleration = qdd_des + k.rate_gain * (qd_des - qd) + k.position_gain * (q_des - q)
    return np.asarray(M @ acceleration + bias + exerted)


def felt_wrench(
    M: Array, bias: Array, J: Array, tau: Array, qd_before: Array, qd_after: Array, period: float
) -> Array:
    """Estimate the external force and moment on the hand during a servo period of length `period` (s), in which
    the torques are `tau`. The estimate is not tared. For the method, see `external_wrench`.
    """
    acceleration = (qd_after - qd_before) / period
    return external_wrench(J, M @ acceleration + bias - tau)


def external_wrench(J: Array, unexplained: Array) -> Array:
    """Estimate the external wrench on the hand that best explains a torque residual: force and moment at T in world
    axes, shape (6,), in N and N m.

    The residual `unexplained` is M qdd + bias - torque, shape (n,). The estimate needs no wrist sensor. But if the
    model does not include all joint friction, the rest of the friction appears as force. An arm with fewer than six
    joints senses only the components that its joints carry.
    """
    if J.shape[0] == J.shape[1]:
        return np.asarray(np.linalg.solve(J.T, unexplained), dtype=np.float64)
    return np.asarray(np.linalg.lstsq(J.T, unexplained, rcond=None)[0], dtype=np.float64)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Motion:
    """A precomputed motion: state, mass matrix and torques at the start of each servo period.

    `q`, `qd` and `qdd` have shape (N, n). `qdd` is the mean acceleration over the period, and the bias torques of
    `dynamics` include friction.
    """

    q: Array
    qd: Array
    qdd: Array
    dynamics: Dynamics

    def __len__(self) -> int:
        return len(self.q)


def prepare(arm: ArmModel, q_start: Array, samples: Samples) -> Motion:
    """Compute in advance what the servo needs for a motion that begins at rest. During the motion, the servo then
    computes no trigonometric functions.
    """
    q = np.vstack([q_start, samples.q])[:-1]
    qd = np.vstack([np.zeros(len(q_start)), samples.qd])
    return Motion(
        q=q, qd=qd[:-1], qdd=np.diff(qd, axis=0) / arm.servo.period, dynamics=moving(arm, q, qd[:-1])
    )
