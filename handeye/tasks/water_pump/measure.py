"""Measurements on the simulator's state; none of them changes it."""

from math import acos, degrees
from typing import Final

import mujoco
import numpy as np

from handeye.cell.truth import Truth
from handeye.pose import Array, Pose, inverse, pose
from handeye.tasks.water_pump.limits import ROTOR_TORQUE, ROTOR_TURN

_SETTLE: Final = 0.2  # s
_RAMP: Final = 1.0  # s over which the torque on the rotor grows to its limit


class Measured:
    """A settled copy of a cell's state, with the measurements that the referee needs."""

    def __init__(self, truth: Truth) -> None:
        """Copy the state, wake everything and let it settle for a moment, so that forces are up to date."""
        self.model, self.data = truth.copy()
        self._start = mujoco.MjData(truth.model)
        mujoco.mj_kinematics(truth.model, self._start)
        mujoco.mj_step(self.model, self.data, round(_SETTLE / self.model.opt.timestep))

    def pose(self, body: str) -> Pose:
        """Pose of a body in W."""
        return _pose(self.data, self.model.body(body).id)

    def relative(self, body: str, other: str) -> Pose:
        """Pose of `body` in the frame of `other`."""
        return inverse(self.pose(other)) @ self.pose(body)

    def place(self, body: str, places: tuple[str, ...]) -> tuple[float, float]:
        """How far a body is from the nearest of the first places of `places`; distance (m) and tilt (rad)."""
        X = self.pose(body)
        firsts = [self._start.xpos[self.model.body(name).id] for name in places]
        return min(float(np.linalg.norm(X[:3, 3] - p)) for p in firsts), tilt(X)

    def gap(self, geom: str, other: str) -> float:
        """Signed distance between two geoms, m; negative when they overlap."""
        ends = np.zeros(6)
        ids = self.model.geom(geom).id, self.model.geom(other).id
        return float(mujoco.mj_geomDistance(self.model, self.data, *ids, 0.5, ends))

    def head_force(self, hole: int) -> float:
        """Force of the screw head of a hole on what lies beneath, N."""
        contact, head = self.data.contact, self.model.geom(f"head{hole}").id
        tree = self.model.body_rootid[self.model.geom_bodyid[contact.geom]]
        bit = self.model.body_rootid[self.model.body("bit").id]
        mine = (contact.geom == head).any(axis=1) & ~(tree == bit).any(axis=1)
        rows = contact.efc_address[mine & (contact.efc_address >= 0)]
        return float(self.data.efc_force[rows].sum())

    def deepest(self) -> tuple[float, str]:
        """The deepest overlap of two bodies, m, and what they are."""
        contact = self.data.contact
        if not len(contact.dist):
            return 0.0, "nothing"
        worst = int(np.argmin(contact.dist))
        names = [self.model.body(self.model.geom_bodyid[g]).name for g in contact.geom[worst]]
        return max(0.0, -float(contact.dist[worst])), " and ".join(names)

    def rotor_torque(self) -> float:
        """Torque that turns the rotor (N m); infinite if the limit does not. Done on a further copy."""
        data = mujoco.MjData(self.model)
        mujoco.mj_copyData(data, self.model, self.data)
        dof, adr = self.model.joint("rotor").dofadr[0], self.model.joint("rotor").qposadr[0]
        start, steps = float(data.qpos[adr]), round(_RAMP / self.model.opt.timestep)
        for i in range(1, steps + 1):
            data.qfrc_applied[dof] = ROTOR_TORQUE * i / steps
            mujoco.mj_step(self.model, data)
            if degrees(abs(data.qpos[adr] - start)) > ROTOR_TURN:
                return ROTOR_TORQUE * i / steps
        return float("inf")


def tilt(X: Pose) -> float:
    """Angle between a frame's z and the vertical, rad."""
    return acos(max(-1.0, min(1.0, float(X[2, 2]))))


def displacement(X: Pose, points: Array) -> float:
    """Longest sideways way (m) of `points` (n, 2) when their part lies at `X` in its place."""
    flat = np.column_stack([points, np.zeros(len(points))])
    moved = flat @ X[:3, :3].T + X[:3, 3]
    return float(np.hypot(*(moved - flat)[:, :2].T).max())


def _pose(data: mujoco.MjData, body: int) -> Pose:
    return pose(data.xmat[body].reshape(3, 3), data.xpos[body])
