"""Carriers of tapped holes. A carrier is a body in the base that represents a screw engaged in a thread of the base.

A carrier slides along its axis and turns about it; the pitch couples the two motions. The axis is the axis of the
tapped hole, unless a screw entered at an angle. The carrier of such a screw takes the axis of the screw, so that the
screw does not jump when the carrier replaces it. The thread then straightens the screw as the screw turns; a
cross-threaded screw stays at its angle. The head and shank of a carrier touch other parts only while a screw is in the
carrier's hole. The shank touches only the bores of gasket and top.
"""

from math import exp, pi
from typing import Final

import mujoco
import numpy as np

from handeye.cell.looks import LATENT, SEEN
from handeye.core.errors import BadArgument
from handeye.core.pose import Array, Pose, inverse, pose
from handeye.core.small_arrays import span

STRAIGHTENING: Final = 1.33
"""Angle (rad) through which a screw turns while its lean falls to 1/e. Our choice: after a whole turn, a hundredth of
the lean is left.
"""
_STRAIGHT: Final = 1e-6  # in rad or m: a lean smaller than this is set to zero


class Carriers:
    """The carriers of one scene, in the order of the tapped holes."""

    changes: Final = ("geom_contype", "geom_conaffinity", "geom_group", "body_pos", "body_quat")
    """Fields of the MuJoCo model that are part of the state of the carriers."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        """Find the carriers in the model. All holes are empty."""
        self._model, self._data = model, data
        self.count = sum(model.body(i).name.startswith("carrier") for i in range(model.nbody))
        """Number of carriers."""
        holes = range(self.count)
        self._body = np.array([model.body(f"carrier{k}").id for k in holes])
        self._bodies = span(self._body)
        bases = {int(model.body_parentid[body]) for body in self._body}
        if len(bases) != 1:
            raise BadArgument(f"all tapped holes of a scene must be in one body, not in {len(bases)}")
        (self.base,) = bases  # the body that has the holes
        self._slide = [model.joint(f"thread_slide{k}").id for k in holes]
        self._turn = [model.joint(f"thread_turn{k}").id for k in holes]
        self.head = np.array([model.geom(f"head{k}").id for k in holes])  # their heads, geoms
        self.site = [model.site(f"thread{k}").id for k in holes]  # their frames, sites
        self.mouths: Array = model.body_pos[self._body].copy()
        """Positions (m) of the mouths of the tapped holes, relative to the frame of the base, shape (n, 3)."""
        self._lead = float(model.eq_data[_helix(model, self._slide[0], self._turn[0]), 1])  # m per radian
        self._solid = [np.array([self.head[k], model.geom(f"shank{k}").id]) for k in holes]
        self._bits = [(model.geom_contype[g].copy(), model.geom_conaffinity[g].copy()) for g in self._solid]
        self._looks = [
            np.flatnonzero((model.geom_bodyid == body) & (model.geom_group == LATENT)) for body in self._body
        ]
        for hole in holes:
            self._show(hole, there=False)

    def friction_of(self, hole: int) -> int:
        """Return the index of the degree of freedom in which the thread of a hole has its friction."""
        return int(self._model.jnt_dofadr[self._turn[hole]])

    def depth(self, hole: int) -> float:
        """Return the depth (m) of the point of a screw below the mouth of its hole, along the axis of the screw."""
        return -float(self._data.qpos[self._model.jnt_qposadr[self._slide[hole]]])

    def pose(self, hole: int) -> Pose:
        """Return the pose `X_WS` of the screw in a hole. The origin of frame S is the point of the screw."""
        body = self._body[hole]
        return pose(self._data.xmat[body].reshape(3, 3).copy(), self._data.xpos[body].copy())

    def velocity(self, hole: int) -> Array:
        """Return the angular velocity (rad/s) of the screw in a hole, and the velocity (m/s) of its point, in W,
        shape (6,).
        """
        found = np.zeros(6)
        kind = mujoco.mjtObj.mjOBJ_XBODY
        mujoco.mj_objectVelocity(self._model, self._data, kind, int(self._body[hole]), found, 0)
        return found

    def fill(self, hole: int, X_WS: Pose, rate: float) -> None:
        """Move the carrier of a hole to the pose of a screw. The carrier's axis becomes that of the screw, and the
        carrier turns at `rate` (rad/s).
        """
        model, data = self._model, self._data
        X_WB = pose(data.xmat[self.base].reshape(3, 3), data.xpos[self.base])
        X_BS = inverse(X_WB) @ X_WS
        axis = X_BS[:3, 2]
        along = float(axis @ (X_BS[:3, 3] - self.mouths[hole]))
        model.body_pos[self._body[hole]] = X_BS[:3, 3] - along * axis
        x, y, z = axis
        turn = np.array([1.0 + z, -y, x, 0.0])  # the shortest rotation from z to the axis, a quaternion
        model.body_quat[self._body[hole]] = turn / np.linalg.norm(turn)
        self._move(hole, along, rate)
        self._show(hole, there=True)

    def empty(self, hole: int) -> None:
        """Remove the carrier of a hole from the scene."""
        body = self._body[hole]
        self._model.body_pos[body], self._model.body_quat[body] = self.mouths[hole], (1.0, 0.0, 0.0, 0.0)
        self._move(hole, 0.0, 0.0)
        self._show(hole, there=False)

    def turn_back(self, hole: int, turns: float) -> None:
        """Raise a screw in its thread by `turns` turns, and leave the screw at rest."""
        self._move(hole, 2 * pi * turns * self._lead - self.depth(hole), 0.0)

    def leaning(self) -> list[int]:
        """Return the holes whose carriers lean: the axis of the carrier is not the axis of the hole."""
        places, turns = self._model.body_pos[self._bodies], self._model.body_quat[self._bodies, 1:]
        off = places != self.mouths
        if not (np.count_nonzero(off) or np.count_nonzero(turns)):
            return []
        return np.flatnonzero(off.any(axis=1) | turns.any(axis=1)).tolist()

    def straighten(self, hole: int, seconds: float) -> None:
        """Let the thread straighten a screw while the screw is turned in for `seconds`."""
        model, body, mouth = self._model, self._body[hole], self.mouths[hole]
        place, lean = model.body_pos[body], model.body_quat[body][1:].copy()
        aside = place - mouth
        rate = -float(self._data.qvel[model.jnt_dofadr[self._turn[hole]]])
        left = exp(-max(rate, 0.0) * seconds / STRAIGHTENING)
        if max(np.abs(aside).max(), np.abs(lean).max()) * left < _STRAIGHT:
            left = 0.0
        model.body_pos[body] = mouth + left * aside
        model.body_quat[body, 1:] = left * lean
        mujoco.mju_normalize4(model.body_quat[body])

    def _move(self, hole: int, along: float, rate: float) -> None:
        """Set the two joints of a carrier: its height above the mouth to `along` (m), and its rotation rate to `rate`
        (rad/s). The pitch couples these joints.
        """
        model, data = self._model, self._data
        slide, turn = self._slide[hole], self._turn[hole]
        data.qpos[model.jnt_qposadr[slide]] = along
        data.qpos[model.jnt_qposadr[turn]] = along / self._lead
        data.qvel[model.jnt_dofadr[turn]] = rate
        data.qvel[model.jnt_dofadr[slide]] = rate * self._lead

    def _show(self, hole: int, *, there: bool) -> None:
        """Show the head and shank of the screw in a hole, and let them touch other parts. If `there` is False, hide
        head and shank instead, and let them touch nothing.
        """
        self.meet(hole, self._model, there=there)
        self._model.geom_group[self._looks[hole]] = SEEN if there else LATENT

    def meet(self, hole: int, model: mujoco.MjModel, *, there: bool) -> None:
        """Let the head and shank of the screw in a hole touch other parts in `model`, a model of this scene. If
        `there` is False, let them touch nothing.
        """
        solid = self._solid[hole]
        contype, conaffinity = self._bits[hole] if there else (0, 0)
        model.geom_contype[solid], model.geom_conaffinity[solid] = contype, conaffinity


def _helix(model: mujoco.MjModel, slide: int, turn: int) -> int:
    """Return the number of the equality constraint that couples the slide to the turn of the same screw thread."""
    for e in np.flatnonzero(model.eq_type == mujoco.mjtEq.mjEQ_JOINT):
        if (model.eq_obj1id[e], model.eq_obj2id[e]) == (slide, turn):
            return int(e)
    raise BadArgument(
        f"no constraint of the scene couples {model.joint(slide).name} to {model.joint(turn).name}"
    )
