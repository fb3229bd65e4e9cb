"""Named vectors: each name that stands for a vector is replaced by it, so that nothing after this knows names."""

from collections.abc import Mapping
from typing import Final

from msgspec.structs import replace

from handeye.al.definition import Operand, Refers
from handeye.al.instructions import INSTRUCTIONS
from handeye.al.statements import ByWord, pairs
from handeye.al.syntax import Macro, Name, Script, Statement, Value, Vector

Vectors = Mapping[str, tuple[float, ...]]
"""Components by name, in the unit of the place that the name stands at."""
_TAKE_NAMES: Final = {
    i.op for i in INSTRUCTIONS.values() if any(operand.refers is Refers.VECTOR for operand in i.operands)
}
_UNITS: Final = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}


def named_vectors(words: ByWord) -> Vectors:
    """The vectors that have names in a script."""
    known: dict[str, tuple[float, ...]] = dict(_UNITS)
    for statement in words.get("VECT", ()):
        if not statement.broken:
            name, vector = statement.operands
            assert isinstance(name, Name)
            assert isinstance(vector, Vector)
            known[name.text] = vector.values
    return known


def with_vectors(script: Script, known: Vectors) -> Script:
    """The script with vectors in the place of their names."""
    macros = {n: Macro(name=m.name, body=_replaced(m.body, known)) for n, m in script.macros.items()}
    return Script(statements=_replaced(script.statements, known), macros=macros)


def in_place(value: Value | None, operand: Operand, known: Vectors) -> Value | None:
    """A value, or the vector it names; any vector for a name that is reported as unknown."""
    if isinstance(value, Name) and operand.refers is Refers.VECTOR:
        return Vector(value.start, value.end, known.get(value.text, _UNITS["Z"]))
    return value


def _replaced(statements: tuple[Statement, ...], known: Vectors) -> tuple[Statement, ...]:
    return tuple(
        [s if s.word is None or s.word.text not in _TAKE_NAMES else _with(s, known) for s in statements]
    )


def _with(statement: Statement, known: Vectors) -> Statement:
    if not any(isinstance(value, Name) for value in statement.operands) or statement.broken:
        return statement
    return replace(statement, operands=tuple(in_place(v, o, known) for o, v in pairs(statement)))
