"""A simulated screwdriver: a motor of given speed whose current tells its torque."""

from collections.abc import Sequence

import mujoco
import numpy as np

from handeye.cell.arm import Watchdog
from handeye.cell.mechanism import Mechanism
from handeye.cell.signal_lines import SOUND, SignalLines
from handeye.cell.state import finite
from handeye.core.record import Record
from handeye.ports.screwdriver import ScrewdriverPort


class ScrewdriverState(Record, frozen=True, kw_only=True):
    """State of a screwdriver: reading and commanded speed."""

    torque: float
    command: float
    """rad/s"""
    magnet: bool = True
    """The magnet of the bit is on."""


class SimulatedScrewdriver(Mechanism[ScrewdriverState], ScrewdriverPort):
    """Its torque is that of actuators of the model; what its speed does is a matter of the task's threads."""

    name = "screwdriver"
    kind = ScrewdriverState

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        motors: Sequence[str],
        *,
        torque_noise: float,
        noise: np.random.Generator,
        watchdog: Watchdog,
        lines: SignalLines = SOUND,
    ) -> None:
        """A screwdriver that is off; `torque_noise` is a sigma, N m.

        The torques of its `motors`, counter-clockwise about the spindle, add up to its own. The watchdog of the arm
        that carries it cuts it, too. Its lines: `screwdriver.current`, by which its torque is read,
        and `screwdriver.motor`.
        """
        self._data, self._watchdog, self._lines = data, watchdog, lines
        self._motors = [model.actuator(name).id for name in motors]
        self._torque_noise, self._noise = torque_noise, noise
        self._command = self._torque = 0.0
        self.magnet = True
        """The magnet of the bit is to be on; what it attracts is a matter of the task's threads."""

    @property
    def speed(self) -> float:
        """The speed its motor is to turn with now, rad/s, positive drives a screw in."""
        return 0.0 if self._watchdog.tripped else self._lines.carried("screwdriver.motor", self._command)

    def torque(self) -> float:
        return self._torque

    def drive(self, speed: float) -> None:
        finite([speed], "the speed of the screwdriver")
        self._command = speed

    def attract(self, on: bool) -> None:
        self.magnet = on

    def before(self, seconds: float) -> None:
        if self._watchdog.tripped:
            self._command = 0.0

    def after(self) -> None:
        true = -float(sum(self._data.actuator_force[motor] for motor in self._motors))
        told = float(true + self._torque_noise * self._noise.standard_normal())
        self._torque = self._lines.carried("screwdriver.current", told)

    def state(self) -> ScrewdriverState:
        return ScrewdriverState(torque=self._torque, command=self._command, magnet=self.magnet)

    def check(self, state: ScrewdriverState) -> None:
        finite([state.torque, state.command], "the screwdriver")

    def restore(self, state: ScrewdriverState) -> None:
        self._torque, self._command, self.magnet = state.torque, state.command, state.magnet
