"""Reads the option --sense: values that the user gives for sensors and interlocks in a run with perfect motors."""

import re
from typing import Final

from handeye.core.diagnostics import alternatives, names_sentence, quoted
from handeye.core.errors import BadArgument, NoSuchName
from handeye.systems.ml.arithmetic import fits
from handeye.systems.ml.machine.rectilinear import INTERLOCKS, RIGHT
from handeye.systems.ml.machine.spec import CYCLES_PER_SECOND
from handeye.systems.ml.machine.surroundings import Stimulus

_FORM: Final = re.compile(r"(\w+)=(-?\d{1,6})(?:@(?:(\d{1,3}):(-?\d{1,6})|(\d{1,6}(?:\.\d*)?|\.\d+)s))?")
FORM: Final = "SENSOR=READING, SENSOR=READING@MOTOR:POSITION or SENSOR=READING@SECONDSs"


def sensed(text: str) -> Stimulus:
    """Parse a value of --sense. It says what a sensor or an interlock reads, and when: at all times, after a given
    time, or while a motor is at a given position or farther away from 0. Raises BadArgument if the text has another
    form.
    """
    match = _FORM.fullmatch(text)
    if match is None or not all(fits(int(each or 0)) for each in (match[2], match[4])):
        raise BadArgument(f"--sense takes {FORM}, not {quoted(text)}")
    channel, count = _source(match[1])
    motor, position = int(match[3] or 0), int(match[4] or 0)
    if match[3] is not None and motor not in {each.number for each in RIGHT.motors}:
        raise NoSuchName(f"there is no motor {motor}")
    return Stimulus(
        channel=channel, value=int(match[2]) * count, since=round(float(match[5] or 0) * CYCLES_PER_SECOND),
        motor=motor, beyond=position, side="below" if position < 0 else "above",
    )  # fmt: skip


def _source(name: str) -> tuple[str, float]:
    """Return the channel of a logical sensor or interlock, and the SI value of one unit of its reading."""
    if name in INTERLOCKS:
        return name, 1.0
    known = {
        str(number): line for number, line in RIGHT.sensors.items() if line.mask or line.input in RIGHT.analog
    }
    if name not in known:
        choices = (*known, *INTERLOCKS)
        near = names_sentence(alternatives(name, choices)) or f"choose from {', '.join(choices)}"
        raise NoSuchName(f"there is no sensor or interlock {quoted(name)} for --sense; {near}")
    line = known[name]
    if line.mask:
        return RIGHT.digital[line.input][line.mask.bit_length() - 1], 1.0
    source = RIGHT.analog[line.input]
    return source.channel, source.count
