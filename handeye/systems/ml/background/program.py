"""The stored program, with the positions of its POINTs, and its appearance in the task table."""

from bisect import bisect_left, bisect_right
from functools import lru_cache
from typing import Final

from msgspec import field

from handeye.core.errors import BadFile
from handeye.core.mutable_records import MutableRecord, put_back
from handeye.systems.ml.arithmetic import wrap
from handeye.systems.ml.errors import MlError
from handeye.systems.ml.language.commands import COMMANDS
from handeye.systems.ml.language.parser import parsed_line
from handeye.systems.ml.language.syntax import MOTORS, Parameter, Point, Reference, Statement, statement_text

RECENT: Final = 8  # POINTs that QPOINT shows
NUMBERS: Final = {code: number for number, code in enumerate(COMMANDS, 1)}
"""Numbers of the commands in the tables TK and CC."""
_SIGN: Final = 8  # beside three bits for the number of ampersands
_PACKED: Final = 4  # parameters whose forms fit into a word


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
        """Continue from a copy of a state. Raises BadFile if it is not sound."""
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
        """Store a statement, in place of the one that has its number."""
        self.memory.statements[number] = statement_text(statement.code, statement.parameters)
        self.memory.points.pop(number, None)
        if statement.point:
            self.memory.points[number] = statement.point
        self._numbers = None

    def erase(self, first: int, last: int) -> None:
        """Erase the statements in a range of numbers. Raises MlError (M07) if there are none."""
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
        """Return the sequence numbers in a range."""
        return self.numbers[bisect_left(self.numbers, first) : bisect_right(self.numbers, last)]

    def statement(self, number: int) -> Statement:
        """Return a statement. Raises MlError (M07)."""
        text = self.memory.statements.get(number)
        if text is None:
            raise MlError("M07", f"there is no statement {number}")
        return _read(text)

    def after(self, number: int) -> int:
        """Return the number of the next statement, or 0 after the last one."""
        at = bisect_right(self.numbers, number)
        return self.numbers[at] if at < len(self.numbers) else 0

    def listing(self, first: int = 1, last: int = 5000) -> list[str]:
        """Return the lines of a listing, which can be read back."""
        return [self._line(number) for number in self.between(first, last)]

    def _line(self, number: int) -> str:
        point = self.memory.points.get(number)
        more = "" if point is None else f" * {' '.join(map(str, point))}"
        return f"{number} {self.memory.statements[number]}{more}"

    # -- points ---------------------------------------------------------------------------------------

    def fill(self, number: int, positions: Point) -> None:
        """Give positions to a POINT. Raises MlError (M08)."""
        self.check_point(number)
        self.memory.points[number] = positions
        self._use(number)

    def point(self, number: int) -> Point:
        """Return the positions of a POINT. Raises MlError (M08)."""
        self.check_point(number)
        if number not in self.memory.points:
            raise MlError("M08", f"POINT {number} was never filled; DEFPOINT {number} fills it")
        self._use(number)
        return self.memory.points[number]

    def check_point(self, number: int) -> None:
        """Raise MlError (M08) unless a statement is a POINT."""
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


class TaskTable:
    """The table TK: the command of a statement, its 15 parameters, and four words with their forms. A POINT has its
    number of command and the positions of 12 motors. A line without a statement has zeros.
    """

    def __init__(self, program: StoredProgram) -> None:
        self._program = program

    def read(self, line: int, word: int) -> int:
        if line not in self._program.memory.statements:
            return 0
        statement = self._program.statement(line)
        if word == 1:
            return NUMBERS[statement.code]
        if statement.code == "POINT":
            point = self._program.memory.points.get(line, ())
            return point[word - 2] if word - 2 < len(point) else 0
        parameters = statement.parameters
        if word - 2 < 15:
            return _value(parameters[word - 2]) if word - 2 < len(parameters) else 0
        forms = [_form(each) for each in parameters[_PACKED * (word - 17) :][:_PACKED]]
        return wrap(sum(form << 4 * at for at, form in enumerate(forms)))

    def write(self, line: int, word: int, value: int) -> None:
        """Change a parameter that is a constant, or a position of a filled POINT."""
        memory = self._program.memory
        if line in memory.points and 1 <= word - 1 <= MOTORS:
            point = [*memory.points[line]]
            point[word - 2] = value
            memory.points[line] = tuple(point)
            return
        if line in memory.statements:
            statement = self._program.statement(line)
            parameters = list(statement.parameters)
            if 0 <= word - 2 < len(parameters) and isinstance(parameters[word - 2], int):
                parameters[word - 2] = value
                changed = statement_text(statement.code, tuple(parameters))
                read, _ = parsed_line(changed)
                if read is not None:
                    memory.statements[line] = str(read.statement)
                    return
        raise MlError("M11", f"word {word} of statement {line} cannot be written")


def _value(parameter: Parameter) -> int:
    match parameter:
        case int():
            return parameter
        case Reference():
            return parameter.index
    return 0


def _form(parameter: Parameter) -> int:
    return parameter.depth | _SIGN * parameter.negative if isinstance(parameter, Reference) else 0


class RecentPoints:
    """The table PT: the POINTs that were used last, each with its number and its positions."""

    def __init__(self, program: StoredProgram) -> None:
        self._program = program

    def read(self, line: int, word: int) -> int:
        memory = self._program.memory
        number = memory.recent[line - 1] if line <= len(memory.recent) else 0
        point = memory.points.get(number, ())
        return number if word == 1 else point[word - 2] if word - 2 < len(point) else 0

    def write(self, line: int, word: int, value: int) -> None:
        raise MlError("M11", "the table PT cannot be written")


class CommandCodes:
    """The table CC: the first two letters of each command."""

    def read(self, line: int, word: int) -> int:
        code = [*COMMANDS][line - 1]
        return ord(code[0]) << 8 | ord(code[1])

    def write(self, line: int, word: int, value: int) -> None:
        raise MlError("M11", "the table CC cannot be written")
