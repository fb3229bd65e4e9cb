"""An arm as the real-time level sees it: motors, input and output words, sensors, interlocks and tools."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

from handeye.core.units import DEGREE, INCH
from handeye.systems.ml.level import Side
from handeye.systems.ml.tables.records import BOTH_OPEN, COUNT, DIGITAL, SensorLine

LINEAR: Final = 0.001 * INCH  # m, the unit of slides
ROTARY: Final = 0.01 * DEGREE  # rad, the unit of rotations
GRAM_FORCE: Final = 9.80665e-3  # N
RANGE_COUNT: Final = 1e-4  # m
TORQUE_COUNT: Final = 0.001  # N m: one count of the torque of a power tool
CYCLE: Final = 0.01  # s
CYCLES_PER_SECOND: Final = 100
HUNDREDTHS: Final = 100
"""Set-points are counted in hundredths of the unit of goals, because the number of units per cycle need not be whole:
a speed of 20 cm/s is 78.74 units per cycle.
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class MotorSpec:
    """A motor. Travel, tolerance and detent are in ML units."""

    number: int
    axis: str  # name of its axis in the machine
    unit: float = LINEAR  # m or rad
    lower: int
    upper: int
    peak: int  # greatest advance of the set-point, in hundredths of a unit per cycle
    tolerance: int = 6
    detent: int = 0
    output: int  # point of AO; a negative number is a word of DO


@dataclass(frozen=True, slots=True, kw_only=True)
class AnalogInput:
    """An analog input that is not the position of a motor."""

    channel: str  # part of a channel of the machine
    count: float  # SI


@dataclass(frozen=True, slots=True, kw_only=True)
class ArmSpec:
    """An arm with its wiring. Inputs and outputs have the same numbers as in the tables of MOS."""

    side: Side
    motors: tuple[MotorSpec, ...]
    analog: Mapping[int, AnalogInput] = field(default_factory=dict)  # analog inputs by their points in AI
    digital: Mapping[int, tuple[str, ...]] = field(
        default_factory=dict
    )  # for each word of the table DI: the channels of its bits, bit 0 first
    interlocks: tuple[str, ...] = ()  # channels of the bits of the first word of the table PI, bit 0 first
    tools: tuple[str, ...] = ()  # outputs of the bits of the first word of the table DO, bit 0 first
    sensors: Mapping[int, SensorLine] = field(default_factory=dict)  # lines that the table ST has at first
    wand: tuple[int, int] | None = None  # word of the table DI, and mask
    every: int = 1  # cycles of 10 ms in a period of this arm


def analog(point: int) -> SensorLine:
    """Return the line of an analog sensor. The sensor reads its analog input in converter counts, without a scale
    factor.
    """
    return SensorLine(input=point)


def digital(word: int, mask: int) -> SensorLine:
    """Return the line of a digital sensor, whose reading is 1 if the input is on."""
    return SensorLine(kind=DIGITAL, input=word, mask=mask)


def count(word: int, mask: int) -> SensorLine:
    """Return the table line of a sensor. The sensor's reading is the number of inputs that are on."""
    return SensorLine(kind=COUNT, input=word, mask=mask, open=BOTH_OPEN)
