"""Resolution of the analogue-to-digital and digital-to-analogue converters between computer and arm (data sheet of
1974).
"""

from functools import lru_cache
from typing import Final

import numpy as np

from handeye.arm.model import ArmModel, constants
from handeye.core.pose import Array
from handeye.core.small_arrays import limited

SENSE_BITS: Final = 12  # potentiometers, tachometers: "12-bit A/D"
TORQUE_BITS: Final = 8  # drives: "8 bits or more"

# The steps below are computed once for an arm; the arrays are not to be modified.


@lru_cache(maxsize=16)
def position_step(arm: ArmModel) -> Array:
    """Return the step size of each potentiometer's converter, shape (n,), in rad or m. The steps of a converter span
    the range of its joint.
    """
    return (arm.upper - arm.lower) / 2**SENSE_BITS


@lru_cache(maxsize=16)
def _half_step(arm: ArmModel) -> Array:
    return position_step(arm) / 2


@lru_cache(maxsize=16)
def rate_step(arm: ArmModel) -> Array:
    """Return the step size of each tachometer's converter, shape (n,), in rad/s or m/s. We assume that the range of a
    converter is the range of the joint's rate, from the greatest negative to the greatest positive rate.
    """
    return 2 * constants(arm).speed / 2**SENSE_BITS


@lru_cache(maxsize=16)
def torque_step(arm: ArmModel) -> Array:
    """Return the step size of each drive's converter, shape (n,), in N m or N. The range of a converter is the range
    of the drive's torque, in both directions.
    """
    return 2 * constants(arm).effort / 2**TORQUE_BITS


def followed(arm: ArmModel, here: Array, moved: Array, reading: Array) -> Array:
    """Return joint positions with a finer resolution than the potentiometers give. To the previous positions, `here`,
    the function adds `moved`, the displacements integrated from the tachometers. The result is kept within half a step
    of the potentiometers' `reading`.
    """
    half = _half_step(arm)
    return np.minimum(np.maximum(here + moved, reading - half), reading + half)


def sliding(arm: ArmModel, rate: Array) -> Array:
    """Return the direction in which each joint slides, from -1 to 1, shape (n,). The magnitude is less than 1 if
    the rate is below one tachometer step. Rates of shape (N, n) give shape (N, n).
    """
    return limited(rate / rate_step(arm), 1.0)
