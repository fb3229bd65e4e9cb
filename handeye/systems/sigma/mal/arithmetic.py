"""Executes the arithmetic instructions of the stack machine."""

import math
import operator
from collections.abc import Callable
from typing import Final

from handeye.core.errors import HandeyeError


class Trap(HandeyeError):
    """Raised if a statement cannot be executed."""


def _divided(left: float, right: float) -> float:
    if not right:
        raise Trap("this divides by zero")
    return left / right


def _root(value: float) -> float:
    if value < 0:
        raise Trap(f"SQR needs a number of 0 or more, not {value:g}")
    return math.sqrt(value)


BINARY: Final[dict[str, Callable[[float, float], float]]] = {
    "ADD": operator.add,
    "SUB": operator.sub,
    "MUL": operator.mul,
    "DIV": _divided,
    "EQ": operator.eq,
    "NE": operator.ne,
    "LT": operator.lt,
    "GT": operator.gt,
    "LE": operator.le,
    "GE": operator.ge,
    "AND": lambda left, right: left != 0 and right != 0,
    "OR": lambda left, right: left != 0 or right != 0,
}
UNARY: Final[dict[str, Callable[[float], float]]] = {
    "NOT": lambda value: value == 0,
    "NEG": operator.neg,
    "ABS": abs,
    "INT": math.floor,
    "SGN": lambda value: (value > 0) - (value < 0),
    "SQR": _root,
}


def checked(value: float) -> float:
    """Return the number. Raises Trap if the number is not finite."""
    if not math.isfinite(value):
        raise Trap("the value is beyond the largest number of MAL")
    return float(value)


def shown(value: float) -> str:
    """Return a number as PRINT prints it."""
    whole = value == int(value) and abs(value) < 1e15
    return f"{value:.0f}" if whole else f"{value:.6g}"
