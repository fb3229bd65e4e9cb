"""Named vectors: each name that stands for a vector is replaced by it, so that nothing after this knows names."""

from collections.abc import Mapping
from typing import Final

from msgspec.structs import replace

from handeye.al.definition import Operand, Refers
from handeye.al.instructions import INSTRUCTIONS
from handeye.al.statements import ByWord, pairs
from handeye.al.syntax import Name, Statement, Value, Vector

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


def with_vectors(statement: Statement, known: Vectors) -> Statement:
    """A statement with vectors in the place of their names."""
    named = statement.word is not None and statement.word.text in _TAKE_NAMES
    if not named or statement.broken or not any(isinstance(value, Name) for value in statement.operands):
        return statement
    return replace(statement, operands=tuple(in_place(v, o, known) for o, v in pairs(statement)))


def in_place(value: Value | None, operand: Operand, known: Vectors) -> Value | None:
    """A value, or the vector it names; any vector for a name that is reported as unknown."""
    if isinstance(value, Name) and operand.refers is Refers.VECTOR:
        return Vector(value.start, value.end, known.get(value.text, _UNITS["Z"]))
    return value
