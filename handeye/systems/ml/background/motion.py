"""The motion commands, and POINT. While the flag of any sensor is on, a motion command moves nothing."""

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Final

from handeye.systems.ml.arithmetic import divided
from handeye.systems.ml.errors import MlError
from handeye.systems.ml.happenings import Nullified
from handeye.systems.ml.language.syntax import FINGERS, MOTORS, Point

if TYPE_CHECKING:
    from handeye.systems.ml.background.interpreter import Interpreter

RECORD, CANCEL = 1, 2  # values of the first function key, in FK


def start(mos: "Interpreter", goals: Mapping[int, int], *, wait: bool = True) -> None:
    """Start a motion, and wait for its end. Raises MlError if a motor is not installed (M09) or cannot go to its goal
    (M10), or if the pump is off (M15).
    """
    level = mos.level
    if level.start(goals):
        if wait:
            mos.memory.waits = "post"
        return
    number = mos.memory.executing
    sensors = tuple(sorted(level.flags))
    mos.tell(Nullified(time=mos.time, statement=number, sensors=sensors))


def distances(mos: "Interpreter", values: Mapping[int, int]) -> dict[int, int]:
    """Return the goal of each motor in `values`: its present goal plus its distance. For an absent motor, the distance
    itself is the goal; the real-time level then refuses the motion.
    """
    level = mos.level
    return {
        motor: value + (level.goal(motor) if motor in level.motors else 0)
        for motor, value in values.items()
        if value or motor in level.motors
    }


def positions(mos: "Interpreter", values: tuple[int, ...]) -> dict[int, int]:
    """Return the goals of the motors. The values begin with the goal of motor 1. If a motor is absent, its value 0 is
    ignored.
    """
    motors = mos.level.motors
    return {motor: value for motor, value in enumerate(values, 1) if value or motor in motors}


def here(mos: "Interpreter") -> Point:
    """Return the positions of all motors; absent motors have position 0."""
    level = mos.level
    return tuple(level.position(motor) if motor in level.motors else 0 for motor in range(1, MOTORS + 1))


def move(mos: "Interpreter", *values: int) -> None:
    start(mos, positions(mos, values))


def dmove(mos: "Interpreter", *values: int) -> None:
    start(mos, distances(mos, dict(enumerate(values, 1))))


def motor(mos: "Interpreter", number: int, value: int) -> None:
    start(mos, {number: value})


def dmotor(mos: "Interpreter", number: int, value: int) -> None:
    start(mos, {number: mos.level.goal(number) + value})


def hand(mos: "Interpreter", *values: int) -> None:
    start(mos, dict(enumerate(values, FINGERS)))


def dhand(mos: "Interpreter", *values: int) -> None:
    start(mos, distances(mos, dict(enumerate(values, FINGERS))))


def define_point(mos: "Interpreter", number: int) -> None:
    mos.program.fill(number, here(mos))


def go_point(mos: "Interpreter", number: int, fall_through: int = 0) -> None:
    start(mos, positions(mos, mos.program.point(number)), wait=fall_through != 1)


def go_mean(mos: "Interpreter", one: int, other: int) -> None:
    pairs = zip(mos.program.point(one), mos.program.point(other), strict=True)
    start(mos, positions(mos, tuple(divided(a + b, 2)[0] for a, b in pairs)))


def go_line(mos: "Interpreter", one: int, other: int) -> None:
    """Move all motors to a place on the straight line through two POINTs. Of all points of the line, this place is the
    nearest to the present goals, in the space of all motors. Half a unit is rounded up.
    """
    level, a, b = mos.level, mos.program.point(one), mos.program.point(other)
    goals = [level.goal(motor) if motor in level.motors else 0 for motor in range(1, MOTORS + 1)]
    along = [q - p for p, q in zip(a, b, strict=True)]
    length = sum(each * each for each in along) or 1
    share = sum((goal - p) * each for goal, p, each in zip(goals, a, along, strict=True))
    foot = [p + (2 * share * each + length) // (2 * length) for p, each in zip(a, along, strict=True)]
    start(mos, positions(mos, tuple(foot)))


def joy(mos: "Interpreter", number: int) -> None:
    """Begin to guide the arm with the joystick. The guiding ends when a function key is pressed."""
    mos.program.check_point(number)
    if mos.level.flags:
        start(mos, {})
        return
    if not mos.joystick and not mos.level.read("FK", 1, 1):
        raise MlError(
            "M16",
            "there is no joystick here; without one, JOY works only after a function key has been written into the "
            "table FK",
        )
    mos.memory.waits, mos.memory.joy, mos.memory.until = "joy", number, mos.level.now


def jog(mos: "Interpreter") -> bool:
    """Follow the joystick for a cycle. Returns True when the record key or the cancel key has been pressed."""
    level, memory = mos.level, mos.memory
    key = level.read("FK", 1, 1)
    if key in (RECORD, CANCEL):
        level.write("FK", 1, 1, 0)
        if key == RECORD:
            mos.program.fill(memory.joy, here(mos))
        return True
    if level.now > memory.until:
        memory.until = level.now
        steps = [(level.read("JY", line, 1), level.read("JY", line, 2)) for line in range(1, MOTORS + 1)]
        moves = {number: step for number, step in steps if step and number in level.motors}
        if moves and not level.flags:
            level.start(distances(mos, moves))
    return False


def nothing(mos: "Interpreter") -> None:
    """POINT is not executable."""


MOTION: Final[dict[str, Callable[..., None]]] = {
    "MOVE": move, "DMOVE": dmove, "MOTOR": motor, "DMOTOR": dmotor, "HAND": hand, "DEFPOINT": define_point,
    "GOPOINT": go_point, "JOY": joy, "POINT": nothing,
}  # fmt: skip
