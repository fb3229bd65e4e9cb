"""An arm in MuJoCo, made from the figures of its model alone. Our own computations are compared with it."""

import mujoco
import numpy as np

from handeye.arm.dynamics import GRAVITY
from handeye.arm.model import ArmModel, Joint
from handeye.core.pose import rotation_x, rotation_z


def build(arm: ArmModel, *, damping: bool = True, timestep: float = 1 / 960) -> mujoco.MjModel:
    """The arm with drives that apply torques, and nothing around it."""
    R = arm.X_WB[:3, :3]
    frame = f'pos="{_text(arm.X_WB[:3, 3])}" xyaxes="{_text([*R[:, 0], *R[:, 1]])}"'
    bodies = ""
    for i, joint in enumerate(arm.joints):
        bodies += f"<body {frame}>{_inertial(joint)}{_joint(i, joint, damping)}"
        R = _turn(joint)
        frame = f'pos="0 0 {joint.d}" xyaxes="{_text([*R[:, 0], *R[:, 1]])}"'
    point = f'<inertial pos="0 0 0" mass="{arm.hand.mass}" diaginertia="1e-12 1e-12 1e-12"/>'
    fingers = f'<body pos="0 0 {arm.hand.centre - arm.hand.length}">{point}</body>'
    tool = f'<body {frame}><site name="T"/>{fingers}</body>'
    motors = "".join(f'<motor joint="j{i + 1}"/>' for i in range(len(arm.joints)))
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><compiler angle="radian"/><option gravity="0 0 -{GRAVITY}" timestep="{timestep!r}" '
        f'integrator="implicitfast"/><worldbody>{bodies}{tool}{"</body>" * len(arm.joints)}</worldbody>'
        f"<actuator>{motors}</actuator></mujoco>"
    )


def postures(arm: ArmModel, count: int, seed: int = 1) -> np.ndarray:
    """Joint positions spread over the whole range, shape (count, n); joints that are held are not moved."""
    q = np.random.default_rng(seed).uniform(arm.lower, arm.upper, (count, len(arm.joints)))
    held = [i for i, joint in enumerate(arm.joints) if joint.name in arm.held]
    q[:, held] = [arm.held[arm.joints[i].name] for i in held]
    return q


def _turn(joint: Joint) -> np.ndarray:
    """The fixed transform from the frame of a joint to the next frame, without the joint's own motion."""
    return rotation_z(joint.theta) @ rotation_x(joint.alpha)


def _inertial(joint: Joint) -> str:
    R = _turn(joint)
    inertia = R @ np.diag(joint.inertia) @ R.T
    six = (inertia[0, 0], inertia[1, 1], inertia[2, 2], inertia[0, 1], inertia[0, 2], inertia[1, 2])
    centre = np.array([0, 0, joint.d]) + R @ np.array(joint.centre)
    return f'<inertial pos="{_text(centre)}" mass="{joint.mass}" fullinertia="{_text(six)}"/>'


def _joint(i: int, joint: Joint, damping: bool) -> str:
    kind = "slide" if joint.kind == "prismatic" else "hinge"
    friction = joint.damping if damping else 0.0
    figures = f'armature="{joint.armature}" damping="{friction}"'
    return f'<joint name="j{i + 1}" type="{kind}" axis="0 0 1" {figures}/>'


def _text(numbers: object) -> str:
    return " ".join(repr(float(x)) for x in numbers)  # type: ignore[attr-defined]  # any iterable of numbers
