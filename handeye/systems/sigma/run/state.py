"""Defines the state of a MAL run between two statements: the states of the virtual machine and of the simulated
machine.
"""

from msgspec import field

from handeye.program.system_state import SystemState, TaskPlace
from handeye.systems.sigma.bus.wired import BusMemory
from handeye.systems.sigma.machine.perfect import PerfectMemory
from handeye.systems.sigma.mal.memory import MalMemory


class MalState(SystemState, kw_only=True):
    """The complete state of a run, except the program."""

    memory: MalMemory = field(default_factory=MalMemory)
    machine: PerfectMemory | None = None  # state of perfect motors
    bus: BusMemory | None = None  # state of a bus with wires
    standing: list[TaskPlace] = field(default_factory=list)
    """The place of each unfinished task; the task whose turn it is comes first."""

    @property
    def places(self) -> tuple[TaskPlace, ...]:
        return tuple(self.standing)
