"""A robot alone over a plate, simulated by MuJoCo."""

from dataclasses import replace

import mujoco
import numpy as np
from robots import ROBOTS

from handeye.arm.ik import solve
from handeye.arm.model import ArmModel, constants
from handeye.cell.arm import SimulatedArm
from handeye.cell.compiled_arm import CompiledArm
from handeye.cell.device_errors import ArmErrors
from handeye.cell.simulated import SimulatedCell
from handeye.core.pose import Array, hand
from handeye.execution.drive import ArmDrive
from handeye.execution.servo import ServoPeriod
from handeye.execution.state import DriveState

TOP = 0.1
"""Height of a plate on the table, m."""
START = hand(0.635, 0.95, 0.2, np.pi / 2, np.pi / 2, 0.0)


def converted(arm: ArmModel) -> ArmErrors:
    """Sensors and drives that are perfect except for the converters of the period: 12 bits for readings, 8 bits for
    torques.
    """
    k = constants(arm)
    return replace(
        ArmErrors.none(len(arm.joints)),
        pot_step=(k.upper - k.lower) / 2**12, tachometer_step=2 * k.speed / 2**12, torque_step=2 * k.effort / 2**8,
    )  # fmt: skip


class Bench:
    """A robot over a plate, its hand at `START`."""

    def __init__(self, name: str, friction: tuple[float, ...] = (), errors: ArmErrors | None = None) -> None:
        """Make a robot with this Coulomb friction in its joints (N m, N), by default without friction, and with these
        errors.
        """
        robot = ROBOTS[name]
        self.arm = robot.arm
        spec, scene = mujoco.MjSpec.from_string(robot.mjcf), mujoco.MjSpec()
        scene.option.timestep = self.arm.servo.period / 16
        scene.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        scene.worldbody.add_geom(
            type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.5, 0.5, TOP / 2], pos=[0.635, 0.95, TOP / 2],
            contype=1, conaffinity=2,
        )  # fmt: skip
        quat = np.zeros(4)
        mujoco.mju_mat2Quat(quat, robot.X_WM[:3, :3].ravel())
        scene.attach(spec, frame=scene.worldbody.add_frame(pos=robot.X_WM[:3, 3], quat=quat), prefix="it/")
        for number, coulomb in enumerate(friction, 1):
            scene.joint(f"it/j{number}").frictionloss = coulomb
        model = scene.compile()
        self.data, noise = mujoco.MjData(model), np.random.default_rng(0)
        q = solve(self.arm, START, self.arm.middle).q
        assert q is not None
        arm = SimulatedArm(
            model,
            self.data,
            "it/",
            arm=self.arm,
            posture=q,
            errors=errors or ArmErrors.none(len(q)),
            noise=noise,
        )
        cell = SimulatedCell(model, self.data, arm=arm, noise=noise)
        self.link = model.joint(f"it/j{len(q)}").bodyid[0]
        state = DriveState.holding(cell.devices.sense(), self.arm)
        self.ticks: list[float] = []
        self.drive = ArmDrive(
            cell=cell.devices, arm=self.arm, state=state, watch=self._watch, arithmetic=CompiledArm
        )

    def _watch(self, period: ServoPeriod) -> None:
        self.ticks.append(period.sensed.time)

    @property
    def tool(self) -> Array:
        """True position of the tool centre point, m."""
        return np.array(self.data.site("it/tool").xpos)
