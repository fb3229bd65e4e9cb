"""Converts statements to operations. This module also converts inches, degrees and ounces to SI units."""

import math
from collections.abc import Callable, Sequence
from typing import Final

import msgspec
from msgspec.structs import replace

from handeye.al.instructions import INSTRUCTIONS
from handeye.al.syntax import Name, Number, Statement, Text, Value, Vector
from handeye.core.record import Vector3
from handeye.core.units import INCH, OUNCE_FORCE
from handeye.program import guards as g
from handeye.program.flow_operations import (
    Advance,
    Assign,
    Countdown,
    Here,
    Jump,
    Load,
    Save,
    Search,
    Test,
    Tool,
    Undo,
    Wait,
    Where,
)
from handeye.program.motion_operations import Center, Change, Close, Height, Move, Open, Restore, Travel, Turn
from handeye.program.operations import AnyOperation
from handeye.program.program import Position
from handeye.program.vision_operations import Aim, General, Inspect, Lens, Look, Match, Specific

PLACE_DEPTH: Final = 3.0 * INCH  # in m: the height of an approach
PLACE_FORCE: Final = 50.0 * OUNCE_FORCE
"""The first stop force (N) of the pin insertion of 1973. It is more than three times the vertical force that joint
friction can hide from the hand.
"""
SEARCH_STEPS: Final = 3  # to each side
LINE_STEPS: Final = 4  # to each side, along a line
_OPERANDS: Final = {
    i.op: {
        o.name or o.word: (place, tuple(unit.si for unit in o.units)) for place, o in enumerate(i.operands)
    }
    for i in INSTRUCTIONS.values()
}  # index and SI units of each operand, by instruction


class Operands(msgspec.Struct, frozen=True, gc=False):
    """The operands of a checked statement. The methods find an operand by its name and return its value in SI units."""

    values: tuple[Value | None, ...]
    places: dict[str, tuple[int, tuple[float, ...]]]

    def has(self, key: str) -> bool:
        """Return True if an optional operand or word is present."""
        return self.values[self.places[key][0]] is not None

    def number(self, key: str) -> float:
        place, units = self.places[key]
        value = self.values[place]
        assert isinstance(value, Number)
        return value.value * units[0]

    def vector(self, key: str) -> tuple[float, ...]:
        place, units = self.places[key]
        value = self.values[place]
        assert isinstance(value, Vector)
        return tuple([x * si for x, si in zip(value.values, units, strict=True)])

    def vector3(self, key: str) -> Vector3:
        x, y, z = self.vector(key)
        return x, y, z

    def vector3_or(self, key: str) -> Vector3 | None:
        return self.vector3(key) if isinstance(self.values[self.places[key][0]], Vector) else None

    def number_or(self, key: str) -> float | None:
        return self.number(key) if isinstance(self.values[self.places[key][0]], Number) else None

    def names(self) -> tuple[str, ...]:
        """Return the operands that are names, in order."""
        return tuple([value.text for value in self.values if isinstance(value, Name)])

    def name(self, key: str) -> str:
        value = self.values[self.places[key][0]]
        assert isinstance(value, (Name, Text))
        return value.text


def _operands(statement: Statement) -> Operands:
    assert statement.word is not None
    return Operands(statement.operands, _OPERANDS[statement.word.text])


class _Modifiers(msgspec.Struct, frozen=True, kw_only=True):
    """The settings that the modifiers of a motion make."""

    guards: g.Guards = ()
    press: Vector3 | None = None
    free: Vector3 | None = None
    moment: Vector3 | None = None
    spin: Vector3 | None = None
    via: tuple[str, ...] = ()


_UNMODIFIED: Final = _Modifiers()


def operation(statement: Statement, modifiers: Sequence[Statement]) -> AnyOperation:
    """Make the operation of a statement with its modifiers. Jumps and skips have no targets yet."""
    assert statement.word is not None
    how = _UNMODIFIED
    for modifier in modifiers:
        assert modifier.word is not None
        word, operands = modifier.word.text, _operands(modifier)
        how = _MODIFIERS[word](how, operands)
    motion = _MOTIONS.get(statement.word.text)
    if motion is not None:
        return motion(_operands(statement), how)
    return _STEPS[statement.word.text](_operands(statement))


def position(statement: Statement) -> tuple[str, Position]:
    """Return the name and the position that a `TRANS` defines."""
    operands = _operands(statement)
    x, y, z, o, a, t = operands.vector("[x y z o a t]")
    of = operands.name("part") if operands.has("part") else None
    return operands.name("name"), Position(at=(x, y, z, o, a, t), of=of)


def restore(statement: Statement) -> Restore:
    """Return the shift that a `RESTORE` adds to its `MOVE`."""
    operands = _operands(statement)
    return Restore(name=operands.name("name"), level=operands.has("LEVEL"))


def _stop(operands: Operands) -> g.Guards:
    force, against = operands.vector3_or("force"), operands.number_or("force")
    moment = operands.vector3_or("moment")
    return (
        *(() if force is None else (g.Force(force=force),)),
        *(() if against is None else (g.Against(force=against),)),
        *(() if moment is None else (g.Moment(moment=moment),)),
    )


def _change(operands: Operands, how: _Modifiers) -> Change:
    x, y, z = operands.vector3("[x y z]")
    scale = operands.number("distance") / math.hypot(x, y, z)
    return Change(
        displacement=(x * scale, y * scale, z * scale), speed=operands.number_or("speed") or None,
        guards=how.guards, press=how.press, free=how.free, moment=how.moment, spin=how.spin,
    )  # fmt: skip


def _search(operands: Operands) -> Search:
    along = operands.number_or("direction")
    steps = round(operands.number_or("number") or (SEARCH_STEPS if along is None else LINE_STEPS))
    width = 2 * steps + 1
    return Search(step=operands.number("step"), limit=width**2 if along is None else width, along=along)


_MODIFIERS: Final[dict[str, Callable[[_Modifiers, Operands], _Modifiers]]] = {
    "FORCE": lambda how, o: replace(how, press=o.vector3_or("force"), moment=o.vector3_or("moment")),
    "FREE": lambda how, o: replace(how, free=o.vector3("[x y z]")),
    "SPIN": lambda how, o: replace(how, spin=o.vector3("[x y z]")),
    "VIA": lambda how, o: replace(how, via=o.names()),
    "STOP": lambda how, o: replace(how, guards=_stop(o)),
    "TORQUE": lambda how, o: replace(how, guards=(g.Torque(torque=o.number("torque")),)),
    "TOUCH": lambda how, o: replace(how, guards=(g.Touch(fingers=int(o.number("mask"))),)),
}
_MOTIONS: Final[dict[str, Callable[[Operands, _Modifiers], AnyOperation]]] = {
    "MOVE": lambda o, how: Move(
        goal=o.name("position"), direct=o.has("DIRECT"), guards=how.guards, via=how.via
    ),
    "PARK": lambda _, how: Move(goal="PARK", guards=how.guards, via=how.via),
    "TURN": lambda o, how: Turn(centre=o.name("position"), angle=o.number("angle"), guards=how.guards),
    "CHANGE": _change,
    "PLACE": lambda _, __: Change(
        displacement=(0.0, 0.0, -PLACE_DEPTH), guards=(g.Force(force=(0.0, 0.0, -PLACE_FORCE)),)
    ),
}
_STEPS: Final[dict[str, Callable[[Operands], AnyOperation]]] = {
    "OPEN": lambda o: Open(gap=o.number("gap")),
    "CLOSE": lambda o: Close(minimum=o.number_or("minimum") or 0.0, maximum=o.number_or("maximum")),
    "CENTER": lambda o: Center(minimum=o.number_or("minimum") or 0.0),
    "SEARCH": _search,
    "SKIPE": lambda o: Test(number=int(o.number("error")), raised=None),
    "SKIPN": lambda o: Test(number=int(o.number("error")), raised=None),
    "AOJ": lambda _: Advance(),
    "ASSIGN": lambda o: Assign(counter=o.name("counter"), value=int(o.number("value"))),
    "SOJG": lambda o: Countdown(counter=o.name("counter"), positive=None),
    "JUMP": lambda _: Jump(),
    "WAIT": lambda o: Wait(message=o.name("text")),
    "UNDO": lambda o: Undo(times=int(o.number_or("number") or 1)),
    "SAVE": lambda o: Save(name=o.name("name")),
    "HERE": lambda o: Here(position=o.name("name")),
    "WHERE": lambda _: Where(),
    "TRAVEL": lambda o: Travel(minimum=o.number("minimum"), maximum=o.number("maximum")),
    "HEIGHT": lambda o: Height(name=o.name("name"), minimum=o.number("minimum"), maximum=o.number("maximum")),
    "TOOL": lambda o: Tool(speed=o.number("speed")),
    "LOAD": lambda o: Load(weight=o.number("weight")),
    "LENS": lambda o: Lens(focal_length=o.number("mm")),
    "AIM": lambda o: Aim(target=o.name("name")),
    "LOOK": lambda o: Look(picture=o.name("picture"), hold_target=o.has("HOLD")),
    "GENERAL": lambda o: General(part=o.name("part"), picture=o.name("picture")),
    "SPECIFIC": lambda o: Specific(part=o.name("part"), picture=o.name("picture")),
    "INSPECT": lambda o: Inspect(part=o.name("part"), before=o.name("before"), after=o.name("after")),
    "MATCH": lambda o: Match(part=o.name("part"), before=o.name("before"), after=o.name("after")),
}
