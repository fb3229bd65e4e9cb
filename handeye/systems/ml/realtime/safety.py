"""The rules of safety: it is always safe for an arm to stand still, and every emergency freezes the arm and switches
the pump off.
"""

from collections.abc import Mapping
from typing import Final, NamedTuple

from handeye.systems.ml.machine.spec import ArmSpec
from handeye.systems.ml.realtime.sampling import outside
from handeye.systems.ml.tables.records import BOTH_OPEN
from handeye.systems.ml.tables.store import ArmMemory

CAUSES: Final = ("", "PROGRAM", "SENSOR", "PANIC", "INTERLOCK", "CLASS", "STUCK")
"""Causes of emergencies, by their numbers in the table EM: an error of the program, a reading outside its emergency
limits, the panic button, an interlock of the room or of a work table, a class interrupt of the System/7, and a motion
that does not end.
"""
_INTERLOCKS: Final[Mapping[str, tuple[str, str]]] = {
    "panic": ("PANIC", "the panic button is pressed"),
    "door": ("INTERLOCK", "the door of the room is open"),
    "table_1": ("INTERLOCK", "the fuse of work table 1 has blown"),
    "table_2": ("INTERLOCK", "the fuse of work table 2 has blown"),
    "program_check": ("CLASS", "the System/7 reports a program check"),
    "machine_check": ("CLASS", "the System/7 reports a machine check"),
    "power": ("CLASS", "the System/7 reports a power or temperature warning"),
}


class Danger(NamedTuple):
    """A cause of an emergency."""

    cause: str
    number: int = 0  # number of the sensor, of the line of SF, or of the first motor not at its goal


def danger(memory: ArmMemory, spec: ArmSpec) -> Danger | None:
    """Return the cause of the emergency that the tables show, or None if they show no emergency."""
    for number, (lock, name) in enumerate(zip(memory.SF, spec.interlocks, strict=False), 1):
        if lock.now:
            return Danger(_INTERLOCKS[name][0], number)
    for number, sensor in enumerate(memory.ST, 1):
        if sensor.emergency_open != BOTH_OPEN and outside(
            sensor.reading, sensor.lower_emergency, sensor.upper_emergency, sensor.emergency_open
        ):
            return Danger("SENSOR", number)
    return None


def emergency_text(found: Danger, spec: ArmSpec) -> str:
    """Say what caused an emergency."""
    if found.cause in ("PANIC", "INTERLOCK", "CLASS") and 1 <= found.number <= len(spec.interlocks):
        return _INTERLOCKS[spec.interlocks[found.number - 1]][1]
    return {
        "SENSOR": f"sensor {found.number} is outside its emergency limits",
        "STUCK": _stuck(found.number, spec),
        "PROGRAM": "an error of the program",
    }.get(found.cause, found.cause.lower())


def _stuck(number: int, spec: ArmSpec) -> str:
    axis = next((motor.axis for motor in spec.motors if motor.number == number), "")
    return f"motor {number} ({axis}) does not reach its goal"
