"""The servo law, the force it feels, and what happens when the computer is late.

Torque = planned inertia x (planned acceleration - velocity error - position error) + planned gravity,
Coriolis and friction torques (Paul 1972). It is computed once a servo period and held for it.
"""

from dataclasses import dataclass, field
from itertools import combinations
from typing import Final

import numpy as np
from numpy.typing import NDArray

from handeye.arm import dynamics
from handeye.arm.kinematics import jacobian
from handeye.arm.model import ArmModel, constants
from handeye.arm.samples import Samples
from handeye.pose import Array
from handeye.units import JIFFY

OMEGA: Final = np.array([25.0, 25.0, 25.0, 40.0, 40.0, 40.0])
"""Natural frequency of each joint's position error, rad/s, critically damped. Torque held over 1/60 s becomes
unstable between 50 and 60 rad/s (measured); at 20 to 30 the arm follows to a fraction of a millimetre. The wrist
has little inertia and would bend under a push of a few pounds, hence more there."""


def torque(
    M: Array, bias: Array, q_des: Array, qd_des: Array, qdd_des: Array, q: Array, qd: Array,
    friction: Array | float = 0.0, *, omega: Array | float = OMEGA,
    free: NDArray[np.bool_] | None = None, exerted: Array | None = None,
) -> Array:  # fmt: skip
    """Drive torques for one period, shape (6,), N m and (joint 3) N.

    Args:
        M, bias: mass matrix (6, 6) and bias torques (6,) of the planned state.
        q_des, qd_des, qdd_des: planned state at the moment q and qd are read.
        friction: torques to overcome friction, if `bias` does not count them.
        free: joints taken off the position servo (see `free_joints`); they get the bias and `exerted` only.
        exerted: torques of a force or load, J^T F with F what the hand is to exert.
    """
    acceleration = qdd_des + 2 * omega * (qd_des - qd) + omega * omega * (q_des - q)
    inertial = (
        M @ acceleration if free is None else np.where(free, 0.0, M @ np.where(free, 0.0, acceleration))
    )
    tau = inertial + bias + friction
    return np.asarray(tau if exerted is None else tau + exerted)


def exerted_torque(arm: ArmModel, q: Array, force: Array) -> Array:
    """J^T F: torques with which the hand exerts a wrench, or carries a load of the opposite weight.

    Args:
        force: force (3,), N, or force and moment (6,), N and N m, at T in world axes.
    """
    J = jacobian(arm, q)
    return np.asarray(np.swapaxes(J[..., : len(force), :], -1, -2) @ force)


def free_joints(J: Array, directions: Array) -> NDArray[np.bool_]:
    """The joints to free so that the hand gives way along `directions`, as a mask of shape (6,).

    For n directions these are the n joints that together best produce motion along them (AIM-177's rule): the
    greatest volume of hand motion per joint motion.

    Args:
        J: Jacobian at T, (6, 6).
        directions: rows of unit twists in world axes, (n, 6), n up to 3; linear ones have zeros at the end.
    """
    motion = np.atleast_2d(directions) @ J
    sets = list(combinations(range(6), len(motion)))
    volume = [abs(np.linalg.det(motion[:, list(joints)])) for joints in sets]
    mask = np.zeros(6, dtype=np.bool_)
    mask[list(sets[int(np.argmax(volume))])] = True
    return mask


def hand_wrench(
    arm: ArmModel, q: Array, qd_before: Array, qd_after: Array, torque: Array, period: float
) -> Array:
    """External force and moment *on* the hand at T in world axes, averaged over a period, shape (6,), N, N m.

    J^-T (M dqd/period + bias - torque): what the drives did not do. No wrist sensor is needed, but joint
    friction that the model does not know is felt as force.

    Args:
        q: joint positions at the beginning of the period.
        qd_before, qd_after: joint rates at its beginning and end.
        torque: what the drives gave throughout.
    """
    qd = (qd_before + qd_after) / 2
    acceleration = (qd_after - qd_before) / period
    needed = dynamics.inverse_dynamics(arm, q, qd, acceleration) + constants(arm).damping * qd
    return np.asarray(np.linalg.solve(jacobian(arm, q).T, needed - torque), dtype=np.float64)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Motion:
    """A motion as the servo runs it: where the joints should be as each period begins, and what they need."""

    q: Array
    """Shape (N, 6), as qd, qdd and bias."""
    qd: Array
    qdd: Array
    """Mean acceleration over the period, as the torque is held over it."""
    M: Array
    """Shape (N, 6, 6)."""
    bias: Array
    """Friction included."""

    def __len__(self) -> int:
        return len(self.q)


def prepare(arm: ArmModel, q_start: Array, samples: Samples, *, period: float = JIFFY) -> Motion:
    """What is computed ahead, so that the working phase needs no trigonometry.

    Args:
        q_start: where the motion begins at rest, shape (6,).
        samples: set-points at the *ends* of periods 1 to N.
    """
    q = np.vstack([q_start, samples.q])[:-1]
    qd = np.vstack([np.zeros(6), samples.qd])
    return Motion(
        q=q, qd=qd[:-1], qdd=np.diff(qd, axis=0) / period,
        M=dynamics.mass_matrix(arm, q), bias=dynamics.bias(arm, q, qd[:-1]),
    )  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Command:
    """What the servo puts out for a period."""

    torque: Array
    brakes: bool


@dataclass(slots=True, kw_only=True)
class Servo:
    """Runs one motion, a period at a time, under the watchdog.

    A period without an answer cuts all drives, sets all brakes and ends the motion for good.
    """

    arm: ArmModel
    motion: Motion
    updates: int = field(default=0, init=False)
    """Torque updates put out."""
    aborted: bool = field(default=False, init=False)

    @property
    def done(self) -> bool:
        """The motion is over, or aborted."""
        return self.aborted or self.updates == len(self.motion)

    def update(self, q: Array, qd: Array) -> Command:
        """Torques for the next period from the joints' positions and rates, within what the drives can do."""
        if self.done:
            return self._rest()
        i, m = self.updates, self.motion
        tau = torque(m.M[i], m.bias[i], m.q[i], m.qd[i], m.qdd[i], q, qd)
        effort = constants(self.arm).effort
        self.updates += 1
        return Command(torque=np.clip(tau, -effort, effort), brakes=False)

    def miss(self) -> Command:
        """The computer did not answer within the period."""
        self.aborted = True
        return self._rest()

    def _rest(self) -> Command:
        return Command(torque=np.zeros(6), brakes=True)
