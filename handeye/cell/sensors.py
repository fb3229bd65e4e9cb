"""Sensors: what the interface reads, with the errors of this world's potentiometers and switches."""

import mujoco
import numpy as np

from handeye.cell.drives import HandDrive, SimulatedArm
from handeye.ports.workcell import Sensed
from handeye.tasks.water_pump.pump_world import PumpWorld
from handeye.tasks.water_pump.threads import Threads


class Sensors:
    """Reads the interface once per tick."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, world: PumpWorld) -> None:
        self._data, self._world = data, world
        self.rng = world.generator("sensors")
        """Source of the noise."""
        self._switches = [int(model.sensor(f"stanford/switch_{side}").adr[0]) for side in "ab"]

    def read(self, arm: SimulatedArm, hand: HandDrive, threads: Threads, *, braked: bool) -> Sensed:
        """One reading of everything; draws new noise each time."""
        data, world, noise = self._data, self._world, self.rng.standard_normal(14)
        errors = world.hand
        first, second = data.sensordata[self._switches] > errors.switch_force
        gap = hand.gap * (1 + errors.gap_scale) + errors.gap_offset + errors.gap_noise * noise[12]
        return Sensed(
            time=float(data.time),
            q=world.arm.readings(data.qpos[arm.qpos]) + world.arm.pot_noise * noise[:6],
            qd=np.asarray(data.qvel[arm.dofs] + world.arm.tachometer_noise * noise[6:12]),
            gap=float(gap),
            touch=(bool(first), bool(second)),
            tool_torque=float(threads.torque + errors.torque_noise * noise[13]),
            braked=braked,
        )
