"""The hardware that a run moves: either perfect motors, or a station with a job."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, ClassVar, NamedTuple

from handeye.core.errors import BadFile
from handeye.core.markup import PagePart
from handeye.core.variation import WorldSpec
from handeye.execution.servo import ServoPeriod
from handeye.ports.axes import Channel
from handeye.program.events import SystemEvent
from handeye.results.result import Result
from handeye.systems.ml.level import Side
from handeye.systems.ml.machine.perfect import PerfectMemory, perfect_machine
from handeye.systems.ml.realtime.machine import Machine
from handeye.systems.ml.run.plan import MlPlan
from handeye.tasks.interface import AnyTask

if TYPE_CHECKING:  # programs run on perfect motors without a simulator
    from handeye.cell.snapshot_cell import SnapshotCell

Tell = Callable[[SystemEvent], None]


class Ending(NamedTuple):
    """How a run has ended, according to its job."""

    done: bool  # False: the operator is called
    text: str


class Hardware(ABC):
    """The machine of a run. The machine gives the run the state that the run shows. The machine passes printed
    lines and executed statements to its job.
    """

    machine: Machine
    joints: Sequence[str] = ()
    channels: Sequence[Channel] = ()
    watched: int = 1  # cycles from one state that a trace keeps to the next

    @property
    def cell(self) -> "SnapshotCell | None":
        """The simulated cell, or None."""
        return None

    @property
    def servo_period(self) -> ServoPeriod | None:
        """The present state of the arm for traces; None if the machine has no visible arm."""
        return None

    @property
    def memory(self) -> dict[Side, PerfectMemory]:
        """The part of the hardware's state that the cell does not store."""
        return {}

    def remember(self, memory: Mapping[Side, PerfectMemory]) -> None:
        """Continue from a copy of a state. Raises BadFile if the state does not fit this hardware."""
        if memory:
            raise BadFile("the saved state belongs to perfect motors")

    @abstractmethod
    def signal(self, interlock: str, *, on: bool) -> None:
        """Switch the signal of an interlock, which a person or a device would switch in a real room. Raises NoSuchName
        if the hardware has no interlock with this name.
        """

    def hear(self, text: str) -> None:  # noqa: B027 - few jobs listen
        """Called with each line that the program prints."""

    def ending(self, statement: int) -> Ending | None:
        """Return how the job has ended, if a statement has ended the job. Return None if the job continues."""
        return None

    @property
    def figures(self) -> Mapping[str, float]:
        """Numbers that the job adds to the result of the run."""
        return {}

    def files(self, world: WorldSpec, result: Result, parts: Sequence[PagePart]) -> Mapping[str, bytes]:
        """Return the files that the job adds to the folder of a finished run. If the job makes a report of its own, the
        report ends with `parts`.
        """
        return {}


class PerfectHardware(Hardware):
    """Perfect motors."""

    def __init__(self, plan: MlPlan, tell: Tell) -> None:
        sides: tuple[Side, ...] = ("right",) if plan.left is None else ("right", "left")
        self.machine, self._arms = perfect_machine(
            tell, sides=sides, stimuli=plan.stimuli, outline=plan.outline
        )

    @property
    def memory(self) -> dict[Side, PerfectMemory]:
        return {side: arm.memory for side, arm in self._arms.items()}

    def remember(self, memory: Mapping[Side, PerfectMemory]) -> None:
        if {*memory} != {*self._arms}:
            raise BadFile("the saved state belongs to other arms")
        for side, arm in self._arms.items():
            arm.remember(memory[side], self.machine.now)

    def signal(self, interlock: str, *, on: bool) -> None:
        for arm in self._arms.values():
            arm.switch(interlock, float(on))


class StationTask(AnyTask):
    """A task whose programs run on a simulated station."""

    system: ClassVar[str] = "ml"

    @abstractmethod
    def hardware(self, plan: MlPlan, world: WorldSpec, tell: Tell) -> Hardware:
        """Build the station of a plan in a world, and return its hardware."""
