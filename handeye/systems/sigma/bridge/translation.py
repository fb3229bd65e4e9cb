"""Translates a MAL program of a single task into a program for the planner. Every line that cannot become a
motion is refused.

The axes of one arm become table axes: another arm replaces the arm of SUPERSIGMA, and the board of SUPERSIGMA lies on
the table of this other arm. A MOVE of one axis becomes a straight motion, and so does a MOVE with LINE. Any other MOVE
of several axes becomes a motion whose path is free. A LIMIT becomes a guard of the motions of its axis. A test of
FORCE right after a motion becomes a guard of this motion: the motion stops at this force, and the program no longer
tests the force afterwards. A motion with neither a LIMIT nor a test of FORCE has no guard, because an arm that is not
balanced feels several newtons even in free motion.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from math import pi
from pathlib import PurePath
from typing import Final, NamedTuple

from handeye.core.diagnostics import Diagnostic, Label, arranged, has_errors, problem
from handeye.core.errors import NO_FORCE
from handeye.core.record import Vector3
from handeye.core.source import Source, Span
from handeye.program.flow_operations import Jump, Test, Tool, Wait
from handeye.program.guards import Against
from handeye.program.language import Compiled
from handeye.program.motion_operations import Change, Close, Move, Open
from handeye.program.operations import AnyOperation
from handeye.program.program import Position, Program, Step
from handeye.program.taught import Taught
from handeye.systems.sigma.bridge.flow import (
    END,
    UNKNOWN,
    Axes,
    Before,
    ForceTest,
    Known,
    Tests,
    Unknown,
    flow,
    force_test,
    goals,
)
from handeye.systems.sigma.bus.plant import TRAVEL
from handeye.systems.sigma.mal.check import checked, constant
from handeye.systems.sigma.mal.syntax import Line, Statement
from handeye.systems.sigma.mal.words import MAL_DEVICES
from handeye.systems.sigma.protocol import AXES, COMPONENTS, STEP_MM

LANGUAGE: Final = "mal"
AT: Final = (350.0, 550.0)  # mm: place of the board's corner X1 = 0, Y1 = 0 on the table
TOP: Final = 180.0  # mm: height of the fingertips over the board at Z = 0
ACROSS: Final = 600.0  # mm: X1 at the place where X2 is 0
OPEN: Final = 44.0  # mm between the fingers of an open hand
SPINDLE: Final = {0.0: 0.0, 1.0: 20.0, 2.0: -20.0}  # rad/s, by the value of DRIVER2
_MM: Final = 0.001
DOWN: Final = (pi / 2, pi / 2, 0.0)  # O, A, T: straight down, with the fingers along Y
_TURNED: Final = ("MOVE", "ORIGIN", "LIMIT", "SPEED", "ACTUATE", "ON", "IF", "GOTO", "END", "STOP", "REM")
_WHY: Final = {
    "TASK": "a plan can have only one task",
    "START": "a plan can have only one task",
    "KILL": "a plan can have only one task",
    "SET": "a plan can have only one task, and no flags",
    "RESET": "a plan can have only one task, and no flags",
    "WAIT": "a plan can have only one task, and no flags",
    "TAKE": "a plan can have only one task, and no flags",
    "CURVE": "the planner chooses how the arm accelerates",
    "RESUME": "a plan cannot return to the motion that was stopped",
}


_CURE: Final = (
    f"a plan can have only one task, which uses only {', '.join(_TURNED[:5])}, GOTO, and tests of FORCE right after a "
    "MOVE; `handeye sigma run` runs programs with any statements"
)


class _Stop(NamedTuple):
    """The successor of a step. If `here` is a number, the successor is `here` steps further on. If `here` is None, the
    successor is at the line `line`.
    """

    line: int | None = None
    here: int | None = None


class _Draft(NamedTuple):
    """An operation whose successors are given as lines of the MAL program."""

    operation: AnyOperation
    next: _Stop
    branch: _Stop | None = None


def translated(source: Source, taught: Taught, at: tuple[float, float] = AT) -> Compiled:
    """Translate a program. If a line cannot become a motion, returns None and the reasons.

    Args:
        at: where the board's corner X1 = 0, Y1 = 0 lies on the table (mm).
    """
    lines, found = checked(source)
    if has_errors(found):
        return None, found
    tests, untested = _force_tests(lines)
    wrong = [*_words(lines), *_arms(lines), *untested]
    if wrong:
        return None, _with_one_cure(wrong)
    made = _Translation(source, lines, tests, at)
    if made.found:
        return None, _with_one_cure(made.found)
    program = Program(
        name=PurePath(source.name).stem, language=LANGUAGE, source=source.text, stages=(PurePath(source.name).stem,),
        steps=tuple(made.steps), positions=made.positions, parts={}, fixtures=dict(taught.fixtures),
    )  # fmt: skip
    return program, [each for each in found if each.severity != "error"]


def _refused(line: Line, why: str, *labels: Label) -> Diagnostic:
    told = f"line {line.number} cannot become a motion of a plan: {why}"
    return problem("no-motion", told, line.statement.span, *labels, own="error")


def _with_one_cure(found: Sequence[Diagnostic]) -> list[Diagnostic]:
    """Sort refusals. The help that says what a plan can contain is the same for all refusals, so only the last refusal
    gets it.
    """
    *others, last = arranged(found)
    return [*others, replace(last, help=_CURE)]


def _words(lines: Sequence[Line]) -> Iterator[Diagnostic]:
    """Report each statement for which there is no operation, and each value that is not a number."""
    for line in lines:
        statement = line.statement
        word = statement.word
        if word not in _TURNED:
            yield _refused(line, _WHY.get(word, f"there is no operation for {word}"))
            continue
        values = [*statement.values, *(goal.distance for goal in statement.goals)]
        values += [] if statement.slow is None else [statement.slow]
        if word != "IF" and any(constant(value) is None for value in values):
            yield _refused(line, "one of its values is calculated during the run")
        elif word == "MOVE" and not statement.waits:
            yield _refused(line, "with NOWAIT, the program would go on before the arm has arrived")
        elif word == "MOVE" and statement.slow is not None and len(statement.goals) > 1:
            yield _refused(
                line,
                "with SLOW, the path of several axes is not straight; use LINE, or one MOVE for each axis",
            )
        elif word == "ORIGIN" and len(statement.names) != len(COMPONENTS):
            yield _refused(line, "ORIGIN is a single motion of the arm: name all three axes")
        elif word == "ACTUATE" and (why := _device(statement)):
            yield _refused(line, why)


def _device(statement: Statement) -> str:
    """Return the reason why an ACTUATE cannot become an operation. The text is empty if the ACTUATE can become an
    operation.
    """
    kind, value = MAL_DEVICES[statement.names[0].text][1], constant(statement.values[0])
    if kind not in ("HAND", "DRIVER"):
        return f"the arm has no {statement.names[0].text}"
    if kind == "DRIVER" and value not in SPINDLE:
        return f"{statement.names[0].text} must be 0, 1 or 2"
    return ""


def _arms(lines: Sequence[Line]) -> Iterator[Diagnostic]:
    """If the lines use both arms, yield a diagnostic for the first line that uses a different arm from the lines
    before it.
    """
    first: tuple[int, Line] | None = None
    for line in lines:
        for arm in sorted(_arms_of(line.statement)):
            first = first or (arm, line)
            if arm != first[0]:
                same = line is first[1]
                other = "both arms" if same else f"arm {arm}, but line {first[1].number} uses arm {first[0]}"
                labels = () if same else (Label(span=first[1].statement.span, text=f"arm {first[0]}"),)
                yield _refused(line, f"it uses {other}", *labels)
                return


def _arms_of(statement: Statement) -> set[int]:
    """Return the arms whose axes or devices a statement names."""
    if statement.word == "ACTUATE":
        return {MAL_DEVICES[name.text][0] for name in statement.names}
    axes = [goal.axis.text for goal in statement.goals]
    axes += [name.text for name in statement.names if name.text in AXES]
    return {int(axis[1]) for axis in axes}


def _force_tests(lines: Sequence[Line]) -> tuple[dict[int, ForceTest], list[Diagnostic]]:
    """Return the force tests that directly follow a motion. The key of a test is the line of its motion. Also return
    the refused IFs.
    """
    targets = {int(each.target.text) for line in lines for each in _branches(line.statement) if each.target}
    tests, wrong = dict[int, ForceTest](), list[Diagnostic]()
    following = [*(line.number for line in lines[1:]), END]
    for before, line, after in zip([None, *lines], lines, following, strict=False):
        if line.statement.word != "IF":
            continue
        test = force_test(line, after)
        moved = [] if before is None else [goal.axis.text for goal in before.statement.goals]
        if test is None:
            wrong.append(
                _refused(line, "an IF can only compare ABS(FORCE(axis)) with a number, and go to a line")
            )
        elif before is None or moved != [test.axis] or line.number in targets:
            told = "a test of FORCE must directly follow a MOVE of only this axis, and no line may jump to the test"
            wrong.append(_refused(line, told))
        else:
            tests[before.number] = test
    return tests, wrong


class _Translation:
    """The steps of a program."""

    def __init__(self, source: Source, lines: list[Line], tests: Tests, at: tuple[float, float]) -> None:
        self._source, self._tests, self._at = source, tests, at
        self.found: list[Diagnostic] = []
        self.positions: dict[str, Position] = {}
        self._mirrored = any(2 in _arms_of(line.statement) for line in lines)
        numbers = [line.number for line in lines]
        self._after = dict(pairwise(numbers))
        self._holds = flow(lines, self._tests)
        drafts = {line.number: self._drafts(line) for line in lines if line.number in self._holds}
        self.steps = [] if self.found else self._steps({line.number: line for line in lines}, drafts)

    def _refuse(self, line: Line, why: str) -> None:
        self.found.append(_refused(line, why))

    def _drafts(self, line: Line) -> list[_Draft]:
        statement, after = line.statement, _Stop(self._after.get(line.number))
        before = self._holds[line.number]
        match statement.word:
            case "MOVE":
                return self._motion(line, before)
            case "ORIGIN":
                return [_Draft(Move(goal=self._position([0.0] * len(COMPONENTS))), after)]
            case "ACTUATE":
                kind, value = MAL_DEVICES[statement.names[0].text][1], constant(statement.values[0]) or 0.0
                if kind == "DRIVER":
                    return [_Draft(Tool(speed=SPINDLE[value]), after)]
                return [_Draft(Close() if value else Open(gap=OPEN * _MM), after)]
            case "GOTO":
                assert statement.target is not None
                return [_Draft(Jump(), _Stop(int(statement.target.text)))]
            case "END" | "STOP":
                return [_Draft(Jump(), _Stop(END))]
        return [_Draft(Jump(), after)]  # for an IF, the motion before it has the test

    def _motion(self, line: Line, before: Before) -> list[_Draft]:
        statement, after = line.statement, self._after.get(line.number)
        moved = goals(statement, before.places)
        test = self._tests.get(line.number)
        limits = [before.limits[name] for name in moved]
        settings = [*limits, *(before.speeds[name] for name in moved)]
        if any(isinstance(value, Unknown) for value in settings):
            self._refuse(
                line,
                "the LIMIT or the SPEED of an axis that this line moves depends on how the program reached this line",
            )
            return []
        for name, place in moved.items():
            most = TRAVEL[name] * STEP_MM
            if isinstance(place, float) and not 0 <= place <= most:
                self._refuse(line, f"the rail of {name} goes from 0 to {most:.0f} mm, not to {place:g}")
                return []
        least = min((limit for limit in limits if isinstance(limit, float)), default=None)
        if test is not None and least is not None and test.limit > least:
            self._refuse(
                line,
                f"the LIMIT of {least:g} N stops the motion before the force reaches the {test.limit:g} N of the test",
            )
            return []
        guard = least if test is None else test.limit
        operation = self._path(line, before, moved, () if guard is None else (Against(force=guard),))
        if operation is None:
            return []
        if guard is None:
            return [_Draft(operation, _Stop(after))]
        first = _Draft(operation, _Stop(here=1))
        if test is not None:
            tested = _Draft(Test(number=NO_FORCE, raised=None), _Stop(test.over), _Stop(test.under))
            return [first, tested]
        ways = {before.aborts[name] for name in moved if before.limits[name] is not None}
        way = ways.pop() if len(ways) == 1 else UNKNOWN
        if isinstance(way, Unknown):
            self._refuse(
                line,
                "ON ABORT leads to different lines for different axes of this motion, or to a line that depends on "
                "the path to this motion",
            )
            return []
        tested = _Draft(
            Test(number=NO_FORCE, raised=None), _Stop(way) if way is not None else _Stop(here=1), _Stop(after)
        )
        axes = " and ".join(goal.axis.text for goal in statement.goals)
        stopped = _Draft(Wait(message=f"ABORT {axes} FORCE: line {line.number}"), _Stop(after))
        return [first, tested, *([] if way is not None else [stopped])]

    def _path(
        self, line: Line, before: Before, moved: Axes, guards: tuple[Against, ...]
    ) -> AnyOperation | None:
        """Return the motion of a MOVE, or None if the MOVE was refused."""
        statement = line.statement
        places = {**before.places, **moved}
        ways = {
            goal.axis.text[0]: constant(goal.distance)
            if goal.mode == "BY"
            else _way(moved, before, goal.axis.text[0])
            for goal in statement.goals
        }
        straight = len(ways) == 1 or statement.straight or all(goal.mode == "BY" for goal in statement.goals)
        known = {name: way for name, way in ways.items() if isinstance(way, float)}
        if straight and len(known) == len(ways):
            vector = self._vector([known.get(name, 0.0) for name in COMPONENTS])
            if not any(vector):
                return Jump()
            return Change(displacement=vector, speed=self._speed(statement, before), guards=guards)
        lost = [name for name in COMPONENTS if isinstance(places[name], Unknown)]
        if lost:
            arm = statement.goals[0].axis.text[1]
            told = f"the place of {' and '.join(f'{name}{arm}' for name in lost)} is not known here"
            self._refuse(
                line,
                f"{told}; begin the program with ORIGIN; after a motion that a force may stop, name all axes in the "
                "next MOVE",
            )
            return None
        if statement.slow is not None or (statement.straight and len(ways) > 1):
            self._refuse(line, "a straight motion must begin at a known place")
            return None
        goal = [place for name in COMPONENTS if isinstance(place := places[name], float)]
        return Move(goal=self._position(goal), direct=True, guards=guards)

    def _speed(self, statement: Statement, before: Before) -> float | None:
        """Return the speed of a straight motion (m/s); None for the usual speed."""
        slow = None if statement.slow is None else constant(statement.slow)
        speeds = [slow, *(before.speeds[goal.axis.text[0]] for goal in statement.goals)]
        known = [speed for speed in speeds if isinstance(speed, float)]
        return min(known) * _MM if known else None

    def _vector(self, ways: Sequence[float]) -> Vector3:
        x, y, z = ways
        return (-x if self._mirrored else x) * _MM, y * _MM, -z * _MM

    def _position(self, place: Sequence[float]) -> str:
        """Add a position of the tool for a place in the coordinates of the arm (mm), and return the name of this
        position.
        """
        x, y, z = place
        across = ACROSS - x if self._mirrored else x
        name = f"X{x:g}_Y{y:g}_Z{z:g}".replace(".", "p").replace("-", "m")
        xyz = ((self._at[0] + across) * _MM, (self._at[1] + y) * _MM, (TOP - z) * _MM)
        self.positions[name] = Position(at=(*xyz, *DOWN))
        return name

    def _steps(self, lines: dict[int, Line], drafts: dict[int, list[_Draft]]) -> list[Step]:
        begins: dict[int, int] = {}
        for number in drafts:
            begins[number] = sum(len(drafts[before]) for before in begins)
        steps = []
        for number, each in drafts.items():
            line = lines[number]
            row, column = self._source.position(line.statement.span.start)
            columns = column - 1, column - 1 + _length(line.statement.span)
            for index, draft in enumerate(each):
                here = begins[number] + index
                operation = draft.operation
                if draft.branch is not None:
                    operation = operation.leading_to(_number(draft.branch, here, begins))
                steps.append(
                    Step(
                        operation=operation, stage=0, labels=(str(number),) if index == 0 else (), line=row,
                        span=columns, text=f"{number} {line.text}", next=_number(draft.next, here, begins),
                    )
                )  # fmt: skip
        return steps


def _way(moved: Axes, before: Before, name: str) -> Known:
    """Return how far an axis has to go to its goal (mm); unknown if the axis's present place or its goal is unknown."""
    goal, here = moved[name], before.places[name]
    return goal - here if isinstance(goal, float) and isinstance(here, float) else UNKNOWN


def _number(stop: _Stop, here: int, begins: dict[int, int]) -> int | None:
    if stop.here is not None:
        return here + stop.here
    return None if stop.line is None else begins[stop.line]


def _length(span: Span) -> int:
    return span.end - span.start


def _branches(statement: Statement) -> Iterator[Statement]:
    """Yield a statement and, if it is an IF, the statements of its branches."""
    yield statement
    for each in (statement.then, statement.otherwise):
        if each is not None:
            yield each
