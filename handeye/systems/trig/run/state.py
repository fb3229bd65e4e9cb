"""The state of a taught program between steps, as one record. The steps themselves are in the plan."""

from typing import Final

import msgspec

from handeye.core.errors import BadFile, Refused
from handeye.core.record import Record
from handeye.execution.state import ReversalOrder
from handeye.program.system_state import SystemState
from handeye.systems.trig.jobs.benches import TaughtPlan
from handeye.systems.trig.language.axes_arm import ArmMemory
from handeye.systems.trig.language.graph import NONE, TOP
from handeye.systems.trig.language.place import Place
from handeye.systems.trig.language.program import RecordedStep, TrigProgram
from handeye.systems.trig.language.trig_arm import Obstacle
from handeye.systems.trig.run.plan import listing

_MAX_MEASURE: Final = 1000.0  # m and rad


class CompletedStep(Record, frozen=True, kw_only=True):
    """An executed step that has not been reversed."""

    step: int
    enters: bool  # the first of the program


class Turn(Record, frozen=True, kw_only=True):
    """The point at which the reversal of a job began."""

    steps: int  # executed by then
    ended: bool  # the program was complete
    time: float  # s by the run's clock


class TaughtState(SystemState, kw_only=True):
    """The whole state of a taught program, except its steps."""

    came: int = TOP  # node executed before the next step
    undoing: ReversalOrder | None = None  # the reversal in progress
    turn: Turn | None = None  # the job's own reversal, in progress or complete
    obstacle: Obstacle | None = None  # what stopped the reversal
    rounds: dict[int, int] = msgspec.field(default_factory=dict)  # by loop node
    fathers: dict[int, int] = msgspec.field(default_factory=dict)  # most recent father by node
    taught: dict[str, Place] = msgspec.field(default_factory=dict)  # values of the positions, as taught
    positions: dict[str, Place] = msgspec.field(default_factory=dict)  # present values of the positions
    trail: list[RecordedStep] = msgspec.field(
        default_factory=list
    )  # steps that were executed and not reversed
    forgotten: bool = False
    cursor: int = TOP
    taken: int | None = None
    ended_at: Place | None = None
    arm: ArmMemory | None = None  # None: the arm has not begun

    def order(self, plan: TaughtPlan, undoing: ReversalOrder) -> None:
        """Order a reversal. Raises Refused if there is nothing to reverse."""
        executed = self.executed(plan)
        if undoing.left >= len(executed):
            raise Refused("there is nothing to undo")
        self.undoing, self.stopped, self.onward, self.obstacle, self.turn = undoing, None, None, None, None
        self.at = executed[-1].step

    def executed(self, plan: TaughtPlan) -> list[CompletedStep]:
        """Return the executed steps that have not been reversed. The first one is marked as the step that enters the
        stage.
        """
        numbers = listing(plan).numbers
        found = [numbers[done.node] for done in self.trail if done.node in numbers]
        return [CompletedStep(step=number, enters=not before) for before, number in enumerate(found)]

    def note(self, program: TrigProgram, arm: ArmMemory) -> None:
        """Record a program's state between two steps."""
        nodes = program.graph.nodes.values()
        self.rounds = {node.id: node.count for node in nodes if node.type == "loop"}
        self.fathers = {node.id: node.last_father for node in nodes}
        self.taught = {name: position.init for name, position in program.positions.items()}
        self.positions = {name: position.data for name, position in program.positions.items()}
        self.trail, self.forgotten = list(program.trail), program.forgotten
        self.cursor, self.taken, self.ended_at = program.cursor, program.taken, program.ended_at
        self.arm = arm

    def check(self, program: TrigProgram, steps: int) -> None:
        """Raise BadFile unless the state fits a program with the given number of steps."""
        nodes, names = {*program.graph.nodes}, {*program.positions}
        ids = {self.came, self.cursor, *self.fathers, *self.rounds, *(done.node for done in self.trail)}
        ids |= {*self.fathers.values()} - {NONE}
        wanted = {done.position for done in self.trail} - {""}
        numbers = [number for number in (self.at, self.onward) if number is not None]
        if (
            not ids <= nodes
            or {*self.taught} != names
            or {*self.positions} != names
            or not wanted <= names
            or any(number >= steps for number in numbers)
            or self.stage not in (None, 0)
            or (self.undoing is not None and not any(program.graph[done.node].shown for done in self.trail))
            or self.arm is None
            or not max(map(abs, (*self.arm.told, self.arm.opening))) < _MAX_MEASURE
        ):
            raise BadFile("the state of the run does not fit this program")

    def put_into(self, program: TrigProgram) -> None:
        for id, node in program.graph.nodes.items():
            node.count, node.last_father = self.rounds.get(id, 0), self.fathers.get(id, NONE)
        for name, position in program.positions.items():
            position.init, position.data = self.taught[name], self.positions[name]
        program.trail.clear()
        program.trail.extend(self.trail)
        program.forgotten, program.cursor, program.taken = self.forgotten, self.cursor, self.taken
        program.ended_at, program.cut, program.paused = self.ended_at, None, NONE
