"""Defines the state of an ML run between two statements."""

from typing import Final

from msgspec import field

from handeye.program.system_state import SystemState, TaskPlace
from handeye.systems.ml.background.memory import BackgroundMemory
from handeye.systems.ml.background.program import ProgramMemory
from handeye.systems.ml.dashboard.history import Head, History, history
from handeye.systems.ml.dashboard.tape import Tape, changes_of
from handeye.systems.ml.level import Side
from handeye.systems.ml.machine.perfect import PerfectMemory
from handeye.systems.ml.realtime.machine import MachineMemory
from handeye.systems.ml.run.plan import MlPlan

SIDES: Final[tuple[Side, ...]] = ("right", "left")


class MlState(SystemState, kw_only=True):
    """The complete state of a run: the background level, the real-time level, the stored program, and perfect motors.
    The state of a simulated arm is in the cell.
    """

    program: ProgramMemory = field(default_factory=ProgramMemory)
    background: dict[Side, BackgroundMemory] = field(default_factory=dict)
    machine: MachineMemory = field(default_factory=MachineMemory)
    perfect: dict[Side, PerfectMemory] = field(default_factory=dict)
    texts: dict[str, str] = field(default_factory=dict)  # programs that the host keeps
    statements: int = 0  # executed
    tape: Tape = field(default_factory=Tape)  # the tables in each cycle
    standing: list[TaskPlace] = field(default_factory=list)
    """For each arm whose program has not ended, the place in this program. The program whose turn it is comes first."""

    @property
    def places(self) -> tuple[TaskPlace, ...]:
        return tuple(self.standing)


def tables_of(plan: MlPlan, state: MlState) -> History:
    """Return all tables at all cycles up to a state of a run. Raises BadFile if the recording cannot be read."""
    arms = state.machine.arms
    head = Head(
        program=plan.name,
        sides=tuple(side for side in SIDES if side in arms),
        cycles=max((arm.now for arm in arms.values()), default=0),
        statements={number: str(line.statement) for number, line in plan.lines.items()},
    )
    return history(head, changes_of(state.tape))
