"""Warnings on how a program uses its sensors: motions without guards, flags that stay on, and speeds so high that the
jolt at the start of a motion exceeds a force limit.

All paths through the program are followed. The result shows two facts for each statement: which sensors are guarded on
every path to it, and which flags may be on.
"""

from collections.abc import Iterator, Mapping
from itertools import groupby
from math import sqrt
from typing import Final, NamedTuple

from handeye.core.diagnostics import Diagnostic
from handeye.core.plain_text import counted
from handeye.systems.ml.language.codes import mistake
from handeye.systems.ml.language.commands import MOTIONS
from handeye.systems.ml.language.flow import Flow
from handeye.systems.ml.language.syntax import Line, Parameter, Statement
from handeye.systems.ml.tables.store import word_of

STRAIN: Final = range(2, 8)  # sensors of the fingers, gram-force
SLIDES: Final = (2, 3, 4)
UNIT_M: Final = 25.4e-6  # m: the unit of a slide
CYCLE_S: Final = 0.01
GRAM_N: Final = 9.80665e-3
STIFFNESS: Final = 10_000.0  # N/m: stiffness of a finger
FINGERS_KG: Final = 0.15  # kg: mass of a finger beyond its strain gauges, with nothing held
FASTEST: Final = 79  # units per cycle: top speed of a slide
ANY: Final = 0  # stands for a sensor whose number is computed
_SPEED: Final = 8  # the word of MT that holds the speed


class Watch(NamedTuple):
    """What is known about the sensors before a statement is executed."""

    guarded: frozenset[int] = frozenset()  # sensors that have limits on every path to the statement
    on: frozenset[int] = frozenset()  # sensors whose flag a BRANCH has found on, on at least one path
    limits: tuple[tuple[int, int], ...] = ()  # the tighter of the two limits, for sensors of strain
    speeds: tuple[tuple[int, int], ...] = ()  # speeds of slides (units per cycle) that the program has set

    def joined(self, other: "Watch") -> "Watch":
        """Two paths lead to a statement. The facts about the sensors are `self` after one path, and `other` after the
        other. Return the facts before the statement.
        """
        limits, speeds, others = dict(self.limits), dict(self.speeds), dict(other.speeds)
        both = {sensor: min(limit, limits[sensor]) for sensor, limit in other.limits if sensor in limits}
        faster = {
            motor: max(speeds.get(motor, FASTEST), others.get(motor, FASTEST)) for motor in {*speeds, *others}
        }
        return Watch(
            self.guarded & other.guarded, self.on | other.on, tuple(sorted(both.items())),
            tuple(sorted(faster.items())),
        )  # fmt: skip


def lint(lines: Mapping[int, Line]) -> Iterator[Diagnostic]:
    """Yield the warnings for a program."""
    flow = Flow({number: line.statement for number, line in lines.items()})
    known = watched(flow)
    motions = sorted(number for number in known if lines[number].statement.code in MOTIONS - {"JOY"})
    yield from _unguarded(lines, known, motions)
    jolts: set[str] = set()
    for number in motions:
        line, watch = lines[number], known[number]
        if watch.on:
            names = " or ".join(map(str, sorted(watch.on - {ANY}))) or "a sensor"
            which = f"sensor {names}" if watch.on - {ANY} else names
            told = f"the flag of {which} may still be on here, and then this motion moves nothing"
            yield mistake("flag-left-on", told, line.spans[0])
        for jolt in _too_fast(line, watch):
            if jolt.message not in jolts:  # a limit is reported at the first motion that it makes too fast
                jolts.add(jolt.message)
                yield jolt


def _unguarded(
    lines: Mapping[int, Line], known: Mapping[int, Watch], motions: list[int]
) -> Iterator[Diagnostic]:
    """Warn of arm motions during which no sensor is guarded. If several unguarded motions follow each other, only the
    first one is marked.
    """
    of_the_arm = [number for number in motions if lines[number].statement.code not in ("HAND", "DHAND")]
    for guarded, group in groupby(of_the_arm, key=lambda number: bool(known[number].guarded)):
        if not guarded:
            first, *others = group
            after = counted(len(others), "motion") if len(others) > 1 else "motion"
            more = f" and the {after} after it" if others else ""
            told = f"no sensor is guarded during this motion{more}"
            yield mistake("unguarded-motion", told, lines[first].spans[0])


def watched(flow: Flow) -> dict[int, Watch]:
    """Return what is known about the sensors before each statement that can be reached."""
    known: dict[int, Watch] = {}
    todo = [(flow.numbers[0], Watch())] if flow.numbers else []
    while todo:
        number, watch = todo.pop()
        joined = watch if number not in known else known[number].joined(watch)
        if known.get(number) == joined:
            continue
        known[number] = joined
        statement = flow.statements[number]
        left = _passed(statement, joined)
        for way in flow.ways(number, likely=True):
            if way is not None:
                todo.append((way, _branched(statement, left, way)))
    return known


def _passed(statement: Statement, watch: Watch) -> Watch:
    """Return what is known about the sensors after a statement."""
    limits, speeds = dict(watch.limits), dict(watch.speeds)
    match statement.code, statement.parameters:
        case "SENSOR", ():
            return Watch(speeds=watch.speeds)
        case "SENSOR", (sensor,):
            limits.pop(_number(sensor), None)
            guarded = watch.guarded - {_number(sensor)}
        case ("SENSOR", (sensor, *_)) | ("WAND", (sensor,)):
            guarded = watch.guarded | {_number(sensor)}
            limits.pop(_number(sensor), None)
            match statement.parameters:
                case (int(), int(lower), int(upper)) if sensor in STRAIN:
                    limits[_number(sensor)] = min(abs(lower), abs(upper))
        case "WAND", ():
            sensor, guarded = 1, watch.guarded | {1}
        case (("PUT" | "FILE"), (table, motor, word, value, *_)) if table == word_of("MT") and word == _SPEED:
            for each in [motor] if isinstance(motor, int) else SLIDES:
                speeds[each] = value if isinstance(value, int) else 0
            return watch._replace(speeds=tuple(sorted(speeds.items())))
        case _:
            return watch
    on = watch.on - {sensor} if isinstance(sensor, int) else frozenset()
    return Watch(guarded, on, tuple(sorted(limits.items())), watch.speeds)


def _branched(statement: Statement, watch: Watch, way: int) -> Watch:
    """Return what is known at the statement to which a BRANCH on flags has led."""
    if statement.code != "BRANCH" or len(statement.parameters) < 2:
        return watch
    yes, no, *sensors = statement.parameters
    if yes == no or not all(isinstance(each, int) for each in sensors):
        return watch
    listed = {each for each in sensors if isinstance(each, int)}
    off = {-each for each in listed if each < 0}
    if way == yes:
        return watch if off else watch._replace(on=watch.on | (listed or {ANY}))
    return watch._replace(on=(watch.on - listed if listed else frozenset()) | off)


def _number(sensor: Parameter) -> int:
    return sensor if isinstance(sensor, int) else ANY


def _too_fast(line: Line, watch: Watch) -> Iterator[Diagnostic]:
    """Warn if the jolt at the start of a motion is beyond the limit of a finger's strain gauge. If a mass m on springs
    of stiffness k starts with speed v, the mass pulls on the springs with the force v sqrt(k m).
    """
    if not watch.limits:
        return
    speeds = dict(watch.speeds)
    speed, motor = max(
        ((speeds.get(each, FASTEST), -each) for each in moving(line.statement)), default=(0, 0)
    )
    a_unit = UNIT_M / CYCLE_S * sqrt(STIFFNESS * FINGERS_KG) / GRAM_N  # g at a speed of one unit per cycle
    limit, sensor = min((limit, sensor) for sensor, limit in watch.limits)
    if speed * a_unit > limit:
        told = (
            f"motor {-motor} starts at {counted(speed, 'unit')} per cycle; its jolt of {speed * a_unit:.0f} grams "
            f"trips sensor {sensor}, whose limit is {limit} grams"
        )
        most = int(limit / a_unit)
        cure = (
            f"write `PUT MT {-motor} {_SPEED} {most}` before the motion" if most
            else "widen the limit: even the slowest motion trips this limit"
        )  # fmt: skip
        yield mistake("too-fast", told, line.spans[0], help=cure)


def moving(statement: Statement) -> tuple[int, ...]:
    """Return the slides that a motion may move."""
    match statement.code, statement.parameters:
        case (("MOTOR" | "DMOTOR"), (motor, *_)):
            return tuple(each for each in SLIDES if motor == each or not isinstance(motor, int))
        case "MOVE", goals:
            return tuple(each for each in SLIDES if each <= len(goals))
        case "DMOVE", distances:
            return tuple(each for each in SLIDES if each <= len(distances) and distances[each - 1] != 0)
        case (("HAND" | "DHAND"), _):
            return ()
    return SLIDES
