"""Converts inputs to positions and readings, and compares the readings with limits."""

from collections.abc import Sequence
from typing import Final

from handeye.systems.ml.arithmetic import HIGHEST, LOWEST
from handeye.systems.ml.tables.records import (
    ANALOG,
    COUNT,
    DIGITAL,
    LOWER_OPEN,
    UPPER_OPEN,
    MotorLine,
    SensorLine,
)

_BITS: Final = 0xFFFF


class ProgramCheck(Exception):
    """Raised when the values in a table would cause a division by zero."""


def saturated(value: float) -> int:
    """Return the word nearest to a value."""
    word = round(value)
    return word if LOWEST <= word <= HIGHEST else LOWEST if word < 0 else HIGHEST


def packed(bits: Sequence[object]) -> int:
    """Return a word with these bits, bit 0 first."""
    word = sum(1 << n for n, bit in enumerate(bits) if bit)
    return word - (word >> 15 << 16)


def scaled(count: int, line: MotorLine | SensorLine) -> int:
    """Convert a count to the units of a line of MT or ST, before the offset is subtracted. Raises ProgramCheck if the
    denominator of the line is 0.
    """
    if not line.denominator:
        raise ProgramCheck
    if line.numerator == line.denominator:
        return count
    return saturated(count * line.numerator / line.denominator)


def sensed(line: SensorLine, analog: Sequence[int], digital: Sequence[int]) -> int:
    """Return the reading of a logical sensor before its offset is subtracted; 0 if the sensor is not connected. Raises
    ProgramCheck if the denominator of the line is 0.
    """
    if not line.input:
        return 0
    point = line.input - 1
    if line.kind == ANALOG:
        count = analog[point] if 0 <= point < len(analog) else 0
    else:
        bits = (digital[point] if 0 <= point < len(digital) else 0) & line.mask & _BITS
        count = bits.bit_count() if line.kind == COUNT else int(line.kind == DIGITAL and bits != 0)
    return scaled(count, line)


def outside(reading: int, lower: int, upper: int, open_bits: int) -> bool:
    """Return True if a reading is at or beyond one of its limits. An open limit is ignored."""
    return not (open_bits & LOWER_OPEN or lower < reading) or not (open_bits & UPPER_OPEN or reading < upper)


def nearest_detent(goal: int, detent: int) -> int:
    """Return the multiple of a detent that is nearest to a goal; halves are rounded away from zero."""
    if detent <= 0:
        return goal
    rounded = (2 * abs(goal) + detent) // (2 * detent) * detent
    return rounded if goal >= 0 else -rounded
