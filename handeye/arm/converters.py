"""Converters between the computer and an arm: by the data sheet of 1974 all numbers come and go in steps."""

from typing import Final

from handeye.arm.model import ArmModel, constants
from handeye.core.pose import Array

SENSE_BITS: Final = 12
"""Of the converters that potentiometers and tachometers are read by: "12-bit A/D"."""
TORQUE_BITS: Final = 8
"""Of the converters that the drives get their torques from: "8 bits or more"."""


def position_step(arm: ArmModel) -> Array:
    """One step of a potentiometer, which has the travel of its joint; shape (n,), rad or m."""
    return (arm.upper - arm.lower) / 2**SENSE_BITS


def rate_step(arm: ArmModel) -> Array:
    """One step of a tachometer, shape (n,), rad/s or m/s: it has all rates of its joint. Inferred."""
    return 2 * constants(arm).speed / 2**SENSE_BITS


def torque_step(arm: ArmModel) -> Array:
    """One step of a drive, shape (n,), N m or N: it has all its torques, both ways."""
    return 2 * constants(arm).effort / 2**TORQUE_BITS


def followed(arm: ArmModel, here: Array, moved: Array, reading: Array) -> Array:
    """Where the joints are, shape (n,), rad or m, more finely than potentiometers tell.

    Tachometers tell how far the joints have moved; potentiometers, where they are to half a step.

    Args:
        here: where they were before.
        moved: by how much they have moved since, by the tachometers.
        reading: of the potentiometers now.
    """
    half = position_step(arm) / 2
    return (here + moved).clip(reading - half, reading + half)


def sliding(arm: ArmModel, rate: Array) -> Array:
    """Which way joints slide at these rates, -1 to 1, shape (n,); less than 1 where a tachometer cannot tell."""
    return (rate / rate_step(arm)).clip(-1.0, 1.0)
