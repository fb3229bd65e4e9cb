"""The arm of a world, with nothing around it. It is released where it is parked, and its hand may be pushed."""

from dataclasses import dataclass

import mujoco
import numpy as np

from handeye.arm.robots.stanford import STANFORD
from handeye.cell.arm import SimulatedArm
from handeye.cell.compiled_arm import CompiledArm
from handeye.cell.hand import SimulatedHand
from handeye.cell.simulated import SimulatedCell
from handeye.core.pose import Array
from handeye.execution.drive import ArmDrive
from handeye.execution.friction_measurement import measure_joints
from handeye.execution.state import DriveState
from handeye.tasks.stanford_cell.arm import ARM, add_arm
from handeye.tasks.stanford_cell.dimensions import PARK
from handeye.tasks.water_pump.world.pump_world import PumpWorld


def arm_alone(world: PumpWorld) -> SimulatedCell:
    """The cell of a world, with only its arm and hand."""
    spec = mujoco.MjSpec()
    spec.option.timestep = 1 / 960
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    add_arm(spec, world)
    model = spec.compile()
    data, noise = mujoco.MjData(model), world.generator("sensors")
    arm = SimulatedArm(model, data, ARM, arm=STANFORD, posture=PARK, errors=world.arm, noise=noise)
    hand = SimulatedHand(model, data, ARM, hand=STANFORD.hand, errors=world.hand, noise=noise)
    return SimulatedCell(model, data, arm=arm, hand=hand, noise=noise)


@dataclass(frozen=True, slots=True, kw_only=True)
class Drift:
    """How far a released arm has moved."""

    joints: Array
    """rad, m, shape (6,)"""
    hand: float
    """m"""


def let_go(world: PumpWorld, seconds: float, push: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Drift:
    """Let go of an arm that has weighed itself, while its hand is pushed (N, axes of W), and see how far it goes."""
    cell = arm_alone(world)
    data, arm, state = cell.truth.data, cell.arm, DriveState.holding(cell.devices.sense(), STANFORD)
    state.links = measure_joints(cell.devices, STANFORD, state, arithmetic=CompiledArm).links
    hand = data.site(f"{ARM}tool").xpos.copy()
    data.xfrc_applied[arm.last_link, :3] = push
    ArmDrive(cell=cell.devices, arm=STANFORD, state=state, arithmetic=CompiledArm).float(seconds)
    away = np.linalg.norm(data.site(f"{ARM}tool").xpos - hand)
    return Drift(joints=np.abs(data.qpos[arm.qpos] - PARK), hand=float(away))
