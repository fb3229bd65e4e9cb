"""The guarded move of ML, as an executable specification.

The specification covers programs that consist of SENSOR, motions, DELAY and BRANCH. It assumes that each motor is at
its set-point when the next cycle begins. The specification is pure: the present state and the readings of the sensors
determine the next state. The specification shares no code with the machine; a property test drives both with the same
programs and compares them after every statement.

1. A sensor is *in range* while its reading is strictly between its expected limits.
2. The *flag* of a sensor comes on in the first cycle in which the sensor is out of range. The flag stays on until a
   SENSOR statement clears it, even if the reading comes back into range (the latch).
3. In the cycle in which any flag comes on, every motor *freezes*: its goal becomes its present position.
4. While any flag is on, every motion is *nullified*: it changes no goal and takes no time.
5. A motion ends when all motors are at their goals, or when a flag comes on. Then the next statement is executed.
6. BRANCH reads flags and clears none, so that several BRANCH statements in a row can test which flags are on.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Final, Literal

Limits = tuple[int, int]
Readings = Mapping[int, int]  # readings by the numbers of the sensors
Senses = Callable[[int, Mapping[int, int]], Readings]
"""Function that takes the number of a cycle and the positions of the motors, and returns the readings of the sensors.
"""

FINE: Final = 100  # set-points are counted in hundredths of a unit, because 20 cm/s is 78.74 units per cycle


@dataclass(frozen=True, slots=True, kw_only=True)
class Sensor:
    """`SENSOR`: set or open the limits of one sensor, or open the limits of all sensors. Clear the flags of these
    sensors. If the limits of a sensor are open, every reading is in range.
    """

    sensor: int | None = None  # None: all
    limits: Limits | None = None  # None: open


@dataclass(frozen=True, slots=True, kw_only=True)
class Motion:
    """A motion. If `relative` is False, this is a `MOVE` or a `MOTOR`. If `relative` is True, this is a `DMOVE` or a
    `DMOTOR`, and the numbers are distances from the present goals.
    """

    by_motor: Mapping[int, int]
    relative: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Delay:
    """`DELAY`: let cycles pass, with all guards active."""

    cycles: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Branch:
    """`BRANCH`: go to `then` if the flag of any listed sensor is on. A minus sign reverses the test: -5 in the list
    means that the flag of sensor 5 is off.
    """

    then: int
    other: int | None = None  # None: the branch always goes to `then`
    sensors: tuple[int, ...] = ()  # empty: any sensor


Statement = Sensor | Motion | Delay | Branch
Ending = Literal["", "goal", "force", "nullified"]


@dataclass(frozen=True, slots=True, kw_only=True)
class State:
    """The arm and its guards between two statements."""

    cycle: int = 0
    positions: Mapping[int, int]  # by motor
    goals: Mapping[int, int]
    set_points: Mapping[int, int]  # hundredths of a unit
    limits: Mapping[int, Limits]  # limits of those sensors whose limits are not open
    flags: frozenset[int] = frozenset()

    @staticmethod
    def at(positions: Mapping[int, int]) -> "State":
        """Return the state of an arm that stands still and has no guards."""
        fine = {motor: FINE * position for motor, position in positions.items()}
        return State(positions=positions, goals=positions, set_points=fine, limits={})


def in_range(reading: int, limits: Limits) -> bool:
    lower, upper = limits
    return lower < reading < upper


def crossed(state: State, readings: Readings) -> frozenset[int]:
    """Return the sensors whose flags come on."""
    return frozenset(
        sensor
        for sensor, limits in state.limits.items()
        if sensor not in state.flags and not in_range(readings[sensor], limits)
    )


def arrived(state: State) -> bool:
    return state.positions == state.goals and all(
        state.set_points[motor] == FINE * goal for motor, goal in state.goals.items()
    )


def one_cycle(state: State, senses: Senses, speeds: Mapping[int, int]) -> tuple[State, Ending]:
    """Let a cycle pass. If a motion ends in this cycle, also return how the motion ended. `speeds` are in hundredths
    of a unit per cycle.
    """
    new = crossed(state, senses(state.cycle, state.positions))
    ending: Ending = "force" if new else "goal" if arrived(state) else ""
    goals = state.positions if new else state.goals
    set_points = {
        motor: point + max(-speeds[motor], min(speeds[motor], FINE * goals[motor] - point))
        for motor, point in state.set_points.items()
    }
    positions = {motor: round(point / FINE) for motor, point in set_points.items()}
    flags = state.flags | new
    return (
        replace(
            state, cycle=state.cycle + 1, positions=positions, goals=goals, set_points=set_points, flags=flags
        ),
        ending,
    )


def execute(
    statement: Statement, state: State, senses: Senses, speeds: Mapping[int, int]
) -> tuple[State, Ending]:
    """Execute a statement other than BRANCH. If the statement is a motion, also return how the motion ended."""
    ending: Ending = ""
    match statement:
        case Sensor(sensor=None):
            state = replace(state, limits={}, flags=frozenset())
        case Sensor(sensor=int(sensor), limits=limits):
            kept = {other: pair for other, pair in state.limits.items() if other != sensor}
            limited = kept if limits is None else {**kept, sensor: limits}
            state = replace(state, limits=limited, flags=state.flags - {sensor})
        case Motion() if state.flags:
            ending = "nullified"
        case Motion(by_motor=asked, relative=relative):
            start = state.goals if relative else dict.fromkeys(asked, 0)
            state = replace(state, goals={**state.goals, **{m: start[m] + x for m, x in asked.items()}})
            while not ending:
                state, ending = one_cycle(state, senses, speeds)
        case Delay(cycles=cycles):
            for _ in range(cycles):
                state, _ = one_cycle(state, senses, speeds)
    return state, ending


def branch(statement: Branch, flags: frozenset[int]) -> int:
    """Return the number of the statement to which BRANCH goes."""
    if statement.other is None:
        return statement.then
    asked = statement.sensors
    holds = any((abs(sensor) in flags) == (sensor > 0) for sensor in asked) if asked else bool(flags)
    return statement.then if holds else statement.other
