"""The tables that the background level keeps. GET, QUERY and the dashboard use these tables to read the program, its
points, the trace and the host.
"""

from typing import TYPE_CHECKING, Final

from handeye.systems.ml.arithmetic import wrap
from handeye.systems.ml.background.program import StoredProgram
from handeye.systems.ml.errors import MEANINGS, MlError
from handeye.systems.ml.language.commands import COMMANDS
from handeye.systems.ml.language.parser import parsed_line
from handeye.systems.ml.language.syntax import MOTORS, Parameter, Reference, statement_text
from handeye.systems.ml.level import Level, View

if TYPE_CHECKING:
    from handeye.systems.ml.background.interpreter import Interpreter

NUMBERS: Final = {code: number for number, code in enumerate(COMMANDS, 1)}
"""The number of each command. The tables TK, TR and CC contain this number instead of the command's name."""
_SIGN: Final = 8  # the bit above the three bits for the number of ampersands
_PACKED: Final = 4  # parameters whose forms fit into a word


def show_tables(mos: "Interpreter", level: Level) -> None:
    """Let some tables of the real-time level show the data that the interpreter keeps."""
    tables: dict[str, View] = {
        "TK": TaskTable(mos.program), "PT": RecentPoints(mos.program), "CC": CommandCodes(), "ER": ErrorTexts(),
        "TR": TraceBuffer(mos), "LG": SessionLog(mos), "HL": HostLink(mos),
    }  # fmt: skip
    for name, table in tables.items():
        level.view(name, table)


def packed(text: str, word: int) -> int:
    """Return two characters of a text as a word; characters outside ASCII become question marks."""
    pair = text[2 * word - 2 : 2 * word].ljust(2) if 2 * word - 2 < len(text) else "\0\0"
    high, low = pair.encode("ascii", "replace")
    return high << 8 | low


class _ReadOnly:
    """A table that programs cannot write."""

    def write(self, line: int, word: int, value: int) -> None:
        raise MlError("M11", "programs cannot write this table")


class TaskTable:
    """The table TK: the lines of statements. Each line has the number of the command, the 15 parameters, and four
    words for the form in which the parameters are written. The line of a POINT has the number of the command and the
    positions of 12 motors. A line without a statement has zeros.
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
        """Change one position of a filled POINT, or one constant parameter of another statement."""
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


class RecentPoints(_ReadOnly):
    """The table PT: the POINTs that were used last, each with its number and its positions."""

    def __init__(self, program: StoredProgram) -> None:
        self._program = program

    def read(self, line: int, word: int) -> int:
        memory = self._program.memory
        number = memory.recent[line - 1] if line <= len(memory.recent) else 0
        point = memory.points.get(number, ())
        return number if word == 1 else point[word - 2] if word - 2 < len(point) else 0


class CommandCodes(_ReadOnly):
    """The table CC: the first two letters of each command."""

    def read(self, line: int, word: int) -> int:
        return packed([*COMMANDS][line - 1], 1)


class ErrorTexts(_ReadOnly):
    """The table ER: the meanings of the errors M01 to M16, with two characters in each word."""

    def read(self, line: int, word: int) -> int:
        return packed([*MEANINGS.values()][line - 1], word)


class TraceBuffer(_ReadOnly):
    """The table TR: the statements that were executed while TRACE was on. Each line has the number of a statement, the
    number of its command, and its values; the latest statement is in line 1.
    """

    def __init__(self, mos: "Interpreter") -> None:
        self._mos = mos

    def read(self, line: int, word: int) -> int:
        traced = self._mos.memory.traced
        words = traced[-line] if line <= len(traced) else ()
        return words[word - 1] if word <= len(words) else 0


class SessionLog(_ReadOnly):
    """The table LG: the lines that were typed, with two characters in each word. The latest typed line is in line 1."""

    def __init__(self, mos: "Interpreter") -> None:
        self._mos = mos

    def read(self, line: int, word: int) -> int:
        typed = self._mos.memory.typed
        return packed(typed[-line], word) if line <= len(typed) else 0


class HostLink(_ReadOnly):
    """The table HL. Its words say whether there is a session with the host, how many commands went to the host, and
    how many programs were read from it.
    """

    def __init__(self, mos: "Interpreter") -> None:
        self._mos = mos

    def read(self, line: int, word: int) -> int:
        memory = self._mos.memory
        connected = self._mos.host is not None and not memory.closed
        return (int(connected), wrap(memory.sent), wrap(memory.received))[word - 1]
