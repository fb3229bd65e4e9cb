"""Checks the sequence numbers, jumps, points, motors, sensors, tables and loops of a program. Also checks how the
program uses its sensors.
"""

from collections.abc import Iterable, Iterator, Mapping
from typing import Final

from handeye.core.diagnostics import Diagnostic, Label, arranged, has_errors
from handeye.core.source import Source
from handeye.systems.ml.language.codes import mistake
from handeye.systems.ml.language.commands import COMMANDS, TABLE_NAMES
from handeye.systems.ml.language.flow import Flow
from handeye.systems.ml.language.lint import lint
from handeye.systems.ml.language.parser import parsed
from handeye.systems.ml.language.syntax import FINGERS, VARIABLES, Line, Parameter, Statement
from handeye.systems.ml.level import Side
from handeye.systems.ml.machine.rectilinear import LEFT, RIGHT
from handeye.systems.ml.machine.spec import ArmSpec
from handeye.systems.ml.tables.layout import SENSORS, SHAPES

_ARMS: Final[dict[Side, ArmSpec]] = {"right": RIGHT, "left": LEFT}
_CHOICES: Final[dict[str, Side]] = {"RIGHT": "right", "LEFT": "left"}
_PAIRS: Final = {"NEXTI": "LOOPI", "NEXTJ": "LOOPJ", "RETURN": "GOSUB"}
_AT_POINTS: Final = {"DEFPOINT": 1, "GOPOINT": 1, "JOY": 1, "GOLINE": 2, "GOMEAN": 2}
"""For each command, how many of its parameters, from the first on, are statement numbers of POINTs."""


def checked(
    source: Source, *, first: int | None = None, left: int | None = None
) -> tuple[dict[int, Line], list[Diagnostic]]:
    """Return two values: the stored lines of a program and the mistakes. The keys of the lines are their sequence
    numbers, in ascending order.

    Args:
        first: the statement at which the program begins. If this is None, the program begins at the statement with the
            lowest number.
        left: the statement at which the program of the left arm begins. If this is None, the left arm has no program.
    """
    lines, found = parsed(source)
    complete = not has_errors(found)
    stored: dict[int, Line] = {}
    for line in lines:
        if line.number is None:
            told = f"{line.statement.code} has no sequence number, so it cannot be stored"
            found.append(mistake("not-stored", told, line.span))
            continue
        if line.number in stored:
            earlier = Label(span=stored[line.number].span, text="the first")
            told = f"two statements have the number {line.number}; the second replaces the first"
            found.append(mistake("line-replaced", told, line.span, earlier))
        stored[line.number] = line
    stored = dict(sorted(stored.items()))
    first = min(stored, default=0) if first is None else first
    check = _Check(stored, [(first, "right"), (left or 0, "left")] if complete else [])
    for line in stored.values():
        found += check.parameters(line)
        found += check.motors(line)
        if complete:
            found += check.places(line)
            found += check.pairs(line)
    if complete:
        found += lint(stored)
    return stored, arranged(found)


class _Check:
    """Checks the lines of a program one by one. A check may also use the other lines of the program."""

    def __init__(self, lines: Mapping[int, Line], starts: list[tuple[int, Side]]) -> None:
        self._lines = lines
        self._statements = {number: line.statement for number, line in lines.items()}
        self._codes = {each.code for each in self._statements.values()}
        self._loads = "CMSLOAD" in self._codes
        self._sides = commanded(Flow(self._statements), starts)

    def parameters(self, line: Line) -> Iterator[Diagnostic]:
        """Check that the statement's variables, sensors, table lines and table words exist."""
        command, shape = COMMANDS[line.statement.code], SHAPES.get(line.statement.code)
        for at, value in enumerate(line.statement.parameters):
            if not isinstance(value, int):
                continue
            kind, span = command.kind(at), line.place(at)
            if kind == "variable" and not 1 <= value <= VARIABLES:
                yield mistake("M05", f"there is no variable {value}; the last variable is {VARIABLES}", span)
            elif kind == "sensor" and not 1 <= abs(value) <= SENSORS:
                yield mistake("M11", f"there is no sensor {value}; the last sensor is {SENSORS}", span)
            elif kind == "sensor" and value < 0 and command.code != "BRANCH":
                yield mistake("M11", f"there is no sensor {value}", span)
            elif kind == "table":
                name = TABLE_NAMES.get(value, "")
                shape = SHAPES.get(name)
                if not name:
                    yield mistake("M11", f"{value} is not the name of a table", span)
            elif kind in ("line", "word") and shape is not None:
                last = shape.lines if kind == "line" else shape.words
                if not 1 <= value <= last:
                    told = f"there is no {kind} {value} in this table; the last {kind} is {last}"
                    yield mistake("M11", told, span)
        match line.statement.code, line.statement.parameters:
            case "SENSOR", (_, int(lower), int(upper)) if upper - lower < 2:
                told = f"no reading is above {lower} and below {upper}, so the flag comes on at once"
                yield mistake("limits-empty", told, line.place(1))

    def motors(self, line: Line) -> Iterator[Diagnostic]:
        """Check the motors and the constant goals of a line. If a line may command either arm, it has a mistake only
        if it is wrong for both arms.
        """
        sides = self._sides.get(line.number or 0) or _ARMS
        mistakes = [list(_motors(line, _ARMS[side])) for side in _ARMS if side in sides]
        if all(mistakes):
            yield from mistakes[0]

    def places(self, line: Line) -> Iterator[Diagnostic]:
        """Check that each statement and each POINT to which a line refers exists."""
        if self._loads:  # the program may be replaced
            return
        code, values = line.statement.code, line.statement.parameters
        points = _AT_POINTS.get(code, 0)
        for at, value in enumerate(values):
            if COMMANDS[code].kind(at) != "statement" or not isinstance(value, int):
                continue
            stored = self._statements.get(value)
            if at < points:
                yield from self._point(line, at, value, stored)
            elif stored is None and COMMANDS[code].category != "edit":
                yield mistake("M07", f"there is no statement {value}", line.place(at))

    def _point(self, line: Line, at: int, number: int, stored: Statement | None) -> Iterator[Diagnostic]:
        if stored is None or stored.code != "POINT":
            what = "there is no statement" if stored is None else f"statement {number} is {stored.code}:"
            told = f"{what} {number}" if stored is None else f"{what} it is not a POINT"
            yield mistake("M08", told, line.place(at))
        elif line.statement.code not in ("DEFPOINT", "JOY") and not stored.point and not self._filled(number):
            yield mistake("point-not-filled", f"nothing fills POINT {number}", line.place(at))

    def _filled(self, number: int) -> bool:
        filling = [each for each in self._statements.values() if each.code in ("DEFPOINT", "JOY")]
        filling += [each for each in self._statements.values() if each.code in ("PUT", "FILE")]
        return any(
            not isinstance(first := each.parameters[0], int)
            or first == number
            or each.code in ("PUT", "FILE")
            for each in filling
        )

    def pairs(self, line: Line) -> Iterator[Diagnostic]:
        """If the line is a NEXTI, NEXTJ or RETURN, check that the program has its LOOPI, LOOPJ or GOSUB. If the line
        is a LOOPI or LOOPJ, check that its NEXTI or NEXTJ comes later.
        """
        code = line.statement.code
        if code in _PAIRS and _PAIRS[code] not in self._codes:
            yield mistake("M13", f"{code} has no {_PAIRS[code]} in this program", line.spans[0])
        if code in ("LOOPI", "LOOPJ"):
            end = code.replace("LOOP", "NEXT")
            after = (number for number, each in self._statements.items() if each.code == end)
            if not any(number > (line.number or 0) for number in after):
                yield mistake("loop-without-end", f"{code} has no {end} after it", line.spans[0])


def commanded(flow: Flow, starts: Iterable[tuple[int, Side]]) -> dict[int, set[Side]]:
    """Return the arms that each statement may command. `starts` has the first statement and the arm of each program."""
    known: dict[int, set[Side]] = {}
    todo = [start for start in starts if start[0] in flow.statements]
    while todo:
        number, side = todo.pop()
        if side in known.setdefault(number, set()):
            continue
        known[number].add(side)
        chosen = _CHOICES.get(flow.statements[number].code, side)
        todo += [(way, chosen) for way in flow.ways(number) if way is not None]
    return known


def _motors(line: Line, arm: ArmSpec) -> Iterator[Diagnostic]:
    """Find motors that an arm lacks, and constant goals that the arm cannot reach."""
    travel = {motor.number: (motor.lower, motor.upper) for motor in arm.motors}
    of_arm = "" if arm is RIGHT else f" of the {arm.side} arm"
    code, values = line.statement.code, line.statement.parameters
    first = FINGERS if code in ("HAND", "DHAND") else 1
    for at, value in enumerate(values):
        if COMMANDS[code].kind(at) == "motor" and isinstance(value, int) and value not in travel:
            yield mistake("M09", f"motor {value}{of_arm} is not installed", line.place(at))
        elif first + at not in travel and (
            code == "HAND" or (code in ("MOVE", "DMOVE", "DHAND") and value != 0)
        ):
            told = f"motor {first + at}{of_arm} is not installed, so it cannot be moved"
            yield mistake("M09", told, line.place(at))
    goals: list[tuple[int, Parameter, Parameter]] = []
    match code, values:
        case "MOTOR", (number, value):
            goals = [(1, number, value)]
        case (("MOVE" | "HAND"), _):
            goals = [(at, first + at, value) for at, value in enumerate(values)]
    for at, motor, goal in goals:
        if not isinstance(motor, int) or motor not in travel or not isinstance(goal, int):
            continue
        lower, upper = travel[motor]
        if not lower <= goal <= upper:
            told = f"motor {motor}{of_arm} cannot go to {goal}; its range is {lower} to {upper}"
            yield mistake("M10", told, line.place(at))
