"""Draws programs of SENSOR, motions, DELAY and BRANCH with traces of sensors, and compares the machine with the
specification `handeye/systems/ml/guarded.py` after every statement.

    python tests/systems/ml/drawn_programs.py 10000
"""

import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from random import Random
from typing import Final

from level_bench import STRAIN, Rig, rig

from handeye.systems.ml.background.interpreter import Interpreter
from handeye.systems.ml.background.program import StoredProgram
from handeye.systems.ml.guarded import (
    Branch,
    Delay,
    Motion,
    Sensor,
    State,
    Statement,
    branch,
    execute,
)
from handeye.systems.ml.happenings import Nullified
from handeye.systems.ml.machine.rectilinear import RIGHT
from handeye.systems.ml.machine.surroundings import Stimulus

CHANNELS: Final = {1: ("wand", 1.0), 5: ("right_strain_x", STRAIN), 8: ("range", 1e-4)}
"""The channels of three sensors, with the size of a unit of their readings."""
MOTORS: Final = (2, 3, 9)
SPEEDS: Final = {motor.number: motor.peak for motor in RIGHT.motors}
MOST_STATEMENTS: Final = 40
WITHIN: Final = 9000  # units from the middle of the travel, of which the specification knows nothing
NO_LIMIT: Final = 32_767  # statements in a cycle


@dataclass(frozen=True, slots=True, kw_only=True)
class Value:
    """A reading that a sensor has under a condition."""

    sensor: int
    reading: int
    since: int
    until: int
    motor: int  # 0: wherever the motors are
    beyond: int

    @property
    def stimulus(self) -> Stimulus:
        channel, unit = CHANNELS[self.sensor]
        return Stimulus(
            channel=channel, value=self.reading * unit, since=self.since, until=self.until, motor=self.motor,
            beyond=self.beyond,
        )  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class Drawn:
    """A program with the values that its sensors have."""

    program: Mapping[int, Statement]
    trace: Sequence[Value]

    def readings(self, cycle: int, positions: Mapping[int, int]) -> dict[int, int]:
        found = dict.fromkeys(CHANNELS, 0)
        for value in self.trace:
            near = not value.motor or positions[value.motor] >= value.beyond
            if value.since <= cycle < value.until and near:
                found[value.sensor] = value.reading
        return found

    @property
    def text(self) -> str:
        return "\n".join(f"{number} {written(each)}" for number, each in self.program.items())


def drawn(seed: int) -> Drawn:
    """Draw a program."""
    random = Random(seed)  # noqa: S311 - no secret
    numbers = [10 * n for n in range(1, random.randint(3, 14))]
    return Drawn(
        program={number: _statement(random, numbers) for number in numbers},
        trace=[_value(random) for _ in range(random.randint(0, 6))],
    )


def _value(random: Random) -> Value:
    sensor, since = random.choice([*CHANNELS]), random.randint(0, 60)
    return Value(
        sensor=sensor,
        reading=random.randint(0, 1) if sensor == 1 else random.randint(0, 4),
        since=since,
        until=since + random.choice((1, 2, 5, 20, 1000)),
        motor=random.choice((0, 0, *MOTORS)),
        beyond=random.randint(-400, 400),
    )


def _statement(random: Random, numbers: Sequence[int]) -> Statement:
    kind = random.random()
    sensor = random.choice([*CHANNELS])
    if kind < 0.25:
        return Sensor(sensor=sensor, limits=(random.randint(-1, 1), random.randint(2, 4)))
    if kind < 0.30:
        return Sensor(sensor=sensor)
    if kind < 0.38:
        return Sensor()
    if kind < 0.72:
        motors = random.sample(MOTORS, random.randint(1, len(MOTORS)))
        return Motion(
            by_motor={motor: random.randint(-600, 600) for motor in motors}, relative=random.random() < 0.5
        )
    if kind < 0.80:
        return Delay(cycles=random.randint(0, 8))
    sensors = random.sample([*CHANNELS], random.randint(0, len(CHANNELS)))
    signed = tuple(random.choice((sensor, sensor, -sensor)) for sensor in sensors)
    other = random.choice((None, *numbers))
    return Branch(then=random.choice(numbers), other=other, sensors=() if other is None else signed)


def written(statement: Statement) -> str:
    """Write a statement in ML."""
    words: list[object]
    match statement:
        case Sensor(sensor=sensor, limits=limits):
            words = ["SENSOR", *([] if sensor is None else [sensor]), *(limits or ())]
        case Motion(by_motor=by_motor, relative=relative) if len(by_motor) == 1:
            ((motor, value),) = by_motor.items()
            words = ["DMOTOR" if relative else "MOTOR", motor, value]
        case Motion(by_motor=by_motor, relative=True):
            words = ["DMOVE", *(by_motor.get(motor, 0) for motor in range(1, max(by_motor) + 1))]
        case Motion(by_motor=by_motor):
            words = ["MOVE", *(by_motor.get(motor, 0) for motor in range(1, max(by_motor) + 1))]
        case Delay(cycles=cycles):
            words = ["DELAY", cycles]
        case Branch(then=then, other=other, sensors=sensors):
            words = ["BRANCH", then, *([] if other is None else [other]), *sensors]
    return " ".join(map(str, words))


def whole(statement: Statement) -> Statement:
    """The statement as ML reads it: a MOVE commands every motor up to its last number."""
    match statement:
        case Motion(by_motor=by_motor, relative=False) if len(by_motor) > 1:
            installed = [motor for motor in SPEEDS if motor <= max(by_motor)]
            return Motion(by_motor={motor: by_motor.get(motor, 0) for motor in installed})
    return statement


def compared(seed: int) -> Iterator[tuple[str, object, object]]:
    """Yield what the specification and the machine say after each statement of a drawn program."""
    case = drawn(seed)
    machine = rig(*(value.stimulus for value in case.trace))
    mos = _begun(case, machine)
    state, at = State.at(dict.fromkeys(SPEEDS, 0)), min(case.program)
    for _ in range(MOST_STATEMENTS):
        statement, here = whole(case.program[at]), at
        at = min((number for number in case.program if number > here), default=0)
        ending = ""
        if isinstance(statement, Branch):
            at = branch(statement, state.flags)
        else:
            state, ending = execute(statement, state, case.readings, SPEEDS)
        machine.events.clear()
        mos.statement()
        while not mos.ready():
            machine.machine.cycle()
        said = (here, ending, state.cycle, at, state.flags, state.goals, state.positions)
        yield case.text, said, _told(here, statement, mos, machine)
        if not at or max(map(abs, state.goals.values())) > WITHIN:
            return


def _begun(case: Drawn, machine: Rig) -> Interpreter:
    program = StoredProgram()
    mos = Interpreter("right", machine.machine.levels, program, machine.events.append)
    for line in case.text.splitlines():
        mos.type_line(line)
    machine.right.write("CY", 1, 5, NO_LIMIT)
    mos.run()
    return mos


def _told(number: int, statement: Statement, mos: Interpreter, machine: Rig) -> object:
    level = machine.right
    nullified = bool(machine.seen(Nullified))
    ending = "nullified" if nullified else level.posted if isinstance(statement, Motion) else ""
    true = machine.arms["right"].memory.q
    positions = {motor.number: round(q / motor.unit) for motor, q in zip(RIGHT.motors, true, strict=True)}
    goals = {motor: level.goal(motor) for motor in level.motors}
    return number, ending, level.now, mos.memory.at, frozenset(level.flags), goals, positions


def first_difference(seed: int) -> str | None:
    """Return a message if specification and machine disagree on a drawn program, or None."""
    for text, said, told in compared(seed):
        if said != told:
            return f"seed {seed}:\n{text}\nspecification {said}\nmachine       {told}"
    return None


if __name__ == "__main__":
    count = int(sys.argv[1])
    differences = filter(None, map(first_difference, range(count)))
    print(next(differences, f"{count} programs: specification and machine agree"))  # noqa: T201 - a command
