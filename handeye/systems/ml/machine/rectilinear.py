"""The right arm: the rectilinear arm of 1975, with its sensors and the tools of its work station."""

from typing import Final

from handeye.core.units import MILLIMETRE
from handeye.ports.axes import AxisSpec
from handeye.systems.ml.machine.spec import (
    CYCLE,
    GRAM_FORCE,
    HUNDREDTHS,
    LINEAR,
    RANGE_COUNT,
    ROTARY,
    TORQUE_COUNT,
    AnalogInput,
    ArmSpec,
    MotorSpec,
    analog,
    count,
    digital,
)

_SLIDE: Final = {"lower": -10_039, "upper": 10_039, "peak": 7874}  # 51 cm, 20 cm/s
_TURNING: Final = 9000  # 90 deg/s

_MOTORS: Final = (
    MotorSpec(
        number=1, axis="base", lower=-16_500, upper=16_500, unit=ROTARY, peak=_TURNING, detent=250, output=-16
    ),
    MotorSpec(number=2, axis="z", **_SLIDE, output=1),
    MotorSpec(number=3, axis="y", **_SLIDE, output=2),
    MotorSpec(number=4, axis="x", **_SLIDE, output=3),
    MotorSpec(number=8, axis="roll", lower=-17_500, upper=17_500, unit=ROTARY, peak=_TURNING, output=4),
    MotorSpec(number=9, axis="yaw", lower=-10_000, upper=10_000, unit=ROTARY, peak=_TURNING, output=5),
    MotorSpec(number=10, axis="pitch", lower=-10_000, upper=10_000, unit=ROTARY, peak=_TURNING, output=6),
    MotorSpec(number=11, axis="separation", lower=0, upper=4000, peak=7874, output=7),
    MotorSpec(number=12, axis="angle", lower=-2500, upper=2500, unit=ROTARY, peak=_TURNING, output=8),
)
"""Each motor except the motor of the base is driven by one of the eight analog outputs of the System/7. A digital word
sets the detent of the base.
"""

STRAINS: Final = tuple(f"{finger}_strain_{part}" for finger in ("left", "right") for part in "xyz")
INTERLOCKS: Final = ("panic", "door", "table_1", "table_2", "program_check", "machine_check", "power")
TOOLS: Final = ("screwdriver", "vacuum", "feeder", "reverse")
_STRAIN_POINT: Final = 17
_RANGE_POINT: Final = 23
_TORQUE_POINT: Final = 24

RIGHT: Final = ArmSpec(
    side="right",
    motors=_MOTORS,
    analog={
        **{_STRAIN_POINT + n: AnalogInput(channel=name, count=GRAM_FORCE) for n, name in enumerate(STRAINS)},
        _RANGE_POINT: AnalogInput(channel="range", count=RANGE_COUNT),
        _TORQUE_POINT: AnalogInput(channel="torque", count=TORQUE_COUNT),
    },
    digital={1: ("wand",), 2: ("inside_left", "inside_right")},
    interlocks=INTERLOCKS,
    tools=TOOLS,
    sensors={
        1: digital(1, 1),
        **{2 + n: analog(_STRAIN_POINT + n) for n in range(len(STRAINS))},
        8: analog(_RANGE_POINT),
        9: digital(2, 1),
        10: digital(2, 2),
        11: count(2, 3),
    },
    wand=(1, 1),
)

_HOLDING: Final = ("yaw", "pitch", "separation", "angle")  # electric motors; the pump drives all others


def axes_of(arm: ArmSpec, holding: tuple[str, ...] = _HOLDING) -> tuple[AxisSpec, ...]:
    """Return the axes of an arm, with the travels and speeds of its motors. The axes in `holding` stay where they are
    when the pump is off.
    """
    return tuple(
        AxisSpec(
            name=motor.axis,
            kind="revolute" if motor.unit == ROTARY else "prismatic",
            lower=motor.lower * motor.unit,
            upper=motor.upper * motor.unit,
            speed=motor.peak / HUNDREDTHS * motor.unit / (CYCLE * arm.every),
            holds=motor.axis in holding,
        )
        for motor in arm.motors
    )


LEFT: Final = ArmSpec(
    side="left",
    motors=(
        MotorSpec(number=2, axis="z", lower=-5905, upper=5905, peak=1200, output=1),
        MotorSpec(number=3, axis="y", lower=-7874, upper=7874, peak=2400, output=2),
        MotorSpec(number=4, axis="x", lower=-7874, upper=7874, peak=2400, output=3),
        MotorSpec(number=8, axis="roll", unit=ROTARY, lower=-17_000, upper=17_000, peak=4500, output=4),
        MotorSpec(number=9, axis="yaw", unit=ROTARY, lower=-17_000, upper=17_000, peak=4500, output=5),
        MotorSpec(number=10, axis="pitch", unit=ROTARY, lower=-17_000, upper=17_000, peak=4500, output=6),
        MotorSpec(
            number=11,
            axis="opening",
            unit=LINEAR,
            lower=0,
            upper=round(48 * MILLIMETRE / LINEAR),
            peak=1000,
            output=7,
        ),
    ),
    digital={1: ("touch",)},
    interlocks=INTERLOCKS,
    sensors={1: digital(1, 1)},
    wand=(1, 1),
    every=2,
)
"""A left arm whose design differs greatly from that of the right arm: the Purbrick arm. It has fewer motors, different
travels, lower speeds, and a period of two cycles.
"""
