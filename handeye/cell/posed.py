"""A scene with its bodies where they once were: for pictures of a recorded run, without simulating it."""

from collections.abc import Mapping, Sequence

import mujoco
import numpy as np

from handeye.tasks.water_pump.pump_world import PumpWorld
from handeye.tasks.water_pump.scene import build
from handeye.tasks.water_pump.threads import SEEN


def posed(world: PumpWorld, poses: Mapping[str, Sequence[float]]) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """A scene to be looked at; it holds no state, since shapes are put where they were and joints are not.

    Args:
        poses: by the names of bodies, place in W (m) and unit quaternion w, x, y, z. Bodies without one stay as drawn,
            and those of a thread that no screw is in stay hidden. Names that the scene does not have are left out.
    """
    model = build(world)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    known = {model.body(number).name: number for number in range(1, model.nbody)}
    for name in known.keys() & poses.keys():
        body, pose = known[name], np.asarray(poses[name], dtype=float)
        data.xpos[body] = pose[:3]
        mujoco.mju_quat2Mat(data.xmat[body], pose[3:])
        if name.startswith("carrier"):
            model.geom_group[model.geom_bodyid == body] = SEEN
    for geom, body in enumerate(model.geom_bodyid):
        R, turn = data.xmat[body].reshape(3, 3), np.empty(9)
        mujoco.mju_quat2Mat(turn, model.geom_quat[geom])
        data.geom_xpos[geom] = data.xpos[body] + R @ model.geom_pos[geom]
        data.geom_xmat[geom] = (R @ turn.reshape(3, 3)).ravel()
    return model, data
