"""A scene with its bodies at recorded poses. Pictures of a recorded run are drawn from this scene, without
simulation.
"""

import copy
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Final

import mujoco
import numpy as np

from handeye.cell.looks import LATENT, SEEN
from handeye.cell.truth import Truth
from handeye.core.pose import Array

TURNS: Final = "turns/"
"""Some bodies turn in place, such as the hands of a clock. For each such body, the scene has a numeric field with the
period (s). The name of the field begins with this prefix.
"""


def hand_poses(model: mujoco.MjModel, time: float) -> dict[str, Array]:
    """Return the pose of each clock hand at a time (s) of the cell's clock. The keys are the names of the bodies;
    each pose has the form that `drawn_poses` describes.
    """
    return {name: rows[0] for name, rows in drawn_poses(model, _turns(model), np.array([time])).items()}


def drawn_poses(model: mujoco.MjModel, names: Iterable[str], times: Array) -> dict[str, Array]:
    """Return the poses, in W, of bodies that no force moves: bodies at a fixed place, and clock hands. `times` are in
    s on the cell's clock. The keys are the names of the bodies; the poses of each body have shape (n, 7).

    A pose is a position (m), then a unit quaternion w, x, y, z. Clock hands turn clockwise about their z axis, and
    point to twelve at time 0.
    """
    turns, found = _turns(model), {}
    for name in names:
        body, half = model.body(name), -np.pi * times * turns.get(name, 0.0)
        w, x, y, z = body.quat
        c, s = np.cos(half), np.sin(half)
        turned = [w * c - z * s, x * c + y * s, y * c - x * s, z * c + w * s]
        found[name] = np.column_stack([np.tile(body.pos, (len(times), 1)), *turned])
    return found


def _turns(model: mujoco.MjModel) -> dict[str, float]:
    """Return the rotation rate (turns per second) of each rotating body. The keys are the names of the bodies."""
    told: list[Any] = [model.numeric(number) for number in range(model.nnumeric)]
    hands = [figure for figure in told if figure.name.startswith(TURNS)]
    return {figure.name.removeprefix(TURNS): 1 / float(figure.data[0]) for figure in hands}


Posed = tuple[mujoco.MjModel, mujoco.MjData]  # a scene, and the state in which it is shown


def posed(scene: mujoco.MjModel, poses: Mapping[str, Sequence[float]], time: float = 0.0) -> Posed:
    """Make a copy of a scene with its bodies at given poses. The copy is only for viewing: its joint positions stay as
    in the model, and do not fit the poses.

    `poses` maps the name of a body to the body's pose: a position in W (m) and a unit quaternion w, x, y, z. A body
    without a pose stays as in the model, and bodies that appear only after an event stay hidden. Clock hands show
    `time` (s).
    """
    model = copy.copy(scene)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    stood: dict[str, Sequence[float] | Array] = {**poses, **hand_poses(scene, time)}
    known = {model.body(number).name: number for number in range(1, model.nbody)}
    for name in known.keys() & stood.keys():
        body, pose = known[name], np.asarray(stood[name], dtype=float)
        data.xpos[body] = pose[:3]
        mujoco.mju_quat2Mat(data.xmat[body], pose[3:])
        mine = model.geom_bodyid == body
        if (model.geom_group[mine] == LATENT).any():  # the event that some shapes wait for has happened
            model.geom_group[mine] = SEEN
    for geom, body in enumerate(model.geom_bodyid):
        R, turn = data.xmat[body].reshape(3, 3), np.empty(9)
        mujoco.mju_quat2Mat(turn, model.geom_quat[geom])
        data.geom_xpos[geom] = data.xpos[body] + R @ model.geom_pos[geom]
        data.geom_xmat[geom] = (R @ turn.reshape(3, 3)).ravel()
    return model, data


def standing(scene: mujoco.MjModel, qpos: Array) -> Posed:
    """Return a scene with joint positions `qpos`, in the order of the simulator."""
    data = mujoco.MjData(scene)
    data.qpos[:] = qpos
    mujoco.mj_forward(scene, data)
    return scene, data


def as_it_stands(scene: mujoco.MjModel, truth: Truth) -> Posed:
    """Make a copy of `scene` in which each body has the pose of the same body in a cell. The copy is used for pictures
    of a cell whose own scene has fewer shapes than `scene`.
    """
    model, data = truth.model, truth.data
    waiting = {*model.geom_bodyid[model.geom_group == LATENT].tolist()}
    there = [body for body in range(1, model.nbody) if body not in waiting]
    poses = {model.body(body).name: (*data.xpos[body], *data.xquat[body]) for body in there}
    return posed(scene, poses, data.time)
