"""Many drawn worlds at once: each quantity as an array, a figure a world."""

from collections.abc import Sequence
from functools import cache

import numpy as np

from handeye.arm.robots.stanford import STANFORD
from handeye.cell.device_errors import ArmErrors
from handeye.core.pose import Array
from handeye.core.random_streams import streams
from handeye.core.units import UNITS
from handeye.core.variation import WorldSpec
from handeye.tasks.water_pump.world.variation import ARM_CENTRE, ARM_PERIOD, JOINT_UNITS, variation


class Worlds:
    """The worlds of some seeds. A quantity is drawn when it is asked for, by what draws it for the simulator."""

    def __init__(self, spec: WorldSpec, seeds: Sequence[int]) -> None:
        """Worlds that differ in their seeds alone, and are otherwise of a specification.

        Raises:
            InvalidInput: one cannot be drawn here.
        """
        self.seeds, self._spec, self._table = tuple(seeds), spec, variation(spec.seed)
        self._table.check(spec)
        self._value = cache(self._drawn)

    def __len__(self) -> int:
        return len(self.seeds)

    def __getitem__(self, name: str) -> Array:
        """The values of a quantity, SI, shape (n,)."""
        return self._value(name)

    def each(self, *names: str) -> Array:
        """Values of some quantities, SI, shape (n, names)."""
        return np.stack([self[name] for name in names], axis=-1)

    def noise(self, count: int) -> Array:
        """Standard normal figures of a stream of their own, shape (n, count): noise that no world decides."""
        return np.array([stream.standard_normal(count) for stream in streams(self.seeds, "prediction")])

    def arm(self) -> ArmErrors:
        """What the joints read wrong in each world; arrays of shape (n, 6)."""
        size = np.array([UNITS[unit].size for unit in JOINT_UNITS])
        values = {name: self._joints(name) for name in ("offset", "scale", "wave")}
        return ArmErrors(
            **values,
            phase=self._joints("wave_phase"),
            period=np.array(ARM_PERIOD) * size,
            centre=np.array(ARM_CENTRE) * size,
            pot_noise=np.zeros(6), pot_step=np.zeros(6), tachometer_noise=np.zeros(6), tachometer_step=np.zeros(6),
            torque_step=np.zeros(6), drive_gain=np.ones(6),
        )  # fmt: skip

    def _joints(self, name: str) -> Array:
        return self.each(*(f"arm.{name}.{joint}" for joint in range(1, len(STANFORD.joints) + 1)))

    def _drawn(self, name: str) -> Array:
        return np.array(self._table.each(name, self._spec, self.seeds))
