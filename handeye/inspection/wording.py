"""Quantities of a plan in the units of the language: inches, degrees, ounces, ounce-inches."""

import math

from handeye.program import program as op
from handeye.program.raises import unmet
from handeye.units import DEGREE, INCH, OUNCE_FORCE, OUNCE_INCH

FINGERS = {1: "finger 1", 2: "finger 2", 3: "either finger"}
"""The fingers whose switches a mask enables; 1 is the one on the +y side of the hand frame."""
_ON_AXIS = 1e-9
"""A direction whose other two components are below this share of it lies on an axis."""


def figure(value: float) -> str:
    """A number to three decimals, with no zeros to fill them."""
    return f"{round(value, 3) + 0.0:g}"


def inches(metres: float) -> str:
    """`1.5 in`"""
    return f"{figure(metres / INCH)} in"


def degrees(radians: float) -> str:
    """`60 deg`"""
    return f"{figure(radians / DEGREE)} deg"


def ounces(force: op.Vector) -> str:
    """`30 oz along -z`"""
    return f"{figure(math.hypot(*force) / OUNCE_FORCE)} oz along {direction(force)}"


def ounce_inches(moment: op.Vector) -> str:
    """`20 oz-in about z`"""
    return f"{figure(math.hypot(*moment) / OUNCE_INCH)} oz-in about {direction(moment)}"


def direction(vector: op.Vector) -> str:
    """`-z`, or `[0.6 0.8 0]`; table coordinates."""
    size = math.hypot(*vector)
    unit = [value / size for value in vector]
    for name, value in zip("xyz", unit, strict=True):
        if abs(value) > 1 - _ON_AXIS:
            return name if value > 0 else f"-{name}"
    return f"[{' '.join(map(figure, unit))}]"


def stop(guard: op.Stop) -> str:
    """What ends a guarded motion, and the error there is if it does not."""
    met = []
    if guard.force is not None:
        met.append(f"at {ounces(guard.force)}")
    if guard.against is not None:
        met.append(f"at {figure(guard.against / OUNCE_FORCE)} oz against it")
    if guard.moment is not None:
        met.append(f"at {ounce_inches(guard.moment)}")
    if guard.torque is not None:
        met.append(f"at {figure(guard.torque / OUNCE_INCH)} oz-in of torque")
    if guard.touch is not None:
        met.append(f"when {FINGERS[guard.touch]} touches")
    return f"stops {' or '.join(met)}, else error {unmet(guard)}"


def conditions(operation: op.AnyOperation) -> tuple[str, ...]:
    """What guards an operation, and what it does with force; nothing for most."""
    said = []
    if isinstance(operation, op.Move | op.Change | op.Turn) and operation.stop is not None:
        said.append(stop(operation.stop))
    if isinstance(operation, op.Change):
        if operation.press is not None:
            said.append(f"presses with {ounces(operation.press)}")
        if operation.free is not None:
            said.append(f"gives way along {_axes(operation.free)}")
        if operation.moment is not None:
            said.append(f"turns with {ounce_inches(operation.moment)}")
        if operation.spin is not None:
            said.append(f"gives way about {_axes(operation.spin)}")
    if isinstance(operation, op.Move) and operation.via:
        said.append(f"by way of {', '.join(operation.via)}")
    if isinstance(operation, op.Center) or (isinstance(operation, op.Close) and operation.minimum > 0):
        said.append(f"holds {inches(operation.minimum)} or more, else error 2")
    if isinstance(operation, op.Close) and operation.maximum is not None:
        said.append(f"{inches(operation.maximum)} or less, else error 7")
    if isinstance(operation, op.Travel):
        said.append(f"went {inches(operation.minimum)} to {inches(operation.maximum)}, else error 8")
    return tuple(said)


def _axes(axes: op.Vector) -> str:
    """`x and y`"""
    return " and ".join(letter for letter, wanted in zip("xyz", axes, strict=True) if wanted)


def one_line(text: str) -> str:
    """A statement without the blanks that put it in columns, printable throughout."""
    line = " ".join(text.expandtabs().split())
    return "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in line)


def counted(number: int, noun: str) -> str:
    """`1 step`, `2 steps`"""
    return f"{number} {noun}{'' if number == 1 else 's'}"
