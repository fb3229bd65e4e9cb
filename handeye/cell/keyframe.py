"""Stores the state of a simulation in its scene, so that the files of the scene show where every body was."""

from collections.abc import Mapping
from typing import Final

import mujoco
import numpy as np

from handeye.core.pose import Pose, inverse, pose

FREE: Final = mujoco.mjtJoint.mjJNT_FREE
HINGE: Final = mujoco.mjtJoint.mjJNT_HINGE


def add_keyframe(spec: mujoco.MjSpec, name: str, data: mujoco.MjData, elsewhere: Mapping[str, Pose]) -> None:
    """Give the bodies of a scene the poses that they have in the simulation, and store the state of the bodies as the
    last keyframe of the scene. The scene may lack some bodies of the simulation.

    The initial state of the scene is set as well, so that a viewer that loads no keyframe shows the same state.
    `elsewhere` gives new poses `X_WP` for free bodies that should not rest at their places in the simulation.
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
    """Return the pose `X_WP` of a body."""
    body = data.body(name)
    return pose(body.xmat.reshape(3, 3).copy(), body.xpos.copy())


def _stand(body: mujoco.MjsBody, data: mujoco.MjData, elsewhere: Pose | None) -> None:
    """Set the pose of a body that has joints. The present positions of the body's joints become their initial
    positions.
    """
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
