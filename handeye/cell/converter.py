"""Converters between the computer and a device: what passes them comes in steps."""

import numpy as np

from handeye.pose import Array


def converted(values: Array, step: Array) -> Array:
    """Values as a converter passes them on: the nearest multiple of its step, or as they are where that is 0."""
    in_steps = np.round(values / np.where(step > 0, step, 1.0)) * step
    return np.where(step > 0, in_steps, values)
