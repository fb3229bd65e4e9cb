"""The statements of a script by their words, and the names in them: what every check begins with."""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence

from handeye.al.definition import Operand, Refers
from handeye.al.instructions import INSTRUCTIONS
from handeye.al.syntax import Name, Script, Statement, Value

ByWord = Mapping[str, Sequence[Statement]]
"""Statements by their instruction or macro, in the order of the text; those without a word left out."""
Used = Mapping[Refers, Sequence[Name]]
"""Names by what they are to be names of."""
_NAMED = {
    i.op: [(place, operand.refers) for place, operand in enumerate(i.operands) if Name in operand.takes]
    for i in INSTRUCTIONS.values()
}
"""Operands that may be names, by their places."""


def all_statements(script: Script) -> Iterator[Statement]:
    """The statements of a script and of its macros."""
    yield from script.statements
    for macro in script.macros.values():
        yield from macro.body


def by_word(statements: Iterable[Statement]) -> ByWord:
    """Statements by their words."""
    found = defaultdict(list)
    for statement in statements:
        if statement.word is not None:
            found[statement.word.text].append(statement)
    return found


def used_names(words: ByWord) -> Used:
    """Every name that stands for something, by what it stands for."""
    found: dict[Refers, list[Name]] = {refers: [] for refers in Refers}
    for word, statements in words.items():
        for place, refers in _NAMED.get(word, ()):
            found[refers] += [
                value for s in statements if not s.broken and isinstance(value := s.operands[place], Name)
            ]
    found[Refers.POSITION] += [s.word for s in words.get("PARK", ()) if s.word is not None]
    return found


def pairs(statement: Statement) -> Iterable[tuple[Operand, Value | None]]:
    """The operands of an instruction with their definitions; none for a macro or a broken statement."""
    if statement.word is None or statement.broken or not statement.operands:
        return ()
    return zip(INSTRUCTIONS[statement.word.text].operands, statement.operands, strict=True)
