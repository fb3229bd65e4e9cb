"""A machine: one or two arms, each with its real-time level, under one clock."""

from collections.abc import Callable, Mapping
from typing import Final

from msgspec import field

from handeye.core.errors import BadFile
from handeye.core.mutable_records import MutableRecord, put_back
from handeye.ports.axes import Axes, Outputs
from handeye.ports.clock import Clock
from handeye.program.events import SystemEvent
from handeye.systems.ml.level import Side
from handeye.systems.ml.machine.spec import CYCLE, ArmSpec
from handeye.systems.ml.realtime.level import RealTime
from handeye.systems.ml.tables.store import ArmMemory, SharedMemory

_SHARED_LENGTHS: Final = {name: len(getattr(SharedMemory(), name)) for name in SharedMemory.__struct_fields__}


class MachineMemory(MutableRecord, kw_only=True):
    """The complete state of both levels, without the hardware."""

    shared: SharedMemory = field(default_factory=SharedMemory)
    arms: dict[str, ArmMemory] = field(default_factory=dict)  # by side


class Machine:
    """The real-time levels of the arms. The levels have some tables in common. The arms do not wait for each other, and
    do not avoid each other.
    """

    def __init__(
        self,
        hardware: Mapping[Side, tuple[ArmSpec, Axes, Outputs]],
        clock: Clock,
        tell: Callable[[SystemEvent], None] = lambda _: None,
    ) -> None:
        self._clock = clock
        shared = SharedMemory()
        self.levels: dict[Side, RealTime] = {
            side: RealTime(spec, axes, outputs, shared, tell)
            for side, (spec, axes, outputs) in hardware.items()
        }
        self.memory = MachineMemory(
            shared=shared, arms={side: level.memory for side, level in self.levels.items()}
        )

    @property
    def now(self) -> int:
        """Number of cycles since the beginning."""
        return next(iter(self.levels.values())).now

    def cycle(self) -> None:
        """Execute one cycle of each arm; then ten milliseconds pass."""
        for level in self.levels.values():
            level.cycle()
        timers = self.memory.shared.TM
        timers[:] = [max(count - 1, 0) for count in timers]
        self._clock.advance(CYCLE)

    def remember(self, memory: MachineMemory) -> None:
        """Continue from a copy of a state. Raises BadFile if the state belongs to another machine."""
        shared = memory.shared
        if {*memory.arms} != {*self.levels} or any(
            name != "US" and len(getattr(shared, name)) != length for name, length in _SHARED_LENGTHS.items()
        ):
            raise BadFile("the saved state does not belong to this machine")
        for side, level in self.levels.items():
            level.remember(memory.arms[side])
        put_back(self.memory.shared, shared)
