"""Quantisation by the converters between computer and arm (data sheet of 1974)."""

from typing import Final

from handeye.arm.model import ArmModel, constants
from handeye.core.pose import Array

SENSE_BITS: Final = 12  # potentiometers, tachometers: "12-bit A/D"
TORQUE_BITS: Final = 8  # drives: "8 bits or more"


def position_step(arm: ArmModel) -> Array:
    """One step of a potentiometer, spanning its joint's range; shape (n,), rad or m."""
    return (arm.upper - arm.lower) / 2**SENSE_BITS


def rate_step(arm: ArmModel) -> Array:
    """One step of a tachometer, spanning its joint's rates; shape (n,), rad/s or m/s. Inferred."""
    return 2 * constants(arm).speed / 2**SENSE_BITS


def torque_step(arm: ArmModel) -> Array:
    """One step of a drive, spanning its torques both ways; shape (n,), N m or N."""
    return 2 * constants(arm).effort / 2**TORQUE_BITS


def followed(arm: ArmModel, here: Array, moved: Array, reading: Array) -> Array:
    """Joint positions, finer than potentiometers show: tachometers move them, `reading` bounds them to half a step."""
    half = position_step(arm) / 2
    return (here + moved).clip(reading - half, reading + half)


def sliding(arm: ArmModel, rate: Array) -> Array:
    """Direction in which joints slide, -1 to 1, shape (n,); less than 1 within a tachometer step."""
    return (rate / rate_step(arm)).clip(-1.0, 1.0)
