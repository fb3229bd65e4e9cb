"""Forces and moments too small to be told from joint friction: the arm has no other sense for them than its joint
torques.
"""

import math
from collections.abc import Iterator
from typing import Final

from handeye.al.instructions import INSTRUCTIONS
from handeye.al.statements import ByWord, pairs
from handeye.al.syntax import Number, Vector
from handeye.al.vectors import Vectors, in_place
from handeye.diagnostics import Diagnostic, Label

FORCE_FLOOR: Final = 2.0
"""oz. Measured over nine worlds: 216 straight motions that met nothing felt less along their way."""
FLOOR: Final = 20.0
"""oz-in. Measured over nine worlds: straight motions that meet nothing feel up to 17, quick free ones up to 32."""
UPRIGHT_FLOOR: Final = 2.0
"""oz-in, about the vertical, the axis of joint 6 when the hand points down: there up to 1.0 and 1.2 are felt."""
_FELT: Final = [
    i.op for i in INSTRUCTIONS.values() if any(operand.name in ("force", "moment") for operand in i.operands)
]


def faint(words: ByWord, vectors: Vectors) -> Iterator[Diagnostic]:
    """A warning for each, of a script without mistakes."""
    for op in _FELT:
        for statement in words.get(op, ()):
            for operand, value in pairs(statement):
                meant = in_place(value, operand, vectors)
                if operand.name == "moment" and isinstance(meant, Vector):
                    yield from _faint_moment(meant)
                elif operand.name == "force" and op == "STOP" and isinstance(meant, Vector | Number):
                    yield from _faint_force(meant)


def _faint_moment(moment: Vector) -> Iterator[Diagnostic]:
    x, y, z = moment.values
    upright = x == y == 0
    floor, size = (UPRIGHT_FLOOR if upright else FLOOR), math.hypot(x, y, z)
    if size < floor:
        axis = "the vertical" if upright else "an axis that is not vertical"
        yield Diagnostic(
            code="faint-moment",
            message=f"a moment of {size:g} oz-in is below the noise of joint friction",
            primary=Label(span=moment.span),
            help=f"use at least {floor:g} oz-in about {axis}",
        )


def _faint_force(force: Vector | Number) -> Iterator[Diagnostic]:
    size = math.hypot(*force.values) if isinstance(force, Vector) else force.value
    if size < FORCE_FLOOR:
        yield Diagnostic(
            code="faint-force",
            message=f"a force of {size:g} oz is below the noise of joint friction",
            primary=Label(span=force.span),
            help=f"use at least {FORCE_FLOOR:g} oz",
        )
