"""The arithmetic commands. They compute with variables, compare values, set indicators, and read and write tables."""

from collections.abc import Callable
from operator import eq, ge, gt, le, lt, ne
from typing import TYPE_CHECKING, Final

from handeye.systems.ml.arithmetic import divided, double, fits, halves, wrap
from handeye.systems.ml.errors import MlError
from handeye.systems.ml.language.commands import TABLE_NAMES

if TYPE_CHECKING:
    from handeye.systems.ml.background.interpreter import Interpreter

COMPARISON: Final = (3, 1)  # line and word of RG
OVERFLOW: Final = (3, 2)
_DOUBLE: Final = 1 << 31


def table_name(number: int) -> str:
    """Return the name of the table that a word stands for. Raises MlError (M11) if no table has this name."""
    name = TABLE_NAMES.get(number)
    if name is None:
        raise MlError("M11", f"{number} is not the name of a table")
    return name


def indicate(mos: "Interpreter", indicator: tuple[int, int], on: bool) -> None:
    """Set an indicator."""
    mos.set_register(*indicator, int(on))


def load(mos: "Interpreter", variable: int, value: int) -> None:
    mos.set_variable(variable, value)


def add(mos: "Interpreter", variable: int, value: int) -> None:
    _result(mos, variable, mos.variable(variable) + value)


def mult(mos: "Interpreter", variable: int, value: int, high: int | None = None) -> None:
    product = mos.variable(variable) * value
    if high is None:
        _result(mos, variable, product)
        return
    mos.variable(high)  # raises MlError, if at all, before anything has changed
    upper, lower = halves(product)
    mos.set_variable(variable, lower)
    mos.set_variable(high, upper)


def divd(mos: "Interpreter", variable: int, value: int, remainder: int | None = None) -> None:
    dividend = mos.variable(variable)
    if remainder is not None:
        mos.variable(remainder)
    if value == 0:
        indicate(mos, OVERFLOW, True)
        return
    quotient, rest = divided(dividend, value)
    _result(mos, variable, quotient)
    if remainder is not None:
        mos.set_variable(remainder, rest)


def dload(mos: "Interpreter", variable: int, value: int, low: int | None = None) -> None:
    _set_pair(mos, variable, value if low is None else double(value, low))


def dadd(mos: "Interpreter", variable: int, value: int, low: int | None = None) -> None:
    total = double(mos.variable(variable), mos.variable(variable + 1))
    total += value if low is None else double(value, low)
    _set_pair(mos, variable, total)
    if not -_DOUBLE <= total < _DOUBLE:
        indicate(mos, OVERFLOW, True)


def get(mos: "Interpreter", variable: int, table: int, line: int, word: int) -> None:
    mos.set_variable(variable, mos.level.read(table_name(table), line, word))


def put(mos: "Interpreter", table: int, line: int, word: int, value: int) -> None:
    mos.level.write(table_name(table), line, word, value)


def get_sensor(mos: "Interpreter", variable: int, sensor: int) -> None:
    mos.set_variable(variable, mos.level.reading(sensor))


def get_position(mos: "Interpreter", variable: int, motor: int) -> None:
    mos.set_variable(variable, mos.level.position(motor))


def get_goal(mos: "Interpreter", variable: int, motor: int) -> None:
    mos.set_variable(variable, mos.level.goal(motor))


def _result(mos: "Interpreter", variable: int, value: int) -> None:
    mos.set_variable(variable, wrap(value))
    if not fits(value):
        indicate(mos, OVERFLOW, True)


def _set_pair(mos: "Interpreter", variable: int, value: int) -> None:
    mos.variable(variable + 1)
    high, low = halves(value)
    mos.set_variable(variable, high)
    mos.set_variable(variable + 1, low)


def _comparison(holds: Callable[[int, int], bool]) -> Callable[..., None]:
    def compare(mos: "Interpreter", one: int, other: int) -> None:
        indicate(mos, COMPARISON, holds(one, other))

    return compare


def _indicator(indicator: tuple[int, int], on: bool) -> Callable[..., None]:
    return lambda mos: indicate(mos, indicator, on)


NUMBERS: Final[dict[str, Callable[..., None]]] = {
    "LOAD": load, "ADD": add, "MULT": mult, "DIVD": divd, "DLOAD": dload, "DADD": dadd, "GET": get, "PUT": put,
    "GETSEN": get_sensor, "GETPOS": get_position, "GETGOL": get_goal,
    "LT?": _comparison(lt), "LE?": _comparison(le), "GT?": _comparison(gt), "GE?": _comparison(ge),
    "EQ?": _comparison(eq), "NE?": _comparison(ne),
    "COMPON": _indicator(COMPARISON, True), "COMPOFF": _indicator(COMPARISON, False),
    "OVFLON": _indicator(OVERFLOW, True), "OVFLOFF": _indicator(OVERFLOW, False),
}  # fmt: skip
