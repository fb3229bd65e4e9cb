"""Measurements on the simulator's state; none of them changes it."""

import copy
from collections.abc import Sequence
from math import acos

import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.cell.truth import Truth
from handeye.core.pose import Array, Pose, inverse, pose


class SettledState:
    """A copy of a cell's state: as it was left, or settled."""

    def __init__(self, truth: Truth, settle: float = 0.0) -> None:
        """Copy the state, wake everything and let some time pass (s)."""
        self.model, self.data = truth.copy()
        self._start = mujoco.MjData(truth.model)
        mujoco.mj_kinematics(truth.model, self._start)
        mujoco.mj_step(self.model, self.data, round(settle / self.model.opt.timestep))

    def pose(self, body: str) -> Pose:
        """Pose of a body in W."""
        number = self.model.body(body).id
        return pose(self.data.xmat[number].reshape(3, 3), self.data.xpos[number])

    def relative(self, body: str, other: str) -> Pose:
        """Pose of `body` in the frame of `other`."""
        return inverse(self.pose(other)) @ self.pose(body)

    def strayed(self, bodies: Sequence[str], places: Sequence[str]) -> float:
        """Greatest distance of the bodies from their places, m; a place is where a body of `places` was at first.

        Any body may have any place, but each place takes one only: nearest first.
        """
        firsts = self._start.xpos[[self.model.body(name).id for name in places]]
        now = np.reshape([self.pose(name)[:3, 3] for name in bodies], (-1, 3))
        away = np.linalg.norm(now[:, None] - firsts, axis=-1)
        farthest = 0.0
        for _ in bodies:
            body, place = np.unravel_index(np.argmin(away), away.shape)
            farthest = max(farthest, float(away[body, place]))
            away[body], away[:, place] = np.inf, np.inf
        return farthest

    def turned(self, body: str) -> float:
        """Angle of a body from its first orientation, rad."""
        number = self.model.body(body).id
        R = self._start.xmat[number].reshape(3, 3).T @ self.data.xmat[number].reshape(3, 3)
        return acos(max(-1.0, min(1.0, (float(np.trace(R)) - 1) / 2)))

    def gap(self, geom: str, other: str) -> float:
        """Signed distance between two geoms, m; negative when they overlap."""
        ends = np.zeros(6)
        ids = self.model.geom(geom).id, self.model.geom(other).id
        return float(mujoco.mj_geomDistance(self.model, self.data, *ids, 0.5, ends))

    def nearest(self, geoms: NDArray[np.intp], others: NDArray[np.intp], most: float) -> float:
        """Least distance between two groups of geoms, m; what is farther apart counts as `most`."""
        model, ends = self.model, np.zeros(6)
        between = self.data.geom_xpos[geoms][:, None] - self.data.geom_xpos[others]
        reach = model.geom_rbound[geoms][:, None] + model.geom_rbound[others]
        close = np.argwhere(np.linalg.norm(between, axis=-1) - reach < most)
        pairs = ((int(geoms[i]), int(others[j])) for i, j in close)
        return min(
            (mujoco.mj_geomDistance(model, self.data, *pair, most, ends) for pair in pairs), default=most
        )

    def overlaps(self, solid: NDArray[np.bool_]) -> tuple[NDArray[np.int32], Array]:
        """Pairs of `solid` geoms of different bodies that overlap, whatever contact bits they have, and how deep, m."""
        model = copy.deepcopy(self.model)
        for field in (model.geom_contype, model.geom_conaffinity):
            field[:] = solid
        model.body_contype[:] = model.body_conaffinity[:] = 1
        data = mujoco.MjData(model)
        data.qpos[:] = self.data.qpos
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_collision(model, data)
        return data.contact.geom.copy(), np.maximum(0.0, -data.contact.dist)


def tilt(X: Pose) -> float:
    """Angle between a frame's z and the vertical, rad."""
    return acos(max(-1.0, min(1.0, float(X[2, 2]))))
