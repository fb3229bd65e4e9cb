"""The real-time level on perfect motors, for tests."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final, TypeVar

from handeye.program.events import SystemEvent
from handeye.systems.ml.level import Side
from handeye.systems.ml.machine.perfect import PerfectArm, perfect_machine
from handeye.systems.ml.machine.surroundings import Point, Stimulus
from handeye.systems.ml.realtime.level import RealTime
from handeye.systems.ml.realtime.machine import Machine

STRAIN: Final = 9.80665e-3  # N, one gram-force
FEATURED: Final = "right_strain_x"  # the channel of sensor 5
LONGEST: Final = 5000  # cycles

Kind = TypeVar("Kind", bound=SystemEvent)


@dataclass(slots=True)
class Rig:
    """A machine of perfect motors, whose pump is on."""

    machine: Machine
    arms: Mapping[Side, PerfectArm]
    events: list[SystemEvent] = field(default_factory=list)

    @property
    def right(self) -> RealTime:
        return self.machine.levels["right"]

    @property
    def left(self) -> RealTime:
        return self.machine.levels["left"]

    def pass_cycles(self, count: int) -> None:
        for _ in range(count):
            self.machine.cycle()

    def move(self, goals: Mapping[int, int], level: RealTime | None = None) -> int:
        """Execute a motion. Returns the cycles that it took."""
        level = level or self.right
        if not level.start(goals):
            return 0
        for count in range(1, LONGEST):
            self.machine.cycle()
            if level.posted:
                return count
        raise AssertionError("the motion does not end")

    def seen(self, kind: type[Kind]) -> list[Kind]:
        return [event for event in self.events if isinstance(event, kind)]


def rig(
    *stimuli: Stimulus, sides: Sequence[Side] = ("right",), outline: Sequence[Point] = (), on: bool = True
) -> Rig:
    events: list[SystemEvent] = []
    machine, arms = perfect_machine(events.append, sides=sides, stimuli=stimuli, outline=outline)
    if on:
        for level in machine.levels.values():
            level.enable()
    return Rig(machine, arms, events)


def pressed(grams: float, **when: int) -> Stimulus:
    """The strain that sensor 5 reads, under a condition."""
    return Stimulus(channel=FEATURED, value=grams * STRAIN, **when)  # type: ignore[arg-type]
