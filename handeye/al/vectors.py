"""Named vectors: each name that stands for a vector is replaced by it, so that nothing after this knows names."""

from typing import Final

from msgspec.structs import replace

from handeye.al.definition import Refers
from handeye.al.instructions import INSTRUCTIONS
from handeye.al.names import all_statements, pairs
from handeye.al.syntax import Macro, Name, Script, Statement, Value, Vector

_TAKE_NAMES: Final = {
    i.op for i in INSTRUCTIONS.values() if any(operand.refers is Refers.VECTOR for operand in i.operands)
}
_UNITS: Final = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}


def with_vectors(script: Script) -> Script:
    """The script with vectors in the place of their names; any vector for a name that is reported as unknown."""
    known = dict(_UNITS)
    for statement in all_statements(script):
        if statement.word is not None and statement.word.text == "VECT" and not statement.broken:
            name, vector = statement.operands
            assert isinstance(name, Name)
            assert isinstance(vector, Vector)
            x, y, z = vector.values
            known[name.text] = (x, y, z)
    macros = {n: Macro(name=m.name, body=_replaced(m.body, known)) for n, m in script.macros.items()}
    return Script(statements=_replaced(script.statements, known), macros=macros)


def _replaced(
    statements: tuple[Statement, ...], known: dict[str, tuple[float, float, float]]
) -> tuple[Statement, ...]:
    return tuple(_with(statement, known) for statement in statements)


def _with(statement: Statement, known: dict[str, tuple[float, float, float]]) -> Statement:
    if statement.word is None or statement.word.text not in _TAKE_NAMES:
        return statement
    operands: list[Value | None] = []
    changed = False
    for operand, value in pairs(statement):
        if isinstance(value, Name) and operand.refers is Refers.VECTOR:
            value, changed = Vector(known.get(value.text, _UNITS["Z"]), value.span), True
        operands.append(value)
    return replace(statement, operands=tuple(operands)) if changed else statement
