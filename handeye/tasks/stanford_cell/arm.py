"""Builds the simulated Stanford arm on its riser, with the arm errors of a world."""

import math
from typing import Final

import mujoco
import numpy as np

from handeye.arm.robots.stanford import STANFORD
from handeye.cell.device_errors import ArmBuild
from handeye.core.pose import Array, yaw
from handeye.core.resources import scenes
from handeye.tasks.stanford_cell.arm_world import ArmWorld

ARM: Final = "stanford/"  # prefix of all names of the arm


def add_arm(spec: mujoco.MjSpec, world: ArmWorld) -> None:
    """Add the arm on its riser, with the arm errors and the pad friction of the world."""
    arm = mujoco.MjSpec.from_file(str(scenes() / "stanford_arm" / "stanford.xml"))
    _differ(arm, world.arm_build)
    arm.geom("lamp").pos += world.lamp  # in the frame of link 6, whose axes are those of the hand
    for pad in (arm.geom("pad_a"), arm.geom("pad_b")):
        pad.friction[0] *= world.friction["pad"]
    turn = yaw(STANFORD.X_WB)
    frame = spec.worldbody.add_frame(
        pos=STANFORD.X_WB[:3, 3].tolist(), quat=[math.cos(turn / 2), 0.0, 0.0, math.sin(turn / 2)]
    )
    spec.attach(arm, frame=frame, prefix=ARM)


def _differ(arm: mujoco.MjSpec, build: ArmBuild) -> None:
    """Add the errors of a world to an arm that was built as designed."""
    for i, friction in enumerate(build.friction):
        link, joint = arm.body(f"link{i + 1}"), arm.joint(f"j{i + 1}")
        link.mass *= build.link_mass[i]
        moments: Array = link.inertia * build.link_mass[i]
        greatest = int(np.argmax(moments))  # rounding must not make it exceed the sum of the others
        moments[greatest] = min(moments[greatest], np.delete(moments, greatest).sum())
        link.inertia = moments
        link.ipos *= build.mass_centre[i]
        joint.armature *= build.armature[i]
        joint.damping *= build.damping[i]
        joint.frictionloss = friction
    for tip in (arm.body("finger_a"), arm.body("finger_b"), arm.site("tool")):
        tip.pos[2] += build.hand_length
