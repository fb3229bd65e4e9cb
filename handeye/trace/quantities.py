"""Finds the first quantity that has different values in two messages, and describes the difference in words."""

from collections.abc import Callable, Iterator, Mapping
from itertools import zip_longest
from typing import Any, Final

import msgspec
import numpy as np
from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms
from foxglove_schemas_protobuf.JointStates_pb2 import JointStates
from foxglove_schemas_protobuf.RawImage_pb2 import RawImage

from handeye.arm.model import ArmModel
from handeye.core.closeness import LAST_PLACES, alike
from handeye.core.plain_text import distinct_digits, printable
from handeye.core.record import Record
from handeye.core.units import INCHES, UNITS, Measures
from handeye.program.events import AnyEvent, FrictionMeasured
from handeye.trace.channels import ANNOTATIONS, EVENTS, FRAMES, HAND, JOINTS, MACHINES, PICTURE
from handeye.trace.hand_message import PLACES
from handeye.trace.messages import GAP, LEVEL, read_annotations
from handeye.trace.records import RawMessage

Value = bool | int | float | str | None  # the value of a quantity; None: there is none
Found = tuple[tuple[str, ...], Value, Value]  # the name of a quantity, part by part, and two values of it


class QuantityDifference(Record, frozen=True, kw_only=True):
    """A quantity that has different values in two runs."""

    quantity: tuple[str, ...]  # parts of the quantity's name, such as `("joint", "boom", "position")`
    unit: str = ""  # SI unit of the values; empty if they have none, or if it is unknown
    a: Value  # value in the first run; None if it has no value
    b: Value  # value in the second run; None if it has no value

    @property
    def name(self) -> str:
        """The name of the quantity as one word that programs can use, for example `joint.boom.position`."""
        return ".".join(part.replace(" ", "_") for part in self.quantity)


def differing(
    a: RawMessage | None, b: RawMessage | None, arm: ArmModel | None = None, *, rounded: bool = False
) -> QuantityDifference | None:
    """Return the first quantity that has different values in two messages on a channel. Times do not count. Returns
    None if no quantity differs.

    A message is None if its run has no message at this point. `arm` is the arm whose joints the messages describe;
    without `arm`, units are unknown. If `rounded` is True, differences in the last digits do not count.
    """
    message = a or b
    tell = None if message is None else _TELLERS.get(message.topic)
    if message is None or tell is None:
        return None
    here, there = ({} if each is None else tell(each.data) for each in (a, b))
    places = _RECORDED.get(message.topic, LAST_PLACES) if rounded else 0.0
    found = next((each for each in _differing(here, there) if not alike(*each[1:], places)), None)
    if found is None:
        return None
    quantity, one, other = found
    return QuantityDifference(quantity=quantity, unit=_unit(message, quantity, arm), a=one, b=other)


def has_quantities(message: RawMessage) -> bool:
    """Return True if the values in a message have names."""
    return message.topic in _TELLERS


def differing_events(a: AnyEvent, b: AnyEvent) -> QuantityDifference | None:
    """Return the first quantity that has different values in two events of the same kind. Times do not count. Returns
    None if no quantity differs.
    """
    plain = msgspec.to_builtins(a)
    found = next(_differing(_event(plain), _event(msgspec.to_builtins(b))), None)
    if found is None:
        return None
    quantity, one, other = found
    return QuantityDifference(quantity=quantity, unit=_event_unit(plain, quantity), a=one, b=other)


def _differing(a: Any, b: Any, name: tuple[str, ...] = ()) -> Iterator[Found]:
    """Yield the differences between two values made of dictionaries and lists, in the order of the first value."""
    if isinstance(a, Mapping) or isinstance(b, Mapping):
        one, other = a or {}, b or {}
        for key in dict.fromkeys((*one, *other)):
            yield from _differing(one.get(key), other.get(key), (*name, str(key)))
    elif isinstance(a, list | tuple) or isinstance(b, list | tuple):
        for number, (one, other) in enumerate(zip_longest(a or (), b or ()), 1):
            yield from _differing(one, other, (*name, str(number)))
    elif a != b:
        yield name, a, b


# -- what the messages of each channel say ---------------------------------------------------------------


def _joints(data: bytes) -> dict[str, Any]:
    told: dict[str, Any] = {"joint": {}}
    for joint in JointStates.FromString(data).joints:
        if joint.name == GAP:
            told["gap"] = joint.position
        else:
            values = {"position": joint.position, "rate": joint.velocity, "torque": joint.effort}
            told["joint"][joint.name] = values
    return told


def _hand(data: bytes) -> dict[str, Any]:
    return {"hand": msgspec.json.decode(data)}


def _channels(data: bytes) -> dict[str, Any]:
    told = msgspec.json.decode(data)["channels"]
    return {"channel": {each["name"]: each["values"] for each in told}}


def _frames(data: bytes) -> dict[str, Any]:
    bodies = {}
    for frame in FrameTransforms.FromString(data).transforms:
        p, r = frame.translation, frame.rotation
        turn = {"w": r.w, "x": r.x, "y": r.y, "z": r.z}
        bodies[frame.child_frame_id] = {"place": {"x": p.x, "y": p.y, "z": p.z}, "turn": turn}
    return {"body": bodies}


def _picture(data: bytes) -> dict[str, Any]:
    image = RawImage.FromString(data)
    levels = np.frombuffer(image.data, np.uint8).reshape(image.height, image.width) // LEVEL
    return {"picture": {"level": levels.tolist()}}


def _marks(data: bytes) -> dict[str, Any]:
    _, marks = read_annotations(data)
    told = [{"kind": type(m).__name__} | {name: getattr(m, name) for name in m.__slots__} for m in marks]
    return {"picture": {"mark": told}}


def _event(event: dict[str, Any]) -> dict[str, Any]:
    """Return the contents of an event as dictionaries and lists. The keys are the names of quantities."""
    if event["event"] == FrictionMeasured.__name__:
        joints = {each["joint"]["name"]: {"friction": each["friction"]} for each in event["joints"]}
        links = {f"{number}": {"weight": weight} for number, weight in enumerate(event.get("links", ()), 1)}
        return {"joint": joints, "link": links, "friction": {"seconds": event["seconds"]}}
    told = {name: _named(value) for name, value in event.items() if name not in ("event", "time")}
    return {event["event"]: told}


def _named(value: Any) -> Any:
    """Return a position or difference as a dictionary from axis names to components. Other values are returned
    unchanged.
    """
    if not isinstance(value, list | tuple) or len(value) > len(_AXES):
        return value
    numbers = all(isinstance(each, int | float) for each in value)
    return dict(zip(_AXES, value, strict=False)) if numbers else value


_AXES: Final = ("x", "y", "z", "O", "A", "T")
_RECORDED: Final = {FRAMES: 2.0**-22, HAND: 1.1 * 10.0**-PLACES, EVENTS: 1.1e-6}
"""Resolution of recorded numbers, with a margin for rounding. Numbers are recorded with 24 binary digits or with a
fixed number of decimals.
"""
_TELLERS: Final[Mapping[str, Callable[[bytes], dict[str, Any]]]] = {
    JOINTS: _joints,
    HAND: _hand,
    MACHINES: _channels,
    FRAMES: _frames,
    PICTURE: _picture,
    ANNOTATIONS: _marks,
    EVENTS: lambda data: _event(msgspec.json.decode(data)),
}


# -- units ---------------------------------------------------------------------------------------------------

_JOINT_UNITS: Final = {
    "revolute": {"position": "rad", "rate": "rad/s", "torque": "N m", "friction": "N m"},
    "prismatic": {"position": "m", "rate": "m/s", "torque": "N", "friction": "N"},
}
_HAND_UNITS: Final = {"force": "N", "moment": "N m", "gap": "m", "driver_torque": "N m"}
_GUARD_UNITS: Final = {"force": "N", "against": "N", "moment": "N m", "torque": "N m"}
_EVENT_UNITS: Final = {
    "hand": "m", "planned": "m", "gap": "m", "shift": "m", "offset": "m", "difference": "m", "x": "m", "y": "m",
    "yaw": "rad", "lens": "m", "seconds": "s",
}  # fmt: skip


def _unit(message: RawMessage, quantity: tuple[str, ...], arm: ArmModel | None) -> str:
    match quantity:
        case ("joint", name, *what):
            kinds = {} if arm is None else {joint.name: joint.kind for joint in arm.joints}
            return _JOINT_UNITS[kinds[name]][what[0]] if what and name in kinds else ""
        case ("gap",) | ("body", _, "place", _):
            return "m"
        case ("hand", "guards", number, "limit"):
            return _GUARD_UNITS.get(_hand(message.data)["hand"]["guards"][int(number) - 1]["guard"], "")
        case ("channel", name, *_):
            units = {
                each["name"]: each.get("unit", "") for each in msgspec.json.decode(message.data)["channels"]
            }
            return str(units.get(name, ""))
        case ("hand", what, *_):
            return _HAND_UNITS.get(what, "")
    return _event_unit(msgspec.json.decode(message.data), quantity) if message.topic == EVENTS else ""


def _event_unit(event: dict[str, Any], quantity: tuple[str, ...]) -> str:
    match quantity:
        case (_, "value" | "limit" | "friction"):
            return _GUARD_UNITS.get(event.get("guard", ""), "")
        case ("joint", name, what):
            kinds = {each["joint"]["name"]: each["joint"]["kind"] for each in event["joints"]}
            return _JOINT_UNITS[kinds[name]][what] if name in kinds else ""
        case (_, "at", axis):
            return "m" if axis in _AXES[:3] else "rad"
        case (_, what, *_):
            return _EVENT_UNITS.get(what, "")
    return ""


_SHOWN_IN: Final[Mapping[str, str]] = {
    "m": "in", "m/s": "in/s", "rad": "deg", "rad/s": "deg/s", "N": "oz", "N m": "oz in",
}  # fmt: skip
_DECIMALS: Final = 3
_EVENTS: Final[Mapping[str, str]] = {
    "Adjusted": "shifted goal",
    "CameraBusy": "wait for the camera",
    "CameraStarted": "camera's mechanism",
    "ErrorRaised": "error",
    "ErrorTested": "test of an error",
    "GuardFaint": "weak guard",
    "GuardTripped": "stop",
    "HandTold": "place of the hand",
    "OperatorAnswered": "operator's answer",
    "OperatorCalled": "call to the operator",
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
}  # words for the events that have quantities


def quantity_text(quantity: tuple[str, ...]) -> str:
    """Name a quantity in words, such as `position of joint boom`, `place x of body base` or `value of the
    stop`."""
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
    """Return both values as text, with enough decimals to distinguish them, in the units of `measures`. By default,
    these are the units of 1973.
    """
    numbers = [value for value in (found.a, found.b) if _is_number(value)]
    told = iter(_numbers(numbers, found.unit, measures))
    one, other = (
        next(told) if _is_number(value) else "none" if value is None else printable(str(value))
        for value in (found.a, found.b)
    )
    return one, other


def _is_number(value: Value) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _numbers(values: list[Value], unit: str, measures: Measures) -> list[str]:
    """Return the numbers as text in the displayed unit. Numbers that would look equal are given in SI units
    with all digits."""
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
