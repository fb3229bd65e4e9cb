"""The stored program, with the positions of its POINTs."""

from bisect import bisect_left, bisect_right
from functools import lru_cache
from typing import Final

from msgspec import field

from handeye.core.errors import BadFile
from handeye.core.mutable_records import MutableRecord, put_back
from handeye.systems.ml.errors import MlError
from handeye.systems.ml.language.parser import parsed_line
from handeye.systems.ml.language.syntax import Point, Statement, statement_text

RECENT: Final = 8  # POINTs that QPOINT shows


class ProgramMemory(MutableRecord, kw_only=True):
    """The complete state of the stored program."""

    statements: dict[int, str] = field(default_factory=dict)  # texts without positions, by sequence number
    points: dict[int, Point] = field(default_factory=dict)  # positions of those POINTs that are filled
    recent: list[int] = field(default_factory=list)  # POINTs that were used, the last one first


class StoredProgram:
    """The stored program, which both arms share."""

    def __init__(self) -> None:
        self.memory = ProgramMemory()
        self._numbers: list[int] | None = None

    def remember(self, memory: MutableRecord) -> None:
        """Continue from a copy of a state. Raises BadFile if the state is not the state of a program in ML."""
        if not isinstance(memory, ProgramMemory):
            raise BadFile("this is not the state of a program in ML")
        for number, text in memory.statements.items():
            line, _ = parsed_line(f"{number} {text}")
            if line is None or str(line.statement) != text:
                raise BadFile(f"statement {number} cannot be read")
        put_back(self.memory, memory)
        self._numbers = None

    @property
    def numbers(self) -> list[int]:
        """The sequence numbers in ascending order."""
        if self._numbers is None:
            self._numbers = sorted(self.memory.statements)
        return self._numbers

    def store(self, number: int, statement: Statement) -> None:
        """Store a statement; it replaces the stored statement with the same number."""
        self.memory.statements[number] = statement_text(statement.code, statement.parameters)
        self.memory.points.pop(number, None)
        if statement.point:
            self.memory.points[number] = statement.point
        self._numbers = None

    def erase(self, first: int, last: int) -> None:
        """Erase the statements in a range of numbers. Raises MlError (M07) if the range has no statements."""
        gone = self.between(first, last)
        if not gone:
            raise MlError("M07", none_stored(first, last))
        for number in gone:
            del self.memory.statements[number]
            self.memory.points.pop(number, None)
        self._numbers = None

    def clear(self) -> None:
        """Erase everything."""
        put_back(self.memory, ProgramMemory())
        self._numbers = None

    def between(self, first: int, last: int) -> list[int]:
        """Return the sequence numbers of the stored statements in a range."""
        return self.numbers[bisect_left(self.numbers, first) : bisect_right(self.numbers, last)]

    def statement(self, number: int) -> Statement:
        """Return a statement. Raises MlError (M07) if no statement has this number."""
        text = self.memory.statements.get(number)
        if text is None:
            raise MlError("M07", f"there is no statement {number}")
        return _read(text)

    def after(self, number: int) -> int:
        """Return the number of the next statement, or 0 after the last one."""
        at = bisect_right(self.numbers, number)
        return self.numbers[at] if at < len(self.numbers) else 0

    def listing(self, first: int = 1, last: int = 5000) -> list[str]:
        """Return the lines of a listing. The program can be read back from these lines."""
        return [self._line(number) for number in self.between(first, last)]

    def _line(self, number: int) -> str:
        point = self.memory.points.get(number)
        more = "" if point is None else f" * {' '.join(map(str, point))}"
        return f"{number} {self.memory.statements[number]}{more}"

    # -- points ---------------------------------------------------------------------------------------

    def fill(self, number: int, positions: Point) -> None:
        """Give positions to a POINT. Raises MlError (M08) if no POINT has this number."""
        self.check_point(number)
        self.memory.points[number] = positions
        self._use(number)

    def point(self, number: int) -> Point:
        """Return the positions of a POINT. Raises MlError (M08) if no POINT has this number, or if the POINT was never
        filled.
        """
        self.check_point(number)
        if number not in self.memory.points:
            raise MlError("M08", f"POINT {number} was never filled; DEFPOINT {number} fills it")
        self._use(number)
        return self.memory.points[number]

    def check_point(self, number: int) -> None:
        """Raise MlError (M08) if the statement with this number is not a POINT."""
        if self.memory.statements.get(number) != "POINT":
            raise MlError("M08", f"there is no POINT {number}")

    def _use(self, number: int) -> None:
        recent = self.memory.recent
        recent[:] = [number, *(each for each in recent if each != number)][:RECENT]


@lru_cache(maxsize=5000)
def _read(text: str) -> Statement:
    line, _ = parsed_line(text)
    assert line is not None
    return line.statement


def none_stored(first: int, last: int) -> str:
    """Say that there are no statements in a range of numbers."""
    return (
        f"there is no statement {first}"
        if first == last
        else f"there are no statements from {first} to {last}"
    )
