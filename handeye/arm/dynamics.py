"""Dynamics of an arm: mass matrix, gravity, Coriolis and friction torques.

The equation of motion is M(q) qdd + h(q, qd) + damping qd = tau + J^T F; F is the force on the hand, and M includes
the inertia of the drives. All functions are vectorised over leading dimensions, for example the N ticks of a
motion.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from handeye.arm.kinematics import centripetal, chain, cross, point_jacobian, tool_jacobian
from handeye.arm.model import ArmModel, constants
from handeye.core.pose import Array

GRAVITY = 9.81  # m/s2, along -z of the world


@dataclass(frozen=True, slots=True, kw_only=True)
class _Links:
    """Poses, mass centres, Jacobians and inertias of all links in W at given joint positions."""

    R: Array
    p: Array
    centre: Array  # mass centres, (..., n, 3)
    linear: Array  # mass centre velocities per joint rate, (..., n, n, 3)
    angular: Array  # link angular velocities per joint rate, (..., n, n, 3)
    inertia: Array  # about mass centres in world axes, (..., n, 3, 3)


def mass_matrix(arm: ArmModel, q: Array) -> Array:
    """Return the mass matrix M(q), including the inertia of the drives. `q` of shape (..., n) gives shape (..., n,
    n).
    """
    return _mass_matrix(arm, _links(arm, q))


def gravity(arm: ArmModel, q: Array) -> Array:
    """Return the joint torques that hold the arm up at rest, shape (..., n), in N m or N."""
    return _bias(arm, _links(arm, q), None)


def bias(arm: ArmModel, q: Array, qd: Array) -> Array:
    """Return the torques h(q, qd) + damping qd: gravity, Coriolis and viscous friction torques at joint rates `qd`."""
    return _bias(arm, _links(arm, q), np.asarray(qd, dtype=np.float64))


class Dynamics(NamedTuple):
    """Mass matrix, gravity torques and Jacobian of an arm at given joint positions."""

    M: Array  # mass matrix, (..., n, n)
    bias: Array  # torques that hold or keep moving, (..., n)
    J: Array  # Jacobian at T in world axes, (..., 6, n)

    def at(self, index: int) -> "Dynamics":
        """Return the dynamics at one of N configurations."""
        return Dynamics(M=self.M[index], bias=self.bias[index], J=self.J[index])


def at_rest(arm: ArmModel, q: Array) -> Dynamics:
    """Compute the mass matrix, gravity torques and Jacobian of an arm at rest. The link frames are computed only once.
    `q` has shape (..., n).
    """
    return _dynamics(arm, q, None)


def moving(arm: ArmModel, q: Array, qd: Array) -> Dynamics:
    """Compute the mass matrix, the torques of `bias` and the Jacobian of an arm that moves at joint rates `qd`. The
    link frames are computed only once. `q` and `qd` have shape (..., n).
    """
    return _dynamics(arm, q, qd)


def _dynamics(arm: ArmModel, q: Array, qd: Array | None) -> Dynamics:
    links = _links(arm, q)
    J = tool_jacobian(arm, links.R, links.p)
    return Dynamics(M=_mass_matrix(arm, links), bias=_bias(arm, links, qd), J=J)


def link_weights(arm: ArmModel, q: Array) -> tuple[Array, Array]:
    """Return two arrays of shape (..., i, j). The first is the torque with which joint j carries the weight of link i.
    The second is the part of this torque that is due to the distance between the origin of the link's frame and the
    link's mass centre.
    """
    links, k = _links(arm, q), constants(arm)
    origins, _ = point_jacobian(arm, links.R, links.p, links.p[..., 1:, :])
    of_distance = links.linear - origins * k.carried[:, :, None]
    scale = GRAVITY * k.mass[:, None]
    return links.linear[..., 2] * scale, of_distance[..., 2] * scale


def _mass_matrix(arm: ArmModel, links: _Links) -> Array:
    k, linear, angular = constants(arm), links.linear, links.angular
    M = (linear * k.mass[:, None, None]) @ np.swapaxes(linear, -1, -2)
    M += angular @ links.inertia @ np.swapaxes(angular, -1, -2)
    return np.asarray(M.sum(axis=-3) + np.diag(k.armature))


def _links(arm: ArmModel, q: Array) -> _Links:
    k = constants(arm)
    R, p = chain(arm, q)
    rotation = R[..., 1:, :, :]
    centre = p[..., 1:, :] + (rotation @ k.centre[..., None])[..., 0]
    linear, angular = point_jacobian(arm, R, p, centre)
    carried = k.carried[:, :, None]  # a joint moves its own link and those after it
    return _Links(
        R=R, p=p, centre=centre, linear=linear * carried, angular=angular[..., None, :, :] * carried,
        inertia=(rotation * k.inertia[:, None, :]) @ np.swapaxes(rotation, -1, -2),
    )  # fmt: skip


def _bias(arm: ArmModel, links: _Links, qd: Array | None) -> Array:
    k, acceleration = constants(arm), np.zeros_like(links.centre)
    acceleration[..., 2] = GRAVITY
    if qd is None:
        return _work(links.linear, acceleration * k.mass[:, None])
    own = np.arange(qd.shape[-1])
    bend, spin = centripetal(arm, links.R, links.p, links.centre, links.linear, own, qd)
    omega = (links.angular * qd[..., None, :, None]).sum(axis=-2)
    momentum = (links.inertia @ omega[..., None])[..., 0]
    turning = (links.inertia @ spin[..., None])[..., 0] + cross(omega, momentum)
    forces = _work(links.linear, (acceleration + bend) * k.mass[:, None])
    return np.asarray(forces + _work(links.angular, turning) + k.damping * qd)


def _work(rates: Array, efforts: Array) -> Array:
    """Return the joint torques that do the same work as the given forces or moments on all links. `efforts`, shape
    (..., n, 3), are the forces or moments, and `rates` are the velocities of the links per joint rate.
    """
    return np.asarray((rates @ efforts[..., None])[..., 0].sum(axis=-2))
