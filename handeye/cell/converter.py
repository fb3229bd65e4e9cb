"""Converters between the computer and a device: what passes them comes in steps."""

import numpy as np

from handeye.core.pose import Array


def converted(value: float, step: float) -> float:
    """A number as a converter passes it on: the nearest multiple of its step, or as it is where that is 0."""
    return round(value / step) * step if step else value


class Converters:
    """A row of converters, one to a number."""

    def __init__(self, steps: Array) -> None:
        """Converters with these steps, shape (n,); 0 passes a number on as it is."""
        self._steps, self._there = steps, steps > 0
        self._divisors = np.where(self._there, steps, 1.0)

    def __call__(self, values: Array) -> Array:
        """Numbers as they pass them on, shape (n,)."""
        return np.where(self._there, np.rint(values / self._divisors) * self._steps, values)
