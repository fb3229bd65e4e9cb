"""Defines the protocol of the bus: the five bytes of a command, the answers, and the numbers of the
microcomputers."""

from collections.abc import Sequence
from enum import IntEnum
from typing import Final

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, NoSuchName
from handeye.core.record import Record
from handeye.ports.microbus import COMMAND_BYTES, Command

STEP_MM: Final = 0.0375  # mm, travel of one step
STEPS_PER_TURN: Final = 400
FORCE_STEP_N: Final = 0.01  # N: unit of forces and thresholds on the bus
STANDARD: Final = 0xFFFF  # a threshold that restores the standard one
LONGEST_MOVE: Final = 0xFFFF  # greatest number of steps in one command
SLOWEST: Final = 31  # steps/s: the lowest rate to which a 16-bit counter can divide 2 MHz
SLOW_STEP_MM: Final = 2  # mm/s per unit of a speed code; a code stands for 2 to 254 mm/s

_NAMES: Final = ("X1", "Y1", "Z1", "FORCE1", "HAND1", "X2", "Y2", "Z2", "FORCE2", "HAND2")
NUMBERS: Final = {name: number for number, name in enumerate(_NAMES)}
"""Numbers of the microcomputers of SUPERSIGMA, by name. The microcomputers of each arm share a page of status lines."""
_LINE: Final = (
    "X3", "Y3", "Z3", "FORCE3", "HAND3", "X4", "Y4", "Z4", "FORCE4", "HAND4",
    "X5", "Y5", "HAND5", "X6", "SCALE", "HAND6",
)  # fmt: skip
LINE_NUMBERS: Final = NUMBERS | {name: len(NUMBERS) + number for number, name in enumerate(_LINE)}
"""The number that identifies each microcomputer of the assembly line. The line has the microcomputers of two
SUPERSIGMAs, of the feeder (names that end in 5) and of the belt (names that end in 6).
"""
AXES: Final = ("X1", "Y1", "Z1", "X2", "Y2", "Z2")
LINE_AXES: Final = (*AXES, "X3", "Y3", "Z3", "X4", "Y4", "Z4", "X5", "Y5", "X6")
"""The axes of the assembly line: first the axes of the four arms, then the axes of the feeder (X5, Y5) and of the belt
(X6), which have no wrists.
"""
COMPONENTS: Final = ("X", "Y", "Z")  # components of a wrist, as byte 3 numbers them
DEVICES: Final = {
    "HAND": 0,
    "DRIVER": 1,
    "LAMP": 2,
    "BELL": 3,
}  # devices of a hand microcomputer, as byte 3 numbers them


class Timing(Record, frozen=True, kw_only=True):
    """Times at which lines change, are polled and are sampled, in whole microseconds of each device's clock."""

    slot: int = 20  # from byte to byte of a command
    strobe_falls: int = 2  # from the beginning of the first byte to the falling edge of /DATA READY
    strobe_rises: int = 12
    poll: int = 5  # between two looks of a free microcomputer at /DATA READY
    interrupt: int = 3  # from the fall of /DATA READY until an interrupt is served
    sample: int = 2  # from seeing a strobe until the data are taken
    check: int = 3  # to compare the first byte with a number
    act: int = 4  # to execute a command that moves nothing
    prepare: int = 20  # from a question until its first byte
    answer: int = 100  # from byte to byte of an answer
    answer_low: int = 50  # time for which /ANSWER READY is low and a byte is on the lines
    guard: int = 20  # after the last byte, for which the bus is watched for a byte that was not requested
    time_limit: int = 5_000  # until each byte of an answer
    settle: int = 0  # from the change of a data line until its new level can be read
    scan: int = 1_000  # time in which a force microcomputer scans all its channels
    hand: int = 150_000  # time in which a hand opens or closes

    @property
    def command(self) -> int:
        """Duration of a command (microseconds)."""
        return COMMAND_BYTES * self.slot


class Op(IntEnum):
    """The operations that microcomputers can execute. The operation is byte 2 of a command."""

    MOVE = 0x01  # moves by steps; the profile depends on their number
    MOVE_SLOW = 0x02  # moves by steps at constant speed
    LIMIT_SPEED = 0x03
    ORIGIN = 0x04
    POSITION = 0x05  # asks
    ABORT_POSITION = 0x06  # asks
    SET_POSITION = 0x07
    FORCE = 0x21  # asks
    THRESHOLD = 0x22
    PEAK_FORCE = 0x23  # question: the greatest force since the last such question
    ACTUATE = 0x31
    BEAM = 0x32  # asks
    SENSE = 0x41  # question to a newer kind of sensor; the length of its answer depends on the sensor
    SELF_TEST = 0x7F  # question; the answer 0 means that no fault was found
    ECHO = 0x80  # question: send bytes 3 to 5 back; it shares no bit with SELF_TEST


ANSWERS: Final[dict[Op, int]] = {
    Op.POSITION: 2,
    Op.ABORT_POSITION: 2,
    Op.FORCE: 2,
    Op.PEAK_FORCE: 2,
    Op.BEAM: 1,
    Op.SELF_TEST: 1,
    Op.ECHO: 3,
}
"""Number of bytes of each answer."""


def number_of(name: str | int) -> int:
    """Return the number of a microcomputer. Raises NoSuchName if there is no microcomputer of this name."""
    if isinstance(name, int):
        if not 0 <= name <= 0xFF:
            raise BadArgument(f"the number of a microcomputer must be between 0 and 255, not {name}")
        return name
    if name.upper() not in LINE_NUMBERS:
        raise NoSuchName(
            f"there is no microcomputer {quoted(name)}; the microcomputers are {', '.join(NUMBERS)}"
        )
    return LINE_NUMBERS[name.upper()]


def name_of(number: int, *, line: bool = False) -> str:
    """Return the name of a microcomputer of SUPERSIGMA or, if `line` is True, the name of a microcomputer of the
    assembly line. If the microcomputer has no name, return its number as text.
    """
    known = LINE_NUMBERS if line else NUMBERS
    return {number: name for name, number in known.items()}.get(number, str(number))


def move(axis: str | int, steps: int, curve: int = 0) -> Command:
    """Make the command that moves a motor by a signed number of steps, with the speed profile for a move of this
    length."""
    return Command(
        number=number_of(axis),
        op=Op.MOVE,
        detail=(steps < 0) | within(curve, 0, 4, "a curve") << 1,
        value=within(abs(steps), 1, LONGEST_MOVE, "a move in steps"),
    )


def move_slow(axis: str | int, steps: int, speed: float) -> Command:
    """Make the command that moves a motor by a signed number of steps at a constant speed (mm/s). The speed is
    rounded to an even number from 2 to 254."""
    code = within(max(1, round(speed / SLOW_STEP_MM)), 1, 127, "the code of a speed")
    value = within(abs(steps), 1, LONGEST_MOVE, "a move in steps")
    return Command(number=number_of(axis), op=Op.MOVE_SLOW, detail=(steps < 0) | code << 1, value=value)


def limit_speed(axis: str | int, speed: int) -> Command:
    """Make the command that limits the speed of a motor (steps/s). A limit of 0 allows the greatest speed of
    the curve."""
    limit = within(speed, SLOWEST, 0xFFFF, "a limit in steps/s") if speed else 0
    return Command(number=number_of(axis), op=Op.LIMIT_SPEED, value=limit)


def origin(axis: str | int) -> Command:
    """Make the command that moves an axis to the end of its rail, and starts the count there."""
    return Command(number=number_of(axis), op=Op.ORIGIN)


def position(axis: str | int, *, at_abort: bool = False) -> Command:
    """Make the question for the step count of a motor: the present count or, if `at_abort` is True, the count at the
    last abort.
    """
    return Command(number=number_of(axis), op=Op.ABORT_POSITION if at_abort else Op.POSITION)


def set_position(axis: str | int, count: int) -> Command:
    """Make the command that sets the step count of a motor."""
    return Command(number=number_of(axis), op=Op.SET_POSITION, value=count & 0xFFFF)


def force(arm: int, component: str, *, peak: bool = False) -> Command:
    """Make the question for a component of the force on a wrist. The answer is the present value or, if `peak` is
    True, the greatest value since the last question for a greatest value.
    """
    op = Op.PEAK_FORCE if peak else Op.FORCE
    return Command(number=number_of(f"FORCE{arm}"), op=op, detail=COMPONENTS.index(component))


def threshold(arm: int, component: str, newtons: float | None) -> Command:
    """Make the command that sets the force (N) above which a motor is stopped. If `newtons` is None, the force is the
    standard value.
    """
    value = STANDARD if newtons is None else within(round(newtons / FORCE_STEP_N), 0, STANDARD - 1, "a limit")
    return Command(
        number=number_of(f"FORCE{arm}"), op=Op.THRESHOLD, detail=COMPONENTS.index(component), value=value
    )


def actuate(arm: int, device: str, value: int) -> Command:
    """Make the command that sets a device of a hand microcomputer."""
    return Command(number=number_of(f"HAND{arm}"), op=Op.ACTUATE, detail=DEVICES[device], value=value)


def beam(arm: int) -> Command:
    """Make the question that asks whether the light beam between the fingers is interrupted."""
    return Command(number=number_of(f"HAND{arm}"), op=Op.BEAM)


def self_test(name: str | int) -> Command:
    """Make the question that lets a microcomputer test itself. The answer 0 means that the microcomputer has found no
    fault.
    """
    return Command(number=number_of(name), op=Op.SELF_TEST)


def echo(name: str | int, pattern: bytes) -> Command:
    """Make the question that asks a microcomputer to send the three bytes `pattern` back."""
    return Command.of(bytes((number_of(name), Op.ECHO, *pattern)))


def sense(name: str | int) -> Command:
    """Make the question for the reading of a sensor whose answer may have any length."""
    return Command(number=number_of(name), op=Op.SENSE)


def signed(answer: Sequence[int]) -> int:
    """Return the signed number in two bytes of an answer, with the high byte first."""
    return int.from_bytes(bytes(answer), "big", signed=True)


def within(value: int, least: int, most: int, what: str) -> int:
    """Return `value`, which must be from `least` to `most`. Raises BadArgument if it is outside this range."""
    if not least <= value <= most:
        raise BadArgument(f"{what} must be between {least} and {most}, not {value}")
    return value
