"""Stores the state of a simulation in its scene, so that the scene's files show every body where it was then."""

from collections.abc import Mapping
from typing import Final

import mujoco
import numpy as np

from handeye.core.pose import Pose, inverse, pose

FREE: Final = mujoco.mjtJoint.mjJNT_FREE
HINGE: Final = mujoco.mjtJoint.mjJNT_HINGE


def add_keyframe(spec: mujoco.MjSpec, name: str, data: mujoco.MjData, elsewhere: Mapping[str, Pose]) -> None:
    """Set the bodies of a scene, which may lack some of the simulation's bodies, as they are in the simulation, and
    store them as the scene's last keyframe.

    The initial state of the scene is set as well, so that a viewer that loads no keyframe shows the same.
    `elsewhere` has the poses `X_WP` of free bodies that are to be at rest elsewhere than in the simulation.
    """
    for body in spec.bodies:
        if body.joints:
            _stand(body, data, elsewhere.get(body.name))
    model = spec.compile()
    spec.add_key(
        name=name,
        time=data.time,
        qpos=model.qpos0.tolist(),
        qvel=_rates(model, data, elsewhere),
        act=data.act.tolist(),
        ctrl=[data.actuator(model.actuator(number).name).ctrl[0] for number in range(model.nu)],
    )


def body_pose(data: mujoco.MjData, name: str) -> Pose:
    """The pose `X_WP` of a body."""
    body = data.body(name)
    return pose(body.xmat.reshape(3, 3).copy(), body.xpos.copy())


def _stand(body: mujoco.MjsBody, data: mujoco.MjData, elsewhere: Pose | None) -> None:
    """Set the pose of a body with joints; the present positions of its joints become their initial positions."""
    X_WP = body_pose(data, body.name) if elsewhere is None else elsewhere
    X = inverse(body_pose(data, body.parent.name)) @ X_WP
    body.pos = X[:3, 3]
    mujoco.mju_mat2Quat(body.quat, X[:3, :3].ravel())
    for joint in body.joints:
        if joint.type != FREE:
            at = float(data.joint(joint.name).qpos[0])
            joint.ref = np.degrees(at) if joint.type == HINGE and joint.compiler.degree else at


def _rates(model: mujoco.MjModel, data: mujoco.MjData, elsewhere: Mapping[str, Pose]) -> list[float]:
    rates: list[float] = []
    for number in range(model.njnt):
        joint = data.joint(model.joint(number).name)
        resting = model.body(model.jnt_bodyid[number]).name in elsewhere
        rates += [0.0] * len(joint.qvel) if resting else joint.qvel.tolist()
    return rates
