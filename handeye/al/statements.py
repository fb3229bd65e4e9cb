"""Groups the statements of a script by their first word, and collects the names that the statements use."""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Final

from msgspec.structs import replace

from handeye.al.definition import Operand, Refers
from handeye.al.instructions import INSTRUCTIONS
from handeye.al.syntax import Name, Script, Statement, Value, Vector

ByWord = Mapping[str, Sequence[Statement]]  # statements by instruction or macro, in text order
Used = Mapping[Refers, Sequence[Name]]  # names by the kind of object they refer to
_NAMED = {
    i.op: [(place, operand.refers) for place, operand in enumerate(i.operands) if Name in operand.takes]
    for i in INSTRUCTIONS.values()
}  # indices of operands that may be names


def all_statements(script: Script) -> Iterator[Statement]:
    """Yield the statements of a script and of its macros."""
    yield from script.statements
    for macro in script.macros.values():
        yield from macro.body


def by_word(statements: Iterable[Statement]) -> ByWord:
    """Group statements by word."""
    found = defaultdict(list)
    for statement in statements:
        if statement.word is not None:
            found[statement.word.text].append(statement)
    return found


def used_names(words: ByWord) -> Used:
    """Collect the names of objects in a script. Returns a list of names for each kind of object."""
    found: dict[Refers, list[Name]] = {refers: [] for refers in Refers}
    for word, statements in words.items():
        for place, refers in _NAMED.get(word, ()):
            found[refers] += [
                value for s in statements if not s.broken and isinstance(value := s.operands[place], Name)
            ]
    found[Refers.POSITION] += [s.word for s in words.get("PARK", ()) if s.word is not None]
    return found


def pairs(statement: Statement) -> Iterable[tuple[Operand, Value | None]]:
    """Pair the definition of each operand of a statement with the value of the operand. Returns no pairs for a
    macro call or a statement with an error.
    """
    if statement.word is None or statement.broken or not statement.operands:
        return ()
    return zip(INSTRUCTIONS[statement.word.text].operands, statement.operands, strict=True)


Vectors = Mapping[str, tuple[float, ...]]  # components by name, in the unit of the operand
_TAKE_NAMES: Final = {
    i.op for i in INSTRUCTIONS.values() if any(o.refers is Refers.VECTOR for o in i.operands)
}
_UNITS: Final = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}


def named_vectors(words: ByWord) -> Vectors:
    """Collect the named vectors of a script, including the axes."""
    known: dict[str, tuple[float, ...]] = dict(_UNITS)
    for statement in words.get("VECT", ()):
        if not statement.broken:
            name, vector = statement.operands
            assert isinstance(name, Name)
            assert isinstance(vector, Vector)
            known[name.text] = vector.values
    return known


def with_vectors(statement: Statement, known: Vectors) -> Statement:
    """Replace the names of vectors in a statement by the vectors."""
    named = statement.word is not None and statement.word.text in _TAKE_NAMES
    if not named or statement.broken or not any(isinstance(value, Name) for value in statement.operands):
        return statement
    operands = [  # an unknown name gives an arbitrary vector
        Vector(value.start, value.end, known.get(value.text, _UNITS["Z"]))
        if isinstance(value, Name) and operand.refers is Refers.VECTOR
        else value
        for operand, value in pairs(statement)
    ]
    return replace(statement, operands=tuple(operands))
