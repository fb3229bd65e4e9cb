"""The control, sense and test commands."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Final

from handeye.systems.ml.errors import MlError
from handeye.systems.ml.level import Side

if TYPE_CHECKING:
    from handeye.systems.ml.background.interpreter import Interpreter

_ALL_BITS: Final = -1


def enable(mos: "Interpreter") -> None:
    mos.level.enable()


def disable(mos: "Interpreter") -> None:
    mos.level.disable()


def leave(mos: "Interpreter") -> None:
    for level in mos.levels.values():
        level.disable()
    mos.end()
    mos.memory.left = True


def _arm(side: Side) -> Callable[["Interpreter"], None]:
    def choose(mos: "Interpreter") -> None:
        if side not in mos.levels:
            raise MlError("M12", f"there is no {side} arm")
        mos.memory.side = side

    return choose


def print_values(mos: "Interpreter", *values: int) -> None:
    mos.print(" ".join(map(str, values)))


def run(mos: "Interpreter", first: int | None = None) -> None:
    mos.run(first)


def try_program(mos: "Interpreter", first: int | None = None) -> None:
    mos.run(first)
    mos.memory.trying = True


def trace(mos: "Interpreter", on: int = 1) -> None:
    mos.memory.tracing = on != 0


def sensor(mos: "Interpreter", number: int | None = None, *limits: int) -> None:
    if number is not None and limits:
        mos.level.expect(number, *limits)
    else:
        mos.level.open(number)


def calibrate(mos: "Interpreter", *sensors: int) -> None:
    mos.level.calibrate(sensors)


def wand(mos: "Interpreter", number: int = 1) -> None:
    mos.level.wand(number)


def analog_input(mos: "Interpreter", point: int) -> None:
    mos.print(str(mos.level.analog_in(point)))


def analog_output(mos: "Interpreter", point: int, value: int) -> None:
    mos.level.analog_out(point, value)


def digital_output(mos: "Interpreter", word: int, value: int, mask: int = _ALL_BITS) -> None:
    mos.level.digital_out(word, value, mask)


CONTROL: Final[dict[str, Callable[..., None]]] = {
    "ENABLE": enable, "DISABLE": disable, "EXIT": leave, "LEFT": _arm("left"), "RIGHT": _arm("right"),
    "PRINT": print_values, "RUN": run, "TRY": try_program, "TRACE": trace,
    "SENSOR": sensor, "CALIB": calibrate, "WAND": wand,
    "TESTAI": analog_input, "TESTAO": analog_output, "TESTDO": digital_output,
}  # fmt: skip
