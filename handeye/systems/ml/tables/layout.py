"""The layouts of the thirty tables."""

from collections.abc import Mapping
from typing import Final

from handeye.systems.ml.level import Shape
from handeye.systems.ml.tables.records import (
    ArmLine,
    CycleLine,
    EmergencyLine,
    ForceLine,
    FrameLine,
    GoalLine,
    InterlockLine,
    MotorLine,
    SensorLine,
    SpaceLine,
)

MOTORS: Final = 12
SENSORS: Final = 16
RECENT: Final = 8  # readings of each sensor that CALIB averages
EVENTS_KEPT: Final = 8
ANALOG_INPUTS: Final = 64
ANALOG_OUTPUTS: Final = 8
DIGITAL_INPUTS: Final = 21
DIGITAL_OUTPUTS: Final = 16
INTERRUPTS: Final = 3
INTERLOCKS: Final = 7
TIMERS: Final = 16
FRAMES: Final = 8


def _lines(title: str, count: int, kind: type, *, internal: bool = True) -> Shape:
    names = kind.__struct_fields__  # type: ignore[attr-defined]  # records are structures
    return Shape(title, count, len(names), internal, names)


def _words(title: str, lines: int, words: int = 1, *names: str, internal: bool = True) -> Shape:
    return Shape(title, lines, words, internal, names)


_POINT: Final = ("number", *(f"m{motor}" for motor in range(1, MOTORS + 1)))

SHAPES: Final[Mapping[str, Shape]] = {
    "MT": _lines("motors", MOTORS, MotorLine),
    "ST": _lines("sensors", SENSORS, SensorLine),
    "AI": _words("analog inputs", ANALOG_INPUTS),
    "AO": _words("analog outputs", ANALOG_OUTPUTS),
    "DI": _words("digital inputs", DIGITAL_INPUTS),
    "DO": _words("digital outputs", DIGITAL_OUTPUTS),
    "PI": _words("process interrupts", INTERRUPTS),
    "EM": _lines("emergency", 1, EmergencyLine),
    "FE": _lines("force events", EVENTS_KEPT, ForceLine),
    "GO": _lines("goal events", EVENTS_KEPT, GoalLine),
    "CY": _lines("cycles", 1, CycleLine),
    "TM": _words("timers", TIMERS, 1, "hundredths of a second"),
    "JY": _words("joystick", MOTORS, 2, "motor", "step"),
    "FK": _words("function keys", 16),
    "VR": _words("variables", 256),
    "RG": _words("registers", 3, 5),
    "AR": _lines("arm", 1, ArmLine),
    "SF": _lines("interlocks", INTERLOCKS, InterlockLine),
    "PF": _lines("page frames", FRAMES, FrameLine),
    "HL": _words("host link", 1, 3, "connected", "sent", "received"),
    "CC": _words("command codes", 106),
    "MX": _words("masks", 16),
    "WS": _lines("work space", MOTORS, SpaceLine),
    "TK": _words("task", 5000, 20, internal=False),
    "PT": _words("recent points", 8, 1 + MOTORS, *_POINT, internal=False),
    "ER": _words("error texts", 16, 32, internal=False),
    "LG": _words("session log", 100, 32, internal=False),
    "TR": _words("trace buffer", 100, 16, internal=False),
    "CA": _words("calibration", SENSORS, RECENT, internal=False),
    "US": _words("user data", 256, 16, internal=False),
}
"""All tables by name. Internal tables are in main memory. External tables are on the disk; a page of such a table is
brought into a frame in main memory when it is needed.
"""

SHARED: Final = ("TM", "JY", "FK", "VR", "PF", "HL", "MX", "US")
"""Tables of the real-time level that both arms share. The tables of the background level are not in this list,
although the arms share them, too.
"""
