"""Shows help, as Markdown, for the word under the pointer."""

import math
from dataclasses import dataclass
from itertools import takewhile
from typing import Final

import numpy as np

from handeye.al.definition import Instruction, OperandUnit
from handeye.al.instructions import DEFINE
from handeye.al.scanner import Line, Token, TokenKind
from handeye.al.syntax import Number, Vector
from handeye.arm.ik import solve
from handeye.arm.model import ArmModel
from handeye.core.errors import ERRORS
from handeye.core.pose import Pose, hand_angles
from handeye.core.source import Span, line_name
from handeye.core.units import DEGREE, INCH
from handeye.editor.checking import arm
from handeye.editor.document import Document
from handeye.editor.occurrences import MACRO, PART, POSITION, Occurrence, same
from handeye.editor.places import OperandToken, instruction, places
from handeye.program.world_model import WorldModel

SI: Final = {
    "in": ("mm", 1e-3),
    "in/s": ("mm/s", 1e-3),
    "mm": ("in", INCH),
    "degrees": ("rad", 1.0),
    "oz": ("N", 1.0),
    "oz-in": ("N m", 1.0),
    "rpm": ("rad/s", 1.0),
}  # for each unit as written: the other unit shown, and its SI value


@dataclass(frozen=True, slots=True, kw_only=True)
class Hover:
    """A help text in Markdown, and the span to which it belongs."""

    span: Span
    text: str


def hover(document: Document, offset: int) -> Hover | None:
    """Return help for the token at an offset, or None if there is no help for it."""
    line = document.line_at(offset)
    if line is None:
        return None
    token = next((t for t in line.tokens if t.start <= offset < t.end), None)
    text = None if token is None else _text(document, line, token)
    return None if token is None or text is None else Hover(span=token.span, text=text)


def _text(document: Document, line: Line, token: Token) -> str | None:
    definition, tokens = instruction(line)
    if definition is not None and token == tokens[0]:
        return about_instruction(definition)
    if tokens and token == tokens[0] and token.text.upper() == DEFINE.op:
        return about_instruction(DEFINE)
    name = document.name_at(token.start)
    if name is not None and name.span == token.span:
        return _about_name(document, name)
    if definition is None:
        return None
    place = next((p for p in places(definition, tokens[1:]) if p.token == token), None)
    return None if place is None else _about_value(definition, place)


def about_instruction(definition: Instruction) -> str:
    """Return the usage, meaning and origin of an instruction."""
    return f"`{definition.usage}`\n\n{definition.help}\n\n*origin: {definition.origin}*"


def _about_value(definition: Instruction, place: OperandToken) -> str | None:
    operand, token = place.operand, place.token
    if operand is None:
        return None
    if operand.word and token.text.upper() == operand.word:
        return f"`{definition.usage}`"
    if token.kind is not TokenKind.NUMBER:
        return None
    try:
        value = float(token.text)
    except ValueError:
        return None
    if operand.whole and operand.name == "error" and value in ERRORS:
        return f"error {int(value)}: {ERRORS[int(value)]}"
    vector = Vector in operand.takes and (Number not in operand.takes or place.component > 0)
    units = operand.units
    unit = units[place.component] if vector and place.component < len(units) else units[0] if units else None
    letters = operand.components or (operand.name,)
    name = letters[place.component] if len(letters) == len(units) else operand.name
    return f"{name}: {in_both_units(value, unit)}" if unit is not None else None


def in_both_units(value: float, unit: OperandUnit) -> str:
    """Return a quantity both as written and converted to the other system of units."""
    if unit.name not in SI:
        return f"{value:g} {unit.name}".rstrip()
    other, scale = SI[unit.name]
    return f"{value:g} {unit.name} = {value * unit.si / scale:.4g} {other}"


def _about_name(document: Document, name: Occurrence) -> str | None:
    title = f"{name.kind} `{name.name}`"
    if name.kind == POSITION:
        return "\n\n".join([title, *_position(document, name.name)])
    if name.kind == PART and name.name in document.taught.parts:
        x, y, z, turn = document.taught.parts[name.name].at
        return f"{title}\n\nplanned at {_inches(x, y, z)} in, turned {turn / DEGREE:g} deg"
    everywhere = [*((document.source, own) for own in document.names), *document.required_names]
    made = [(text, text.position(o.span.start)[0]) for text, o in everywhere if o.makes and same(o, name)]
    if not made:
        return None
    lines = ", ".join(line_name(line, text.key) for text, line in made)
    shown = [text.line(line) for text, line in made]
    if name.kind == MACRO:
        text, line = made[0]
        shown = [*takewhile(str.strip, text.text.split("\n")[line - 1 :])]
    return f"{title}, line {lines}\n\n```armal\n" + "\n".join(shown) + "\n```"


def _position(document: Document, name: str) -> list[str]:
    position = document.positions.get(name)
    if position is None:
        return []
    if position.of is not None and position.of not in document.taught.parts:
        return [f"relative to part `{position.of}`, which is not in the taught file"]
    world = WorldModel(parts=document.taught.parts, positions={name: position})
    X_WT = world.planned_position(name)
    out = [
        f"hand at {_six(X_WT[:3, 3].tolist(), hand_angles(X_WT))}" + (", as planned" if position.of else "")
    ]
    if position.of is not None:
        out.append(f"relative to part `{position.of}`: {_six(position.at[:3], position.at[3:])}")
    return [*out, joints(arm(), X_WT)]


def joints(arm: ArmModel, X_WT: Pose) -> str:
    """Return the joint positions for a hand pose, or the reason why there are none. The solver starts from the
    middle of the joint ranges.
    """
    result = solve(arm, X_WT, arm.middle)
    if result.q is None:
        return f"out of the arm's reach: {result.message(arm)}"
    shown = [
        f"{joint.name} {q / INCH:.1f} in" if joint.kind == "prismatic" else f"{joint.name} {q / DEGREE:.1f}°"
        for joint, q in zip(arm.joints, result.q, strict=True)
    ]
    return "joints: " + ", ".join(shown)


def _six(p: "list[float] | tuple[float, ...]", angles: tuple[float, ...]) -> str:
    turned = ", ".join(f"{round(math.degrees(a), 2) + 0.0:g}" for a in angles)
    return f"{_inches(*p)} in; O, A, T {turned} degrees"


def _inches(*p: float) -> str:
    return "(" + ", ".join(f"{round(float(np.float64(x)) / INCH, 3) + 0.0:g}" for x in p) + ")"
