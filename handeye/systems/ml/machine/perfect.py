"""Perfect motors: each is at its set-point when the next cycle begins. The simulation has no objects to handle, and no
errors.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Final

import numpy as np
from msgspec import field

from handeye.core.errors import BadFile, NoSuchName, Refused
from handeye.core.mutable_records import MutableRecord, put_back
from handeye.core.pose import Array
from handeye.ports.axes import Axes, AxesReading, AxisSpec, Channel, Outputs
from handeye.ports.clock import Clock
from handeye.program.events import SystemEvent
from handeye.systems.ml.level import Side
from handeye.systems.ml.machine.rectilinear import LEFT, RIGHT, axes_of
from handeye.systems.ml.machine.spec import CYCLES_PER_SECOND, ArmSpec
from handeye.systems.ml.machine.surroundings import MOST, Point, Stimulus, inside
from handeye.systems.ml.realtime.machine import Machine

_SPECS: Final[Mapping[Side, ArmSpec]] = {"right": RIGHT, "left": LEFT}


class PerfectMemory(MutableRecord, kw_only=True):
    """The complete state of an arm with perfect motors."""

    q: list[float]  # positions of the axes (m or rad)
    goal: list[float]
    powered: bool = False
    outputs: dict[str, float] = field(default_factory=dict)
    switches: dict[str, float] = field(default_factory=dict)  # values of channels that a person has set


class PerfectClock(Clock):
    """Counts cycles."""

    def __init__(self) -> None:
        self.cycles = 0
        self.arms: list[PerfectArm] = []

    @property
    def now(self) -> float:
        return self.cycles / CYCLES_PER_SECOND

    def advance(self, seconds: float) -> None:
        self.cycles += round(seconds * CYCLES_PER_SECOND)
        for arm in self.arms:
            arm.arrive()


class PerfectArm(Axes, Outputs):
    """An arm with perfect motors."""

    def __init__(
        self,
        spec: ArmSpec,
        clock: PerfectClock,
        stimuli: Sequence[Stimulus] = (),
        outline: Sequence[Point] = (),
    ) -> None:
        self.name, self._spec, self._clock = spec.side, spec, clock
        self._specs, self._stimuli, self._outline = axes_of(spec), stimuli, outline
        self._channels = tuple(
            Channel(name=name)
            for name in (
                *(source.channel for source in spec.analog.values()),
                *(name for names in spec.digital.values() for name in names),
                *spec.interlocks,
            )
        )
        known = {channel.name for channel in self._channels}
        for stimulus in stimuli:
            if stimulus.channel not in known:
                raise NoSuchName(
                    f"the {spec.side} arm has no {stimulus.channel}; it has {', '.join(sorted(known))}"
                )
        rest = [0.0] * len(self._specs)
        self.memory = PerfectMemory(q=rest, goal=list(rest), outputs=dict.fromkeys(spec.tools, 0.0))
        clock.arms.append(self)

    @property
    def specs(self) -> tuple[AxisSpec, ...]:
        return self._specs

    @property
    def channels(self) -> tuple[Channel, ...]:
        return self._channels

    @property
    def period(self) -> float:
        return self._spec.every / CYCLES_PER_SECOND

    def read(self) -> AxesReading:
        positions = {
            motor.number: round(q / motor.unit)
            for motor, q in zip(self._spec.motors, self.memory.q, strict=True)
        }
        sensed = dict.fromkeys((channel.name for channel in self._channels), 0.0)
        if self._outline:
            sensed["wand"] = float(inside(self._outline, (positions[3], positions[4])))
        for stimulus in self._stimuli:
            if stimulus.acts(self._clock.cycles, positions):
                sensed[stimulus.channel] = stimulus.value
        return AxesReading(
            time=self._clock.now, q=np.array(self.memory.q), channels=sensed | self.memory.switches
        )

    def put(self, goal: Array) -> None:
        if not self.memory.powered:
            raise Refused(f"the power of the {self.name} arm is off")
        self.memory.goal = goal.tolist()

    def power(self, on: bool) -> None:
        self.memory.powered = on
        self.memory.goal = list(self.memory.q)

    def set(self, name: str, value: float) -> None:
        if name not in self.memory.outputs:
            raise NoSuchName(
                f"the {self.name} arm has no tool {name}; it has {', '.join(self.memory.outputs)}"
            )
        self.memory.outputs[name] = value

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(self.memory.outputs)

    def arrive(self) -> None:
        """Move all motors to their set-points."""
        self.memory.q = list(self.memory.goal)

    def switch(self, channel: str, value: float) -> None:
        """Set the value of a channel, such as the panic button. The value holds until the channel is set again. Raises
        NoSuchName if the arm has no channel with this name.
        """
        names = [each.name for each in self._channels]
        if channel not in names:
            raise NoSuchName(f"the {self.name} arm has no {channel}; it has {', '.join(names)}")
        self.memory.switches[channel] = value

    def remember(self, memory: PerfectMemory, cycles: int) -> None:
        """Copy a saved state, and continue from this copy at the given cycle. Raises BadFile if the state belongs to
        another arm.
        """
        count = len(self._specs)
        names = {each.name for each in self._channels}
        if (
            not len(memory.q) == len(memory.goal) == count
            or {*memory.outputs} != {*self.memory.outputs}
            or not {*memory.switches} <= names
            or not all(abs(value) < MOST for value in (*memory.q, *memory.goal, *memory.switches.values()))
        ):
            raise BadFile(f"the saved state does not belong to the {self.name} arm")
        put_back(self.memory, memory)
        self._clock.cycles = cycles


def perfect_machine(
    tell: Callable[[SystemEvent], None] = lambda _: None,
    *,
    sides: Sequence[Side] = ("right",),
    stimuli: Sequence[Stimulus] = (),
    outline: Sequence[Point] = (),
) -> "tuple[Machine, dict[Side, PerfectArm]]":
    """Return a machine of perfect motors, and its arms. The stimuli act on the right arm, and only the right arm's
    wand can touch the outline.
    """
    clock = PerfectClock()
    arms = {
        side: PerfectArm(
            _SPECS[side], clock, stimuli if side == "right" else (), outline if side == "right" else ()
        )
        for side in sides
    }
    hardware = {side: (_SPECS[side], arm, arm) for side, arm in arms.items()}
    return Machine(hardware, clock, tell), arms
