"""Words for quantities of a trace, and their values in the units of the arm language."""

from collections.abc import Mapping
from typing import Final

from handeye.core.plain_text import distinct_digits, printable
from handeye.core.units import INCHES, UNITS, Measures
from handeye.trace.quantities import QuantityDifference, Value

_SHOWN_IN: Final[Mapping[str, str]] = {
    "m": "in", "m/s": "in/s", "rad": "deg", "rad/s": "deg/s", "N": "oz", "N m": "oz in",
}  # fmt: skip
"""The unit in which people see a quantity, by its SI unit."""
_DECIMALS: Final = 3
_EVENTS: Final[Mapping[str, str]] = {
    "Adjusted": "goal that was moved",
    "CameraBusy": "wait for the camera",
    "CameraStarted": "camera's mechanism",
    "ErrorRaised": "error",
    "ErrorTested": "test of an error",
    "GuardFaint": "guard that is hard to feel",
    "GuardTripped": "stop",
    "HandTold": "hand's place",
    "OperatorAnswered": "operator's answer",
    "OperatorCalled": "call of the operator",
    "PartInspected": "part inspected",
    "PartMatched": "part matched",
    "PartSeen": "part seen",
    "PictureTaken": "picture taken",
    "PositionDefined": "position defined",
    "Restored": "difference restored",
    "RunFinished": "end of the run",
    "Saved": "difference saved",
    "SearchAdvanced": "place of the search",
    "StageFinished": "end of the stage",
    "StageStarted": "beginning of the stage",
    "StepFinished": "end of the step",
}
"""Words for the events that have quantities."""


def quantity_text(quantity: tuple[str, ...]) -> str:
    """A quantity in words: `position of joint boom`, `place x of body base`, `value of the stop`."""
    match quantity:
        case (("joint" | "body" | "link") as kind, name, *what):
            said = f"{' '.join(what)} of {kind} {name}"
        case ("channel", name, *component):
            said = " ".join(("channel", name, *component))
        case ("picture", "level", row, column):
            said = f"level of the picture in row {row}, column {column}"
        case (of, *what) if what:
            said = f"{' '.join(what).replace('_', ' ')} of the {_EVENTS.get(of, of)}"
        case _:
            said = " ".join(quantity)
    return printable(said)


def values_text(found: QuantityDifference, measures: Measures = INCHES) -> tuple[str, str]:
    """Both values in units of the period or (`measures`) of the task, with the decimals that tell them apart."""
    numbers = [value for value in (found.a, found.b) if _is_number(value)]
    told = iter(_numbers(numbers, found.unit, measures))
    one, other = (next(told) if _is_number(value) else _word(value) for value in (found.a, found.b))
    return one, other


def _is_number(value: Value) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _numbers(values: list[Value], unit: str, measures: Measures) -> list[str]:
    """Numbers in the unit that people see; in SI, to the last bit, if they look the same otherwise."""
    numbers = [float(value) for value in values if isinstance(value, int | float)]
    if all(isinstance(value, int) for value in values):
        return [f"{value}" for value in values]
    own = {"m": measures.length.name, "N": measures.force.name} if measures is not INCHES else _SHOWN_IN
    shown = UNITS.get(own.get(unit, unit))
    size, name = (1.0, unit) if shown is None else (shown.size, shown.name)
    told = distinct_digits([number / size for number in numbers], _DECIMALS)
    if len({*told}) == len({*numbers}):
        return [_with_unit(each, name) for each in told]
    return [_with_unit(repr(number), unit) for number in numbers]


def _with_unit(number: str, unit: str) -> str:
    return f"{number} {unit}".rstrip()


def _word(value: Value) -> str:
    return "none" if value is None else printable(str(value))
