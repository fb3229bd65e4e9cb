"""Writes quantities of a plan in the units of the language: inches, degrees, ounces, ounce-inches."""

import math
from collections.abc import Callable
from typing import Any, Final

from handeye.core.errors import NOTHING_HELD, WRONG_HEIGHT, WRONG_THICKNESS, WRONG_TRAVEL
from handeye.core.plain_text import counted
from handeye.core.record import Vector3
from handeye.core.units import DEGREE, INCH, OUNCE_FORCE, OUNCE_INCH
from handeye.program import guards as g
from handeye.program.flow_operations import Undo
from handeye.program.motion_operations import Center, Change, Close, Height, Move, Travel
from handeye.program.operations import AnyOperation

FINGERS = {1: "finger 1", 2: "finger 2", 3: "either finger"}
"""Names of the fingers by switch mask. Finger 1 is on the +y side of the hand."""
_ON_AXIS = (
    1e-9  # a direction counts as that of an axis if its other components are smaller than this fraction
)


def figure(value: float) -> str:
    """Write a number with up to three decimals."""
    return f"{round(value, 3) + 0.0:g}"


def inches(metres: float) -> str:
    """Write a length in inches, such as `1.5 in`."""
    return f"{figure(metres / INCH)} in"


def degrees(radians: float) -> str:
    """Write an angle in degrees, such as `60 deg`."""
    return f"{figure(radians / DEGREE)} deg"


def ounces(force: Vector3) -> str:
    """Write a force in ounces with its direction, such as `30 oz along -z`."""
    return f"{figure(math.hypot(*force) / OUNCE_FORCE)} oz along {direction(force)}"


def ounce_inches(moment: Vector3) -> str:
    """Write a moment in ounce-inches with its axis, such as `20 oz-in about z`."""
    return f"{figure(math.hypot(*moment) / OUNCE_INCH)} oz-in about {direction(moment)}"


def direction(vector: Vector3) -> str:
    """Write a direction in table coordinates, such as `-z` or `[0.6 0.8 0]`."""
    size = math.hypot(*vector)
    unit = [value / size for value in vector]
    for name, value in zip("xyz", unit, strict=True):
        if abs(value) > 1 - _ON_AXIS:
            return name if value > 0 else f"-{name}"
    return f"[{' '.join(map(figure, unit))}]"


_MET: Final[dict[type[g.Guard], Callable[[Any], str]]] = {
    g.Force: lambda guard: f"at {ounces(guard.force)}",
    g.Against: lambda guard: f"at {figure(guard.force / OUNCE_FORCE)} oz against the motion",
    g.Moment: lambda guard: f"at {ounce_inches(guard.moment)}",
    g.Torque: lambda guard: f"at {figure(guard.torque / OUNCE_INCH)} oz-in of torque",
    g.Touch: lambda guard: f"when {FINGERS[guard.fingers]} touches",
}
"""For each type of guard, the condition under which it trips, in words."""


def stops(guards: g.Guards) -> str:
    """Write the guards that end a motion, and the error that is raised if no guard trips."""
    return f"stops {' or '.join(_MET[type(guard)](guard) for guard in guards)}, else error {g.unmet(guards)}"


def conditions(operation: AnyOperation) -> tuple[str, ...]:
    """Write the guards of an operation, and the force that the operation exerts."""
    guarded = (stops(operation.guards),) if operation.guards else ()
    said = _CONDITIONS.get(type(operation))
    return guarded if said is None else (*guarded, *said(operation))


def _with_force(operation: Change) -> list[str]:
    said = []
    if operation.press is not None:
        said.append(f"presses with {ounces(operation.press)}")
    if operation.free is not None:
        said.append(f"yields along {_axes(operation.free)}")
    if operation.moment is not None:
        said.append(f"turns with {ounce_inches(operation.moment)}")
    if operation.spin is not None:
        said.append(f"yields about {_axes(operation.spin)}")
    return said


def _closed(operation: Close) -> list[str]:
    said, most = [_held(operation)], operation.maximum
    return said if most is None else [*said, f"{inches(most)} or less, else error {WRONG_THICKNESS}"]


def _held(operation: Close | Center) -> str:
    held = f"{inches(operation.minimum)} or more" if operation.minimum else "anything"
    return f"holds {held}, else error {NOTHING_HELD}"


def _within(operation: Travel | Height) -> str:
    return f"{inches(operation.minimum)} to {inches(operation.maximum)}"


_CONDITIONS: Final[dict[type[AnyOperation], Callable[[Any], list[str]]]] = {
    Move: lambda operation: [f"via {', '.join(operation.via)}"] if operation.via else [],
    Change: _with_force,
    Close: _closed,
    Center: lambda operation: [_held(operation)],
    Travel: lambda operation: [f"moved {_within(operation)}, else error {WRONG_TRAVEL}"],
    Height: lambda one: [f"is {_within(one)} above {one.name}, else error {WRONG_HEIGHT}"],
    Undo: lambda operation: [f"undoes the stage, {counted(operation.times, 'time')} at most"],
}
"""Conditions in words, for each type of operation that has conditions."""


def _axes(axes: Vector3) -> str:
    """Write the names of the chosen axes, such as `x and y`."""
    return " and ".join(letter for letter, wanted in zip("xyz", axes, strict=True) if wanted)
