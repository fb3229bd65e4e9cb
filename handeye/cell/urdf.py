"""Writes an arm as URDF (unified robot description format), for other programs.

The links, their masses and their shapes are those of the arm's MuJoCo model. Limits, torques and rates of the joints
are those of the `ArmModel`.
"""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Final
from xml.etree import ElementTree as ET

import mujoco
import numpy as np

from handeye.arm.model import ArmModel, Joint
from handeye.core.pose import Array, Pose

TABLE: Final = "table"  # link of the frame W
TOOL: Final = "tool"  # link of the frame T
_LOADED: Final = {"fusestatic": "false", "discardvisual": "false", "strippath": "false"}
"""Settings for MuJoCo. Without these settings, MuJoCo would drop the shapes and the links `table` and `tool`."""
_HINGE: Final = int(mujoco.mjtJoint.mjJNT_HINGE)


def urdf(arm: ArmModel, scene: Path) -> bytes:
    """Return the URDF of an arm whose MuJoCo model is the file `scene`. As in the model, the joints are called `j1`,
    `j2`, ..., and the fingers `finger_a` and `finger_b`. The same arm gives the same bytes.
    """
    model = mujoco.MjModel.from_xml_path(str(scene))
    root = ET.Element("robot", name=arm.name)
    ET.SubElement(ET.SubElement(root, "mujoco"), "compiler", _LOADED)
    ET.SubElement(root, "link", name=TABLE)
    for body in range(1, model.nbody):
        _link(root, model, body)
    ET.SubElement(root, "link", name=TOOL)
    _joined(root, "mount", "fixed", TABLE, model.body(1).name, arm.X_WB)
    for body in range(2, model.nbody):
        _joint(root, model, arm, body)
    last = model.body(f"link{len(arm.joints)}")
    _joined(root, TOOL, "fixed", last.name, TOOL, _shift((0.0, 0.0, arm.hand.length)))
    ET.indent(root)
    written: bytes = ET.tostring(root, encoding="utf-8", xml_declaration=True)
    return written + b"\n"


def _link(root: ET.Element, model: mujoco.MjModel, body: int) -> None:
    link = ET.SubElement(root, "link", name=model.body(body).name)
    if model.body_mass[body] > 0:
        inertial = ET.SubElement(link, "inertial")
        _origin(inertial, _placed(model.body_ipos[body], model.body_iquat[body]))
        ET.SubElement(inertial, "mass", value=_text(model.body_mass[body]))
        xx, yy, zz = map(_text, model.body_inertia[body])
        ET.SubElement(inertial, "inertia", ixx=xx, iyy=yy, izz=zz, ixy="0", ixz="0", iyz="0")
    for geom in np.flatnonzero(model.geom_bodyid == body).tolist():
        _shape(link, "visual", model, geom)
        if model.geom_contype[geom] or model.geom_conaffinity[geom]:
            _shape(link, "collision", model, geom)


def _shape(link: ET.Element, kind: str, model: mujoco.MjModel, geom: int) -> None:
    shape = ET.SubElement(link, kind)
    _origin(shape, _placed(model.geom_pos[geom], model.geom_quat[geom]))
    size, geometry = model.geom_size[geom].tolist(), ET.SubElement(shape, "geometry")
    match mujoco.mjtGeom(int(model.geom_type[geom])):
        case mujoco.mjtGeom.mjGEOM_BOX:
            ET.SubElement(geometry, "box", size=_texts([2 * half for half in size]))
        case mujoco.mjtGeom.mjGEOM_CYLINDER:
            ET.SubElement(geometry, "cylinder", radius=_text(size[0]), length=_text(2 * size[1]))
        case mujoco.mjtGeom.mjGEOM_SPHERE:
            ET.SubElement(geometry, "sphere", radius=_text(size[0]))
        case other:
            raise AssertionError(other)
    material = int(model.geom_matid[geom])
    if kind == "visual" and material >= 0:
        colour = ET.SubElement(shape, "material", name=model.mat(material).name)
        ET.SubElement(colour, "color", rgba=_texts(np.round(model.mat_rgba[material], 4).tolist()))


def _joint(root: ET.Element, model: mujoco.MjModel, arm: ArmModel, body: int) -> None:
    """Write the joint between a link and its parent."""
    index = int(model.body_jntadr[body])
    joint = model.joint(index)
    kind = "revolute" if model.jnt_type[index] == _HINGE else "prismatic"
    parent = model.body(int(model.body_parentid[body])).name
    placed = _placed(model.body_pos[body], model.body_quat[body])
    found = _joined(root, joint.name, kind, parent, model.body(body).name, placed)
    ET.SubElement(found, "axis", xyz=_texts(model.jnt_axis[index].tolist()))
    drawn = _drawn(arm, joint.name)
    lower, upper = (drawn.lower, drawn.upper) if drawn else model.jnt_range[index].tolist()
    effort, speed = (drawn.effort, drawn.speed) if drawn else (arm.hand.grip, arm.hand.gap_speed / 2)
    ET.SubElement(
        found, "limit", lower=_text(lower), upper=_text(upper), effort=_text(effort), velocity=_text(speed)
    )
    damping = float(model.dof_damping[model.jnt_dofadr[index]])
    ET.SubElement(found, "dynamics", damping=_text(damping), friction="0")
    if joint.name == "finger_b":
        ET.SubElement(found, "mimic", joint="finger_a", multiplier="1", offset="0")


def _drawn(arm: ArmModel, name: str) -> Joint | None:
    """Return the arm joint with a given name in the model: `j1`, `j2`, and so on. Returns None for a finger."""
    return arm.joints[int(name[1:]) - 1] if name[1:].isdigit() else None


def _joined(root: ET.Element, name: str, kind: str, parent: str, child: str, placed: Pose) -> ET.Element:
    joint = ET.SubElement(root, "joint", name=name, type=kind)
    _origin(joint, placed)
    ET.SubElement(joint, "parent", link=parent)
    ET.SubElement(joint, "child", link=child)
    return joint


def _placed(position: Array, quaternion: Array) -> Pose:
    matrix, X = np.empty(9), np.eye(4)
    mujoco.mju_quat2Mat(matrix, quaternion)
    X[:3, :3], X[:3, 3] = matrix.reshape(3, 3), position
    return X


def _shift(p: Sequence[float]) -> Pose:
    X = np.eye(4)
    X[:3, 3] = p
    return X


def _origin(element: ET.Element, X: Pose) -> None:
    ET.SubElement(element, "origin", xyz=_texts(X[:3, 3].tolist()), rpy=_texts(roll_pitch_yaw(X[:3, :3])))


def roll_pitch_yaw(R: Array) -> tuple[float, float, float]:
    """Return the roll, the pitch and the yaw (rad) for which `R = Rz(yaw) Ry(pitch) Rx(roll)`. If the pitch is a right
    angle, the yaw is 0.
    """
    pitch = math.atan2(-R[2, 0], math.hypot(R[0, 0], R[1, 0]))
    if math.hypot(R[0, 0], R[1, 0]) < 1e-9:
        return math.atan2(math.copysign(1.0, pitch) * R[0, 1], R[1, 1]), pitch, 0.0
    return math.atan2(R[2, 1], R[2, 2]), pitch, math.atan2(R[1, 0], R[0, 0])


def _text(number: float) -> str:
    """Write a number with 12 significant digits."""
    return f"{number + 0.0:.12g}"


def _texts(numbers: Sequence[float]) -> str:
    return " ".join(map(_text, numbers))
