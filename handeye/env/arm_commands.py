"""Makes the devices of an arm's cell execute the commands of an action for one servo period."""

from collections.abc import Callable
from typing import Final

import numpy as np

from handeye.arm.model import constants
from handeye.core.pose import Array, displaced
from handeye.env.controls import Values
from handeye.env.spaces import SWITCHED, ActionKind
from handeye.execution.drive import ArmDrive
from handeye.execution.servo import ServoPeriod

_STANDS: Final = 6
"""Number of servo periods (.1 s) that the brakes need to bring the arm to rest."""


class ArmCommands:
    """Drives arm, hand and screwdriver. `drive` is the servo that the task's program used before the episode began."""

    def __init__(self, drive: ArmDrive, kind: ActionKind) -> None:
        self.torque = np.zeros(len(drive.arm.joints))  # commanded in the last servo period, shape (n,)
        self._drive, self._effort = drive, constants(drive.arm).effort
        self._act: Callable[[Values], None] = {"torques": self._torques, "hand": self._hand}[kind]
        drive.watch = self._noted

    def act(self, values: Values) -> None:
        """Make the devices execute the commands `values` for one servo period. Raises PhysicsFailed if the simulation
        breaks down.
        """
        state = self._drive.state
        state.gap, state.grip, state.tool = values["gap"], values["grip"], values["driver"]
        state.magnet = values["magnet"] > SWITCHED
        self._act(values)

    def stop(self) -> None:
        """Set the brakes, switch the screwdriver off, and wait until the arm stands still."""
        self._drive.state.tool = 0.0
        for _ in range(_STANDS):
            self._pass(None)

    def _torques(self, values: Values) -> None:
        if values["brake"] > SWITCHED:
            self._pass(None)
            return
        wanted = np.array([values[f"torque.{number}"] for number in range(1, len(self._effort) + 1)])
        self._pass(wanted.clip(-self._effort, self._effort))

    def _hand(self, values: Values) -> None:
        drive = self._drive
        drive.state.load = values["load"]
        if values["brake"] > SWITCHED:
            drive.brake(drive.period)
            return
        moved = np.array([values[f"move.{axis}"] for axis in "xyz"])
        turned = np.array([values[f"turn.{axis}"] for axis in "xyz"])
        goal = displaced(drive.chain.forward(drive.state.q), moved, turned)
        before = drive.cell.clock.now
        drive.shift(drive.dynamics(), goal)
        if drive.cell.clock.now == before:
            drive.hold(1)  # the goal is out of reach, so the set-point stays

    def _pass(self, torque: Array | None) -> None:
        """Apply torques (shape (n,)) for one servo period or, without torques, keep the brakes set."""
        self._drive.put_out(torque)
        self._drive.cell.clock.advance(self._drive.period)
        self.torque = np.zeros(len(self._effort)) if torque is None else torque

    def _noted(self, period: ServoPeriod) -> None:
        self.torque = period.effort
