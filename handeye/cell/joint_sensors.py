"""Potentiometers and tachometers of a simulated arm: what they tell of joints."""

import numpy as np

from handeye.cell.converter import Converters
from handeye.cell.device_errors import ArmErrors
from handeye.cell.lines import Lines
from handeye.core.pose import Array


class JointSensors:
    """The sensors of n joints, behind lines called `potentiometer.N` and `tachometer.N`."""

    def __init__(self, errors: ArmErrors, noise: np.random.Generator, lines: Lines) -> None:
        """Sensors that are off by errors and by what a generator draws."""
        self._errors, self._noise, self._lines = errors, noise, lines
        self._joints = len(errors.offset)
        self._sigma = np.concatenate((errors.pot_noise, errors.tachometer_noise))
        self._converters = Converters(np.concatenate((errors.pot_step, errors.tachometer_step)))

    def read(self, q: Array, qd: Array) -> tuple[Array, Array]:
        """Positions and rates as they are told, for true ones; shape (n,), rad or m."""
        n, lines = self._joints, self._lines
        told = np.concatenate((self._errors.readings(q), qd))
        told += self._sigma * self._noise.standard_normal(2 * n)
        if lines.defects:
            told[:n] = lines.carried_each("potentiometer", told[:n])
            told[n:] = lines.carried_each("tachometer", told[n:])
        told = self._converters(told)
        return told[:n], told[n:]
