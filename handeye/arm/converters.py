"""Resolution of the analogue-digital converters between computer and arm (data sheet of 1974)."""

from functools import lru_cache
from typing import Final

from handeye.arm.model import ArmModel, constants
from handeye.core.pose import Array

SENSE_BITS: Final = 12  # potentiometers, tachometers: "12-bit A/D"
TORQUE_BITS: Final = 8  # drives: "8 bits or more"

# The steps below are computed once for an arm; the arrays are not to be modified.


@lru_cache(maxsize=16)
def position_step(arm: ArmModel) -> Array:
    """One converter step of each potentiometer, whose steps span the joint's range; shape (n,), rad or m."""
    return (arm.upper - arm.lower) / 2**SENSE_BITS


@lru_cache(maxsize=16)
def rate_step(arm: ArmModel) -> Array:
    """One converter step of each tachometer, whose steps span the joint's rates; shape (n,), rad/s or m/s.
    Inferred.
    """
    return 2 * constants(arm).speed / 2**SENSE_BITS


@lru_cache(maxsize=16)
def torque_step(arm: ArmModel) -> Array:
    """One converter step of each drive, whose steps span the torques in both directions; shape (n,), N m or N."""
    return 2 * constants(arm).effort / 2**TORQUE_BITS


def followed(arm: ArmModel, here: Array, moved: Array, reading: Array) -> Array:
    """Joint positions with a finer resolution than the potentiometers: integrated from the tachometers (`moved`),
    and kept within half a step of the potentiometer `reading`.
    """
    half = position_step(arm) / 2
    return (here + moved).clip(reading - half, reading + half)


def sliding(arm: ArmModel, rate: Array) -> Array:
    """Direction in which each joint slides, from -1 to 1, shape (n,); the magnitude is less than 1 if the rate is
    below one tachometer step.
    """
    return (rate / rate_step(arm)).clip(-1.0, 1.0)
