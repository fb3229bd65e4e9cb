"""Measures a copy of the simulator's state."""

import copy
from collections.abc import Sequence
from math import acos, degrees

import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.cell.truth import Truth
from handeye.core.pose import Array, Pose, inverse, pose
from handeye.judge.finding import Finding, at_most


class SettledState:
    """A copy of a cell's state, either as the run left it or after it has settled."""

    def __init__(self, truth: Truth, settle: float = 0.0) -> None:
        """Copy the state, wake all bodies, and simulate `settle` seconds."""
        self.model, self.data = truth.copy()
        self.drawn = truth.drawn  # the scene at its start, to compare with
        self._start = mujoco.MjData(truth.drawn)
        mujoco.mj_kinematics(truth.drawn, self._start)
        mujoco.mj_step(self.model, self.data, round(settle / self.model.opt.timestep))

    def pose(self, body: str) -> Pose:
        """Return the pose of a body in W."""
        number = self.model.body(body).id
        return pose(self.data.xmat[number].reshape(3, 3), self.data.xpos[number])

    def relative(self, body: str, other: str) -> Pose:
        """Return the pose of `body` in the frame of `other`."""
        return inverse(self.pose(other)) @ self.pose(body)

    def from_site(self, body: str, site: str) -> float:
        """Return the distance of a body from the initial position of a site (m)."""
        there = self._start.site_xpos[self.drawn.site(site).id]
        return float(np.linalg.norm(self.pose(body)[:3, 3] - there))

    def strayed(self, bodies: Sequence[str], places: Sequence[str]) -> float:
        """Return the greatest distance (m) of one of the bodies in `bodies` from its place. The places are
        the initial positions of the bodies named in `places`.

        Any body may be at any place, but only one body at each place. The nearest pairs of a body and a place are
        assigned first.
        """
        firsts = self._start.xpos[[self.drawn.body(name).id for name in places]]
        now = np.reshape([self.pose(name)[:3, 3] for name in bodies], (-1, 3))
        away = np.linalg.norm(now[:, None] - firsts, axis=-1)
        farthest = 0.0
        for _ in bodies:
            body, place = np.unravel_index(np.argmin(away), away.shape)
            farthest = max(farthest, float(away[body, place]))
            away[body], away[:, place] = np.inf, np.inf
        return farthest

    def turned(self, body: str) -> float:
        """Return the angle between a body's present and initial orientation (rad)."""
        number = self.model.body(body).id
        R = self._start.xmat[number].reshape(3, 3).T @ self.data.xmat[number].reshape(3, 3)
        return acos(max(-1.0, min(1.0, (float(np.trace(R)) - 1) / 2)))

    def speed(self, body: int) -> float:
        """Return an upper bound on the speed of any point of a body (m/s)."""
        model, data, found = self.model, self.data, np.zeros(6)
        mujoco.mj_objectVelocity(model, data, int(mujoco.mjtObj.mjOBJ_BODY), body, found, 0)
        mine = np.flatnonzero(model.geom_bodyid == body)
        away = np.linalg.norm(data.geom_xpos[mine] - data.xipos[body], axis=1) + model.geom_rbound[mine]
        turn, way = np.linalg.norm(found.reshape(2, 3), axis=1)
        return float(way + turn * away.max(initial=0.0))

    def gap(self, geom: str, other: str) -> float:
        """Return the signed distance (m) between two geoms. The distance is negative if the geoms overlap."""
        ends = np.zeros(6)
        ids = self.model.geom(geom).id, self.model.geom(other).id
        return float(mujoco.mj_geomDistance(self.model, self.data, *ids, 0.5, ends))

    def nearest(self, geoms: NDArray[np.intp], others: NDArray[np.intp], most: float) -> float:
        """Return the least distance between two groups of geoms (m). If the distance is more than `most` (m), the
        function returns `most`.
        """
        model, ends = self.model, np.zeros(6)
        between = self.data.geom_xpos[geoms][:, None] - self.data.geom_xpos[others]
        reach = model.geom_rbound[geoms][:, None] + model.geom_rbound[others]
        close = np.argwhere(np.linalg.norm(between, axis=-1) - reach < most)
        pairs = ((int(geoms[i]), int(others[j])) for i, j in close)
        return min(
            (mujoco.mj_geomDistance(model, self.data, *pair, most, ends) for pair in pairs), default=most
        )

    def overlaps(self, solid: NDArray[np.bool_]) -> tuple[NDArray[np.int32], Array]:
        """Return the pairs of overlapping geoms, and the depth of each overlap (m). Both geoms of a pair are `solid`,
        and they belong to different bodies. Contact bits are ignored.
        """
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


def mm(value_m: float, limit_mm: float, subject: str) -> Finding:
    """Return a finding for a length in m with an upper limit in mm."""
    return at_most(value_m * 1e3, limit_mm, "mm", subject)


def deg(value_rad: float, limit_deg: float, subject: str) -> Finding:
    """Return a finding for an angle in rad with an upper limit in degrees."""
    return at_most(degrees(value_rad), limit_deg, "deg", subject)


def tilt(X: Pose) -> float:
    """Return the angle between the z axis of a frame and the vertical (rad)."""
    return acos(max(-1.0, min(1.0, float(X[2, 2]))))
