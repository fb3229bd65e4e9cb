"""The screwdriver of the work station, and a gauge that measures the forces on the fingers for the referee."""

from typing import Final

import mujoco
import numpy as np

from handeye.cell.mechanism import Mechanism
from handeye.core.errors import BadFile
from handeye.core.record import Record
from handeye.systems.ml.bench.arm import FINGER_STIFFNESS

SPEED: Final = 20.0  # rad/s, 190 turns a minute
_CYCLES: Final = 4093  # cycles after which the noise of the current repeats


class PowerScrewdriver:
    """A screwdriver that turns while the output `screwdriver` is on. If the output `reverse` is also on, the
    screwdriver turns backwards. The screwdriver's bit is a permanent magnet.
    """

    magnet = True

    def __init__(self) -> None:
        self._on = self._back = False

    @property
    def speed(self) -> float:
        """Speed of the spindle (rad/s). A positive speed drives a screw in."""
        return 0.0 if not self._on else -SPEED if self._back else SPEED

    def turn(self, value: float) -> None:
        """Switch the motor."""
        self._on = value != 0.0

    def reverse(self, value: float) -> None:
        """Switch the direction."""
        self._back = value != 0.0


class ScrewdriverCurrent:
    """The torque of the screwdriver (N m), as indicated by the motor current. The torque is positive while a screw is
    driven in.
    """

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, noise: np.random.Generator, sigma: float
    ) -> None:
        self._data = data
        self._motors = [model.actuator(name).id for name in ("drive", "spindle")]
        self._noise = sigma * noise.standard_normal(_CYCLES)

    def __call__(self, cycle: int) -> float:
        return float(self._noise[cycle % _CYCLES] - self._data.actuator_force[self._motors].sum())


class FingerForces(Record, frozen=True, kw_only=True):
    """The greatest forces so far on both fingers together (N)."""

    driving: float = 0.0  # greatest force along the fingers while the screwdriver turns
    along: float = 0.0  # greatest force along the fingers at any time
    across: float = 0.0  # greatest force across the line between the fingers


class ForceGauge(Mechanism[FingerForces]):
    """Keeps the greatest true forces on the fingers, for the referee and for the report."""

    name, kind = "finger_forces", FingerForces

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, driver: PowerScrewdriver) -> None:
        self._data, self._driver = data, driver
        self._gauges = [
            int(model.sensor(f"{side}_{axis}").adr[0]) for axis in "yz" for side in ("left", "right")
        ]
        self.greatest = FingerForces()

    def after(self) -> None:
        bent = FINGER_STIFFNESS * self._data.sensordata[self._gauges]
        across, along = abs(float(bent[:2].sum())), abs(float(bent[2:].sum()))
        was = self.greatest
        driving = along if self._driver.speed else 0.0
        if driving > was.driving or along > was.along or across > was.across:
            self.greatest = FingerForces(
                driving=max(was.driving, driving), along=max(was.along, along), across=max(was.across, across)
            )

    def state(self) -> FingerForces:
        return self.greatest

    def check(self, state: FingerForces) -> None:
        if not np.isfinite([state.driving, state.along, state.across]).all():
            raise BadFile("a force on the fingers is not a finite number")

    def restore(self, state: FingerForces) -> None:
        self.greatest = state
