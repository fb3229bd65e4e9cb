"""What the sensors of perfect motors sense, as it is written on the command line."""

import re
from typing import Final

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, NoSuchName
from handeye.systems.ml.arithmetic import fits
from handeye.systems.ml.machine.rectilinear import RIGHT
from handeye.systems.ml.machine.surroundings import Stimulus

_FORM: Final = re.compile(r"(\d+)=(-?\d+)(?:@(\d+):(-?\d+))?")


def sensed(text: str) -> Stimulus:
    """Read `SENSOR=READING`, or `SENSOR=READING@MOTOR:POSITION`, which holds while the motor is at the position or
    farther from 0. Raises BadArgument.
    """
    match = _FORM.fullmatch(text)
    if match is None or not all(fits(int(each or 0)) for each in match.groups()):
        raise BadArgument(
            f"--sense takes SENSOR=READING or SENSOR=READING@MOTOR:POSITION, not {quoted(text)}"
        )
    sensor, reading, motor, position = (int(each or 0) for each in match.groups())
    if match[3] is not None and motor not in {each.number for each in RIGHT.motors}:
        raise NoSuchName(f"there is no motor {motor}")
    channel, count = _source(sensor)
    return Stimulus(
        channel=channel, value=reading * count, motor=motor, beyond=position, side="below" if position < 0 else "above"
    )  # fmt: skip


def _source(sensor: int) -> tuple[str, float]:
    """Return the channel of a logical sensor, and the value of a unit of its reading (SI)."""
    line = RIGHT.sensors.get(sensor)
    if line is None or (not line.mask and line.input not in RIGHT.analog):
        known = ", ".join(map(str, RIGHT.sensors))
        raise NoSuchName(f"sensor {sensor} has no source; those that have one are {known}")
    if line.mask:
        return RIGHT.digital[line.input][line.mask.bit_length() - 1], 1.0
    source = RIGHT.analog[line.input]
    return source.channel, source.count
