"""Moments too small to be told from joint friction: the arm has no other sense for them than its joint torques."""

from collections.abc import Iterator
from typing import Final

from handeye.al.instructions import INSTRUCTIONS
from handeye.al.names import all_statements, pairs
from handeye.al.syntax import Script, Vector
from handeye.diagnostics import Diagnostic, Label

FLOOR: Final = 20.0
"""oz-in. Measured over nine worlds: straight motions that meet nothing feel up to 17, quick free ones up to 32."""
UPRIGHT_FLOOR: Final = 2.0
"""oz-in, about the vertical, the axis of joint 6 when the hand points down: there up to 1.0 and 1.2 are felt."""
_TAKE_MOMENTS: Final = {
    i.op for i in INSTRUCTIONS.values() if any(operand.name == "moment" for operand in i.operands)
}


def faint_moments(script: Script) -> Iterator[Diagnostic]:
    """A warning for each, of a script whose vectors are in the place of their names."""
    for statement in all_statements(script):
        if statement.word is None or statement.word.text not in _TAKE_MOMENTS:
            continue
        for operand, value in pairs(statement):
            if operand.name == "moment" and isinstance(value, Vector):
                x, y, z = value.values
                upright = x == y == 0
                floor, size = (UPRIGHT_FLOOR if upright else FLOOR), (x * x + y * y + z * z) ** 0.5
                if size < floor:
                    axis = "the vertical" if upright else "an axis that is not vertical"
                    yield Diagnostic(
                        code="faint-moment",
                        message=f"a moment of {size:g} oz-in is less than joint friction is felt as",
                        primary=Label(span=value.span),
                        help=f"about {axis} it should be at least {floor:g} oz-in",
                    )
