"""Compiles lines to the code of a stack machine."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import Final, Literal, NamedTuple

from handeye.core.diagnostics import Diagnostic, has_errors
from handeye.core.errors import BadFile
from handeye.core.source import Source
from handeye.systems.sigma.mal.check import checked
from handeye.systems.sigma.mal.scanner import Token
from handeye.systems.sigma.mal.syntax import (
    MAIN,
    Binary,
    Call,
    Expression,
    Line,
    Number,
    Statement,
    Text,
    Unary,
    Variable,
)
from handeye.systems.sigma.protocol import AXES, LINE_AXES, LINE_NUMBERS, NUMBERS

Op = Literal[
    "PUSHC", "PUSHV", "POPV", "ADD", "SUB", "MUL", "DIV", "NEG", "EQ", "NE", "LT", "GT", "LE", "GE", "AND", "OR",
    "NOT", "ABS", "INT", "SGN", "SQR", "POS", "STAT", "FORCE", "CRASHPOS", "BEAM", "TIME",
    "JMP", "JZ", "NEXTLINE", "GO", "CALL", "RET", "FOR", "NEXT", "END", "HALT", "FAIL",
    "START", "KILL", "SETF", "CLRF", "WAITF", "TAKEF", "SLEEP",
    "GOAL", "SPEEDS", "CMD", "BUSYWAIT", "ORIG", "FOUND", "LIMSPEED", "CURVE", "THRESHOLD", "ACT",
    "OUT", "TAB", "EOL", "IN", "TRAP", "RESUME",
]  # fmt: skip
ARITHMETIC: Final = {
    "ADD", "SUB", "MUL", "DIV", "NEG", "EQ", "NE", "LT", "GT", "LE", "GE", "AND", "OR", "NOT", "ABS", "INT", "SGN",
    "SQR",
}  # fmt: skip
"""Arithmetic instructions; each costs the central computer additional time."""
_OPERATORS: Final[dict[str, Op]] = {
    "+": "ADD", "-": "SUB", "*": "MUL", "/": "DIV", "=": "EQ", "<>": "NE", "<": "LT", ">": "GT", "<=": "LE",
    ">=": "GE", "AND": "AND", "OR": "OR",
}  # fmt: skip
_FUNCTIONS: Final[dict[str, Op]] = {
    "ABS": "ABS", "INT": "INT", "SGN": "SGN", "SQR": "SQR", "POS": "POS", "FORCE": "FORCE", "CRASHPOS": "CRASHPOS",
    "STATUS": "STAT", "BEAM": "BEAM", "TIME": "TIME",
}  # fmt: skip
_SETTINGS: Final[dict[str, Op]] = {"SPEED": "LIMSPEED", "CURVE": "CURVE", "LIMIT": "THRESHOLD"}


_BEYOND: Final = frozenset({*LINE_AXES, *LINE_NUMBERS}) - {*NUMBERS}
Operand = float | str | tuple[str, ...] | None


class Instruction(NamedTuple):
    """An instruction of the stack machine with its operand. `target` is the address to which a jump leads."""

    op: Op
    operand: Operand = None
    target: int = -1


@dataclass(frozen=True, slots=True, kw_only=True)
class CompiledLine:
    """An executable line. `begin` is the address at which the line's code begins."""

    number: int
    task: str
    text: str
    row: int
    begin: int
    word: str
    ways: tuple[int | None, ...] = ()  # indices of the lines that may follow in its task; None: the task ends


@dataclass(frozen=True, kw_only=True)
class MalProgram:
    """A compiled program."""

    name: str
    text: str
    code: tuple[Instruction, ...]
    lines: tuple[CompiledLine, ...]
    tasks: dict[str, int]
    """Address of the first instruction of each task, with MAIN first."""
    texts: dict[int, str] = field(repr=False, default_factory=dict)
    """All lines by number, including remarks, in ascending order."""
    statements: tuple[Line, ...] = field(repr=False, default=())
    """The syntax trees of `lines`."""

    @cached_property
    def beyond(self) -> CompiledLine | None:
        """The first line that uses an axis or a hand that only the assembly line has; None if SUPERSIGMA has every
        axis and hand that the program uses.
        """
        for address, each in enumerate(self.code):
            names = each.operand if isinstance(each.operand, tuple) else (each.operand,)
            if any(name in _BEYOND for name in names):
                return self.line_of(address)
        return None

    def check_alone(self) -> None:
        """Raise BadFile if the program uses an axis or a hand that only the assembly line has. A missing microcomputer
        reports nothing, so the program would not notice that the microcomputer is missing.
        """
        if self.beyond is not None:
            raise BadFile(
                f"line {self.beyond.number} of {self.name} uses an axis or a hand that only the assembly line has; "
                "`handeye sigma line FILE.mal` runs such programs"
            )

    @property
    def axes(self) -> tuple[str, ...]:
        """The axes of the machine for which the program is written."""
        return AXES if self.beyond is None else LINE_AXES

    @property
    def hands(self) -> int:
        """Number of hand microcomputers of the machine for which the program is written."""
        return sum(name.startswith("HAND") for name in (NUMBERS if self.beyond is None else LINE_NUMBERS))

    @cached_property
    def line_at(self) -> tuple[int, ...]:
        """For each address, the index of the line to which the address belongs. The END after a task belongs to the
        task's last line.
        """
        owners, at = [], 0
        begins = {line.begin: number for number, line in enumerate(self.lines)}
        for address in range(len(self.code)):
            at = begins.get(address, at)
            owners.append(at)
        return tuple(owners)

    @cached_property
    def closing(self) -> frozenset[int]:
        """Addresses of the ENDs that follow the last line of each task."""
        firsts = sorted(self.tasks.values())
        return frozenset(begin - 1 for begin in (*firsts[1:], len(self.code)))

    def line_of(self, address: int) -> CompiledLine:
        """Return the program line whose code contains an address."""
        return self.lines[self.line_at[address]]


def compile_source(source: Source) -> tuple[MalProgram | None, list[Diagnostic]]:
    """Compile a text. Returns two values: the program (None if the text has errors) and the diagnostics."""
    lines, found = checked(source)
    if has_errors(found):
        return None, found
    return _Compiler(source, lines).program(), found


@lru_cache(maxsize=8)
def program_of(name: str, text: str, *, line: bool = False) -> MalProgram:
    """Compile a text. Raises BadFile if the text has errors.

    Args:
        line: True if the program may use the axes and hands of the assembly line. By default, a program that uses
            these axes or hands is refused.
    """
    program, found = compile_source(Source(name=name, text=text))
    if program is None:
        first = next(each for each in found if each.severity == "error")
        row, _ = Source(name=name, text=text).position(first.primary.span.start)
        raise BadFile(f"{name}:{row}: {first.message}; `handeye check {name}` shows all mistakes")
    if not line:
        program.check_alone()
    return program


class _Compiler:
    def __init__(self, source: Source, lines: Sequence[Line]) -> None:
        self._source, self._lines = source, lines
        self._code: list[Instruction] = []
        self._begins: dict[int, int] = {}  # address, by line number
        self._jumps: list[tuple[int, int]] = []  # address of an instruction, and the line number it leads to

    def program(self) -> MalProgram:
        compiled: list[CompiledLine] = []
        kept: list[Line] = []
        tasks: dict[str, int] = {MAIN: 0}
        begun = MAIN
        for line in self._lines:
            word = line.statement.word
            if line.task != begun:
                self._emit("END")
                tasks[line.task], begun = len(self._code), line.task
            self._begins[line.number] = len(self._code)
            if word in ("REM", "TASK"):
                continue
            compiled.append(
                CompiledLine(
                    number=line.number,
                    task=line.task,
                    text=line.text,
                    row=line.row,
                    begin=len(self._code),
                    word=word,
                )
            )
            kept.append(line)
            self._statement(line.statement)
            self._emit("NEXTLINE")
        self._emit("END")
        for address, number in self._jumps:
            self._code[address] = self._code[address]._replace(target=self._begins[number])
        program = MalProgram(
            name=self._source.name, text=self._source.text, code=tuple(self._code), lines=tuple(compiled),
            tasks=tasks, texts={line.number: line.text for line in self._lines}, statements=tuple(kept),
        )  # fmt: skip
        ways = _Ways(program)
        lines = tuple(
            CompiledLine(
                number=each.number, task=each.task, text=each.text, row=each.row, begin=each.begin, word=each.word,
                ways=ways.of(index),
            )
            for index, each in enumerate(compiled)
        )  # fmt: skip
        return MalProgram(
            name=program.name, text=program.text, code=program.code, lines=lines, tasks=tasks,
            texts=program.texts, statements=program.statements,
        )  # fmt: skip

    def _emit(self, op: Op, operand: Operand = None) -> int:
        self._code.append(Instruction(op, operand))
        return len(self._code) - 1

    def _jump(self, op: Op, statement: Statement, operand: str | None = None) -> None:
        assert statement.target is not None
        self._jumps.append((self._emit(op, operand), int(statement.target.text)))

    def _patch(self, address: int) -> None:
        """Let a jump within a line lead to the present address."""
        self._code[address] = self._code[address]._replace(target=len(self._code))

    def _statement(self, statement: Statement) -> None:
        word, names = statement.word, tuple(name.text for name in statement.names)
        match word:
            case "LET":
                self._value(statement.values[0])
                self._emit("POPV", names[0])
            case "IF":
                self._choice(statement)
            case "GOTO":
                self._jump("GO", statement)
            case "GOSUB":
                self._jump("CALL", statement)
            case "ON":
                self._jump("TRAP", statement, names[0] if names else "")
            case "FOR":
                for value in statement.values:
                    self._value(value)
                self._emit("FOR", names[0])
            case "PRINT":
                self._print(statement)
            case "WAIT":
                self._emit("WAITF", names)
            case "MOVE":
                self._move(statement)
            case "ORIGIN":
                self._emit("ORIG", names)
                self._emit("CMD")
                self._emit("BUSYWAIT", names)
                self._emit("FOUND", names)
            case "STOP" if statement.items:
                (text,) = statement.items
                assert isinstance(text, Text)
                self._emit("FAIL", text.text)
            case "ACTUATE":
                self._value(statement.values[0])
                self._emit("ACT", names[0])
                self._emit("CMD")
                self._emit("BUSYWAIT", names)
            case "SPEED" | "CURVE" | "LIMIT":
                self._setting(statement)
            case "DELAY":
                self._value(statement.values[0])
                self._emit("SLEEP")
            case _:
                self._plain(word, names)

    def _plain(self, word: str, names: tuple[str, ...]) -> None:
        """Compile a statement that consists of one instruction, or of one instruction for each of its names."""
        op = _PLAIN[word]
        if word in ("START", "KILL"):
            self._emit(op, names)
        else:
            self._emit(op, names[0] if names else None)

    def _choice(self, statement: Statement) -> None:
        assert statement.then is not None
        self._value(statement.values[0])
        past = self._emit("JZ")
        self._statement(statement.then)
        if statement.otherwise is None:
            self._patch(past)
            return
        end = self._emit("JMP")
        self._patch(past)
        self._statement(statement.otherwise)
        self._patch(end)

    def _print(self, statement: Statement) -> None:
        for item in statement.items:
            if isinstance(item, Text):
                self._emit("OUT", item.text)
            elif isinstance(item, str):
                if item == ",":
                    self._emit("TAB")
            else:
                self._value(item)
                self._emit("OUT")
        if not (statement.items and isinstance(statement.items[-1], str)):
            self._emit("EOL")

    def _move(self, statement: Statement) -> None:
        if statement.slow is not None:
            self._value(statement.slow)
        for goal in statement.goals:
            self._value(goal.distance)
        for goal in reversed(statement.goals):
            self._emit("GOAL", (goal.axis.text, goal.mode))
        if statement.slow is not None or statement.straight:
            self._emit("SPEEDS", "LINE" if statement.straight else "SLOW")
        self._emit("CMD")
        if statement.waits:
            self._emit("BUSYWAIT", tuple(goal.axis.text for goal in statement.goals))

    def _setting(self, statement: Statement) -> None:
        (axis,) = (name.text for name in statement.names)
        if statement.values:
            self._value(statement.values[0])
        self._emit(_SETTINGS[statement.word], (axis, *(() if statement.values else ("STANDARD",))))
        self._emit("CMD")

    def _value(self, expression: Expression) -> None:
        match expression:
            case Number(value):
                self._emit("PUSHC", value)
            case Variable(name):
                self._emit("PUSHV", name.text)
            case Unary(operator, operand):
                self._value(operand)
                self._emit("NEG" if operator == "-" else "NOT")
            case Binary(operator, left, right):
                self._value(left)
                self._value(right)
                self._emit(_OPERATORS[operator])
            case Call(function, argument):
                self._call(function, argument)

    def _call(self, function: str, argument: Expression | Token | None) -> None:
        if isinstance(argument, Token):
            self._emit(_FUNCTIONS[function], argument.text)
            return
        if argument is not None:
            self._value(argument)
        self._emit(_FUNCTIONS[function])


_PLAIN: Final[dict[str, Op]] = {
    "RETURN": "RET", "NEXT": "NEXT", "INPUT": "IN", "STOP": "HALT", "END": "END", "START": "START", "KILL": "KILL",
    "SET": "SETF", "RESET": "CLRF", "TAKE": "TAKEF", "RESUME": "RESUME",
}  # fmt: skip


class _Ways:
    """Finds the lines that may follow a line within its task."""

    def __init__(self, program: MalProgram) -> None:
        self._program = program
        self._index = {line.begin: number for number, line in enumerate(program.lines)}

    def of(self, index: int) -> tuple[int | None, ...]:
        line, found = self._program.lines[index], list[int | None]()
        code = self._code(index)
        for op, operand, target in code:
            if op in ("GO", "CALL"):
                found.append(self._index.get(target))
            elif op == "NEXT":
                found += self._behind.get((line.task, "FOR", operand), [])
            elif op == "RET":
                found += self._behind.get((line.task, "CALL", None), [])
            elif op in ("END", "HALT"):
                found.append(None)
        if line.word == "IF" or code[0].op not in ("GO", "RET", "END", "HALT", "CALL", "RESUME"):
            found.append(self._after(index))
        return tuple(dict.fromkeys(found)) or (None,)

    @cached_property
    def _behind(self) -> dict[tuple[str, str, Operand], list[int | None]]:
        """The indices of the lines that directly follow each FOR and each call of a subroutine. The key consists of
        the task, the instruction and the operand.
        """
        behind: dict[tuple[str, str, Operand], list[int | None]] = {}
        for index, line in enumerate(self._program.lines):
            for op, operand, _ in self._code(index):
                if op in ("FOR", "CALL"):
                    behind.setdefault((line.task, op, operand), []).append(self._after(index))
        return behind

    def _after(self, index: int) -> int | None:
        lines = self._program.lines
        following = index + 1
        return following if following < len(lines) and lines[following].task == lines[index].task else None

    def _code(self, index: int) -> tuple[Instruction, ...]:
        lines, code = self._program.lines, self._program.code
        end = lines[index + 1].begin if index + 1 < len(lines) else len(code)
        found = code[lines[index].begin : end]
        return tuple(
            each for n, each in enumerate(found) if lines[index].begin + n not in self._program.closing
        )
