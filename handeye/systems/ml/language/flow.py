"""Determines which statements of a stored program may follow each statement."""

from bisect import bisect_right
from collections.abc import Iterator, Mapping
from functools import cached_property

from handeye.systems.ml.language.commands import COMMANDS
from handeye.systems.ml.language.syntax import Parameter, Reference, Statement

ENDS = {"STOP", "EXIT", "CMSLOAD"}  # CMSLOAD replaces the program
JUMPS = {"BRANCH", "IF", "BAL", "GOSUB"}
_LOOPS = {"LOOPI": "NEXTI", "LOOPJ": "NEXTJ"}


class Flow:
    """The paths through a program. The program is given by its statements and their sequence numbers."""

    def __init__(self, statements: Mapping[int, Statement]) -> None:
        self.statements = statements
        self.numbers = sorted(statements)

    def after(self, number: int) -> int | None:
        """Return the number of the next statement, or None after the last one."""
        at = bisect_right(self.numbers, number)
        return self.numbers[at] if at < len(self.numbers) else None

    def ways(self, number: int, *, likely: bool = False) -> tuple[int | None, ...]:
        """Return the numbers of the statements that may follow a statement, with None for the end. A computed branch
        may lead to any statement. A computed branch takes the number of the next statement from a variable. If
        `likely` is True, only the numbers that a BAL or a LOAD of the program puts into this variable are considered.
        """
        return tuple(dict.fromkeys(self._ways(number, likely)))

    def _ways(self, number: int, likely: bool) -> Iterator[int | None]:
        statement, after = self.statements[number], self.after(number)
        code = statement.code
        for target in targets(statement):
            yield from self._places(target, likely)
        if code in ("RUN", "TRY") and not statement.parameters:
            yield self.numbers[0]
        elif code in ("BRCOMP", "BROVFL") and len(statement.parameters) == 1:
            yield after
        elif code == "RETURN":
            yield from map(self.after, self._having("GOSUB"))
        elif code in _LOOPS:
            yield after
            ends = (each for each in self._having(_LOOPS[code]) if each > number)
            yield from map(self.after, list(ends)[:1])
        elif code in _LOOPS.values():
            yield after
            yield from map(self.after, self._having(code.replace("NEXT", "LOOP")))
        elif code in ENDS:
            yield None
        elif not any(targets(statement)):
            yield after

    def _places(self, target: Parameter, likely: bool) -> Iterator[int]:
        if isinstance(target, Reference):
            plain = target.depth == 1 and not target.negative
            yield from self._loaded.get(target.index, ()) if likely and plain else self.numbers
        elif isinstance(target, int) and target in self.statements:
            yield target

    def _having(self, code: str) -> Iterator[int]:
        return (number for number in self.numbers if self.statements[number].code == code)

    @cached_property
    def _loaded(self) -> dict[int, list[int]]:
        """For each variable, the numbers of statements that BAL and LOAD put into it."""
        found: dict[int, list[int]] = {}
        for number, statement in self.statements.items():
            match statement.code, statement.parameters:
                case "BAL", (int(variable), _):
                    found.setdefault(variable, []).extend(filter(None, [self.after(number)]))
                case "LOAD", (int(variable), int(value)) if value in self.statements:
                    found.setdefault(variable, []).append(value)
        return found


def targets(statement: Statement) -> tuple[Parameter, ...]:
    """Return the parameters with which a statement says where the program continues."""
    if statement.code not in JUMPS | {"BRCOMP", "BROVFL", "RUN", "TRY"}:
        return ()
    command = COMMANDS[statement.code]
    return tuple(each for at, each in enumerate(statement.parameters) if command.kind(at) == "statement")
