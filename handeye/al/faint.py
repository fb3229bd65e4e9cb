"""Forces and moments too small to be told from joint friction: the arm has no other sense for them than its joint
torques.
"""

import math
from collections.abc import Iterator
from typing import Final

from handeye.al.instructions import INSTRUCTIONS
from handeye.al.names import all_statements, pairs
from handeye.al.syntax import Number, Script, Vector
from handeye.diagnostics import Diagnostic, Label

FORCE_FLOOR: Final = 2.0
"""oz. Measured over nine worlds: 216 straight motions that met nothing felt less along their way."""
FLOOR: Final = 20.0
"""oz-in. Measured over nine worlds: straight motions that meet nothing feel up to 17, quick free ones up to 32."""
UPRIGHT_FLOOR: Final = 2.0
"""oz-in, about the vertical, the axis of joint 6 when the hand points down: there up to 1.0 and 1.2 are felt."""
_FELT: Final = {
    i.op for i in INSTRUCTIONS.values() if any(operand.name in ("force", "moment") for operand in i.operands)
}


def faint(script: Script) -> Iterator[Diagnostic]:
    """A warning for each, of a script whose vectors are in the place of their names."""
    for statement in all_statements(script):
        if statement.word is None or statement.word.text not in _FELT:
            continue
        for operand, value in pairs(statement):
            if not isinstance(value, Vector | Number):
                continue
            if operand.name == "moment" and isinstance(value, Vector):
                yield from _faint_moment(value)
            elif operand.name == "force" and statement.word.text == "STOP":
                yield from _faint_force(value)


def _faint_moment(moment: Vector) -> Iterator[Diagnostic]:
    x, y, z = moment.values
    upright = x == y == 0
    floor, size = (UPRIGHT_FLOOR if upright else FLOOR), math.hypot(x, y, z)
    if size < floor:
        axis = "the vertical" if upright else "an axis that is not vertical"
        yield Diagnostic(
            code="faint-moment",
            message=f"a moment of {size:g} oz-in is less than joint friction is felt as",
            primary=Label(span=moment.span),
            help=f"about {axis} it should be at least {floor:g} oz-in",
        )


def _faint_force(force: Vector | Number) -> Iterator[Diagnostic]:
    size = math.hypot(*force.values) if isinstance(force, Vector) else force.value
    if size < FORCE_FLOOR:
        yield Diagnostic(
            code="faint-force",
            message=f"a force of {size:g} oz is less than joint friction is felt as",
            primary=Label(span=force.span),
            help=f"it should be at least {FORCE_FLOOR:g} oz",
        )
