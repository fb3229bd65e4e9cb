"""Measurements on the simulator's state; none of them changes it."""

from math import acos
from typing import Final

import mujoco
import numpy as np

from handeye.cell.truth import Truth
from handeye.pose import Array, Pose, inverse, pose

_SETTLE: Final = 0.2  # s


class Measured:
    """A settled copy of a cell's state."""

    def __init__(self, truth: Truth) -> None:
        """Copy the state, wake everything and let it settle for a moment, so that forces are up to date."""
        self.model, self.data = truth.copy()
        self._start = mujoco.MjData(truth.model)
        mujoco.mj_kinematics(truth.model, self._start)
        mujoco.mj_step(self.model, self.data, round(_SETTLE / self.model.opt.timestep))

    def pose(self, body: str) -> Pose:
        """Pose of a body in W."""
        number = self.model.body(body).id
        return pose(self.data.xmat[number].reshape(3, 3), self.data.xpos[number])

    def relative(self, body: str, other: str) -> Pose:
        """Pose of `body` in the frame of `other`."""
        return inverse(self.pose(other)) @ self.pose(body)

    def place(self, body: str, places: tuple[str, ...]) -> tuple[float, float]:
        """Distance (m) of a body from the nearest of the first places of `places`, and its tilt (rad)."""
        X = self.pose(body)
        firsts = [self._start.xpos[self.model.body(name).id] for name in places]
        return min(float(np.linalg.norm(X[:3, 3] - p)) for p in firsts), tilt(X)

    def gap(self, geom: str, other: str) -> float:
        """Signed distance between two geoms, m; negative when they overlap."""
        ends = np.zeros(6)
        ids = self.model.geom(geom).id, self.model.geom(other).id
        return float(mujoco.mj_geomDistance(self.model, self.data, *ids, 0.5, ends))

    def deepest(self) -> tuple[float, str]:
        """The deepest overlap of two bodies, m, and what they are."""
        contact = self.data.contact
        if not len(contact.dist):
            return 0.0, "nothing"
        worst = int(np.argmin(contact.dist))
        names = [self.model.body(self.model.geom_bodyid[g]).name for g in contact.geom[worst]]
        return max(0.0, -float(contact.dist[worst])), " and ".join(names)


def tilt(X: Pose) -> float:
    """Angle between a frame's z and the vertical, rad."""
    return acos(max(-1.0, min(1.0, float(X[2, 2]))))


def displacement(X: Pose, points: Array) -> float:
    """Longest sideways way (m) of `points` (n, 2) when their part lies at `X` in its place."""
    flat = np.column_stack([points, np.zeros(len(points))])
    moved = flat @ X[:3, :3].T + X[:3, 3]
    return float(np.hypot(*(moved - flat)[:, :2].T).max())
