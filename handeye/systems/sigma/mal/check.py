"""Checks a program that has no syntax errors: names, jumps, loops, flags and axes."""

from bisect import bisect_left
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Final

from handeye.core.diagnostics import (
    LIMIT,
    Diagnostic,
    KnownNames,
    Label,
    SimilarName,
    alternatives,
    arranged,
    has_errors,
    quoted,
)
from handeye.core.source import Source
from handeye.systems.sigma.mal.codes import mistake
from handeye.systems.sigma.mal.parser import parsed
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
from handeye.systems.sigma.protocol import AXES, LINE_NUMBERS

TRAVEL_MM: Final = {"X": 600.0, "Y": 400.0, "Z": 200.0}


def checked(source: Source) -> tuple[list[Line], list[Diagnostic]]:
    """Return the lines of a program in the order of their numbers, and all mistakes in the order of their
    places."""
    lines, found = parsed(source)
    form = has_errors(found)
    kept: dict[int, Line] = {}
    for line in lines:
        if line.number in kept:
            first = Label(span=kept[line.number].span, text="the first line with this number")
            found.append(mistake("line-twice", f"two lines have the number {line.number}", line.span, first))
        else:
            kept[line.number] = line
    ordered = in_order([*kept.values()])
    found += _Check(ordered, complete=not form).found()
    return ordered, arranged(found)


def in_order(lines: Sequence[Line]) -> list[Line]:
    """Sort lines by their numbers. A TASK statement begins a task. The lines from this statement to the line before
    the next TASK statement belong to the task.
    """
    ordered, task = [], MAIN
    for line in sorted(lines, key=lambda line: line.number):
        if line.statement.word == "TASK":
            task = line.statement.names[0].text
        ordered.append(Line(number=line.number, task=task, statement=line.statement, row=line.row,
                            text=line.text, span=line.span))  # fmt: skip
    return ordered


def within(statement: Statement) -> Iterator[Statement]:
    """Yield a statement, and the statements after its THEN and ELSE."""
    yield statement
    for branch in (statement.then, statement.otherwise):
        if branch is not None:
            yield from within(branch)


def expressions(statement: Statement) -> Iterator[Expression]:
    """Yield the expressions in a statement, except the expressions in the statements after THEN and ELSE."""
    yield from statement.values
    yield from (goal.distance for goal in statement.goals)
    if statement.slow is not None:
        yield statement.slow
    for item in statement.items:
        if not isinstance(item, str | Text):
            yield item


def parts(expression: Expression) -> Iterator[Expression]:
    """Yield an expression and all its subexpressions."""
    left = [expression]
    while left:
        part = left.pop()
        yield part
        match part:
            case Unary(_, operand):
                left.append(operand)
            case Binary(_, one, other):
                left += (other, one)
            case Call(_, argument) if argument is not None and not isinstance(argument, Token):
                left.append(argument)


def reads(statement: Statement) -> Iterator[Token]:
    """Yield the variables that a statement reads, except the variables in the statements after THEN and ELSE."""
    for expression in expressions(statement):
        for part in parts(expression):
            if isinstance(part, Variable):
                yield part.name


def writes(statement: Statement) -> Iterator[Token]:
    """Yield the variables that a statement sets."""
    if statement.word in ("LET", "FOR", "INPUT"):
        yield statement.names[0]


def driven(statement: Statement) -> Iterator[Token]:
    """Yield the axes that a statement moves."""
    if statement.word == "ORIGIN":
        yield from statement.names
    yield from (goal.axis for goal in statement.goals)


@dataclass(slots=True)
class _Task:
    """The lines of a task."""

    name: str
    lines: list[Line] = field(default_factory=list)

    def nearest(self, number: int) -> int:
        """Return the task's line number that is nearest to `number`."""
        at = bisect_left(self.lines, number, key=lambda line: line.number)
        near = [line.number for line in self.lines[max(0, at - 1) : at + 1]]
        return min(near, key=lambda each: (abs(each - number), each))

    def having(self, word: str) -> Iterator[tuple[Line, Statement]]:
        """Yield the statements that begin with a word, each with its line."""
        for line in self.lines:
            for statement in within(line.statement):
                if statement.word == word:
                    yield line, statement


class _Check:
    """All checks of a program. If lines could not be parsed, there are no checks for missing statements."""

    def __init__(self, lines: list[Line], *, complete: bool) -> None:
        self._lines, self._complete = lines, complete
        self._told = 0
        self._numbered = {line.number: line for line in lines}
        self._tasks: dict[str, _Task] = {MAIN: _Task(MAIN)}
        for line in lines:
            self._tasks.setdefault(line.task, _Task(line.task)).lines.append(line)
        self._all = [(line, statement) for line in lines for statement in within(line.statement)]

    def found(self) -> Iterator[Diagnostic]:
        """Yield the mistakes, in no particular order."""
        yield from self._task_names()
        yield from self._shared_axes()
        for line, statement in self._all:
            yield from self._values(statement)
            yield from self._axes(statement)
            if self._complete:
                yield from self._jump(line, statement)
                yield from self._named_tasks(statement)
        if self._complete:
            for task in self._tasks.values():
                yield from self._loops(task)
                yield from self._pairs(task)
            yield from self._flags()
            yield from self._variables()

    def _near(self, name: str, known: Collection[str]) -> SimilarName | KnownNames | None:
        """Return names that the programmer may have meant. Returns None after `LIMIT` calls, because no more than
        `LIMIT` mistakes are shown.
        """
        self._told += 1
        return alternatives(name, known) if self._told <= LIMIT else None

    def _task_names(self) -> Iterator[Diagnostic]:
        seen: dict[str, Token] = {}
        started = {
            name.text for _, statement in self._all if statement.word == "START" for name in statement.names
        }
        for _, statement in self._all:
            if statement.word != "TASK":
                continue
            name = statement.names[0]
            if name.text == MAIN:
                told = "this name is taken: the lines before the first TASK are the task MAIN; choose another name"
                yield mistake("task-twice", told, name.span)
            elif name.text in seen:
                first = Label(span=seen[name.text].span, text="it begins here")
                yield mistake("task-twice", f"two tasks have the name {name.text}", name.span, first)
            elif name.text not in started and self._complete:
                yield mistake("task-never-started", f"no line starts the task {name.text}", name.span)
            seen.setdefault(name.text, name)

    def _named_tasks(self, statement: Statement) -> Iterator[Diagnostic]:
        if statement.word not in ("START", "KILL"):
            return
        known = {*self._tasks} - ({MAIN} if statement.word == "START" else set())
        for name in statement.names:
            if name.text not in known:
                told = f"no task is called {quoted(name.text)}"
                yield mistake("task-missing", told, name.span, meant=self._near(name.text, known))

    def _jump(self, line: Line, statement: Statement) -> Iterator[Diagnostic]:
        if statement.target is None:
            return
        number = int(statement.target.text)
        goal = self._numbered.get(number)
        if goal is None:
            near = self._tasks[line.task].nearest(number)
            told = f"there is no line {number}"
            yield mistake(
                "line-missing", told, statement.target.span, help=f"the nearest line of {line.task} is {near}"
            )
        elif goal.task != line.task:
            told = f"line {number} belongs to the task {goal.task}, but this line belongs to {line.task}"
            where = Label(span=goal.span, text=f"a line of {goal.task}")
            yield mistake("other-task", told, statement.target.span, where)

    def _loops(self, task: _Task) -> Iterator[Diagnostic]:
        opened: dict[str, list[Statement]] = {}
        begun: set[str] = set()
        for line in task.lines:
            for statement in within(line.statement):
                name = statement.names[0].text if statement.names else ""
                if statement.word == "FOR":
                    opened.setdefault(name, []).append(statement)
                    begun.add(name)
                elif statement.word == "NEXT":
                    opened.pop(name, None)
                    if name not in begun:
                        told = f"there is no FOR {name} before this NEXT"
                        yield mistake("next-without-for", told, statement.span)
        for name, loops in opened.items():
            for statement in loops:
                yield mistake(
                    "for-without-next",
                    f"there is no NEXT {name} after this FOR in the task {task.name}",
                    statement.span,
                )

    def _pairs(self, task: _Task) -> Iterator[Diagnostic]:
        for word, first, code in (
            ("RETURN", "GOSUB", "return-without-gosub"),
            ("RESUME", "ON", "resume-without-abort"),
        ):
            if next(task.having(first), None) is None:
                named = "ON ABORT" if first == "ON" else first
                for _, statement in task.having(word):
                    yield mistake(code, f"the task {task.name} has no {named}", statement.span)

    def _flags(self) -> Iterator[Diagnostic]:
        set_somewhere = {s.names[0].text for _, s in self._all if s.word == "SET"}
        for _, statement in self._all:
            if statement.word not in ("WAIT", "TAKE"):
                continue
            for flag in statement.names:
                if flag.text not in set_somewhere:
                    told = f"no line sets the flag {flag.text}, so this statement waits for ever"
                    near = self._near(flag.text, set_somewhere)
                    yield mistake("flag-never-set", told, flag.span, meant=near)

    def _variables(self) -> Iterator[Diagnostic]:
        set_somewhere = {name.text for _, statement in self._all for name in writes(statement)}
        seen = set[str]()
        for _, statement in self._all:
            for name in reads(statement):
                if name.text not in set_somewhere | seen:
                    seen.add(name.text)
                    told = f"no line sets the variable {name.text}, so its value is 0"
                    near = self._near(name.text, set_somewhere)
                    yield mistake("variable-never-set", told, name.span, meant=near)
            if statement.word == "NEXT" and statement.names[0].text in seen:
                seen.discard(statement.names[0].text)

    def _shared_axes(self) -> Iterator[Diagnostic]:
        first: dict[str, tuple[str, Token]] = {}
        told_of = set[tuple[str, str]]()
        for line, statement in self._all:
            for axis in driven(statement):
                if statement.word == "ORIGIN":
                    continue
                task, where = first.setdefault(axis.text, (line.task, axis))
                if task != line.task and (axis.text, line.task) not in told_of:
                    told_of.add((axis.text, line.task))
                    label = Label(span=where.span, text=f"the task {task} moves {axis.text} here")
                    told = f"the tasks {task} and {line.task} both move {axis.text}"
                    yield mistake("axis-shared", told, axis.span, label)

    def _axes(self, statement: Statement) -> Iterator[Diagnostic]:
        seen: set[str] = set()
        for axis in driven(statement):
            if axis.text in seen:
                yield mistake("axis-twice", f"{axis.text} is named twice in this statement", axis.span)
            seen.add(axis.text)
        for goal in statement.goals:
            most, place = TRAVEL_MM[goal.axis.text[0]], constant(goal.distance)
            if goal.mode == "TO" and place is not None and not 0 <= place <= most:
                told = f"{goal.axis.text} reaches from 0 to {most:g} mm, but the goal is {place:g} mm"
                yield mistake("beyond-rail", told, goal.axis.span)

    @cached_property
    def _hands(self) -> int:
        """Number of hands of the machine for which the program is written. This machine is SUPERSIGMA or the assembly
        line.
        """
        moved = (axis for line in self._lines for part in within(line.statement) for axis in driven(part))
        return 6 if any(axis.text not in AXES for axis in moved) else 2

    def _values(self, statement: Statement) -> Iterator[Diagnostic]:
        felt = statement.names if statement.word == "LIMIT" else ()
        for part in (part for expression in expressions(statement) for part in parts(expression)):
            if isinstance(part, Call) and part.function == "FORCE" and isinstance(part.argument, Token):
                felt = (*felt, part.argument)
        for axis in felt:
            if f"FORCE{axis.text[1]}" not in LINE_NUMBERS:
                yield mistake("wrong-value", f"{axis.text} has no wrist that feels forces", axis.span)
        for expression in expressions(statement):
            for part in parts(expression):
                if isinstance(part, Call) and part.function == "BEAM":
                    arm = None if isinstance(part.argument, Token | None) else constant(part.argument)
                    if arm is not None and arm not in range(1, 1 + self._hands):
                        yield mistake(
                            "wrong-value",
                            f"there is no light beam {arm:g}, only {'1 and 2' if self._hands == 2 else '1 to 6'}",
                            statement.span,
                            help=_allowed("BEAM"),
                        )
        for word, (least, most, what) in _RANGES.items():
            value = constant(statement.values[0]) if statement.word == word and statement.values else None
            if value is not None and not least <= value <= most:
                told = f"{what} must be between {least:g} and {most:g}, not {value:g}"
                yield mistake("wrong-value", told, statement.span, help=_allowed(word))
        slow = None if statement.slow is None else constant(statement.slow)
        if slow is not None and not SLOWEST <= slow <= FASTEST_SLOW:
            told = f"a constant speed must be between {SLOWEST:g} and {FASTEST_SLOW:g} mm/s, not {slow:g}"
            yield mistake("wrong-value", told, statement.span, help=_allowed("SLOW"))


def _allowed(word: str) -> str:
    return f"`handeye sigma words {word}` says which values are allowed"


SLOWEST: Final = 2.0  # mm/s
FASTEST_SLOW: Final = 254.0
_RANGES: Final = {
    "CURVE": (0.0, 4.0, "a curve"),
    "SPEED": (0.0, 2400.0, "a speed limit (mm/s)"),
    "LIMIT": (0.0, 655.0, "a force limit (N)"),
    "DELAY": (0.0, 86400.0, "a delay (s)"),
}  # least and greatest value of each


def constant(expression: Expression) -> float | None:
    """Return the value of an expression that is a number, or None for any other expression."""
    match expression:
        case Number(value):
            return value
        case Unary("-", Number(value)):
            return -value
    return None
