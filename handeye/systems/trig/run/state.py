"""What a taught program remembers between two steps, as one record; its steps themselves stand in its plan."""

from typing import Final

import msgspec

from handeye.core.errors import BadFile, Refused
from handeye.core.record import Record
from handeye.execution.undo.done import Undoing
from handeye.program.system_state import SystemState
from handeye.systems.trig.jobs.benches import TaughtPlan
from handeye.systems.trig.language.axes_arm import ArmMemory
from handeye.systems.trig.language.node import NONE, TOP
from handeye.systems.trig.language.obstacles import Obstacle
from handeye.systems.trig.language.place import Place
from handeye.systems.trig.language.program import RecordedStep, TrigProgram
from handeye.systems.trig.run.plan import listing

_FARTHEST: Final = 1000.0
"""m and rad: no arm is told to go there."""


class Executed(Record, frozen=True, kw_only=True):
    """A step that was executed and not undone."""

    step: int
    enters: bool
    """The program began with it."""


class Turn(Record, frozen=True, kw_only=True):
    """Where a job had the arm turn back, to undo what it did."""

    steps: int
    """Executed by then."""
    ended: bool
    """The program had come to its end."""
    time: float
    """s, by the clock of the run."""


class TaughtState(SystemState, kw_only=True):
    """Everything but the steps."""

    came: int = TOP
    """The node that was carried out before the step to do next."""
    undoing: Undoing | None = None
    """The arm undoes what it did, so far."""
    turn: Turn | None = None
    """The job is on its way back, or back; None: it is not, or what is undone is undone for somebody else."""
    obstacle: Obstacle | None = None
    """What it has met there, and was stopped by."""
    rounds: dict[int, int] = msgspec.field(default_factory=dict)
    """How often each loop has gone back, by its node."""
    fathers: dict[int, int] = msgspec.field(default_factory=dict)
    """The most recent father of each node."""
    taught: dict[str, Place] = msgspec.field(default_factory=dict)
    """Positions as they were taught."""
    positions: dict[str, Place] = msgspec.field(default_factory=dict)
    """As they are now."""
    trail: list[RecordedStep] = msgspec.field(default_factory=list)
    """What was done and not undone."""
    forgotten: bool = False
    cursor: int = TOP
    taken: int | None = None
    ended_at: Place | None = None
    arm: ArmMemory | None = None
    """None: it has not begun."""

    def order(self, plan: TaughtPlan, undoing: Undoing) -> None:
        """From now on each step undoes one.

        Raises:
            InvalidInput: no more was executed than what is to be left.
        """
        executed = self.executed(plan)
        if undoing.left >= len(executed):
            raise Refused("there is nothing to undo")
        self.undoing, self.stopped, self.onward, self.obstacle, self.turn = undoing, None, None, None, None
        self.at = executed[-1].step

    def executed(self, plan: TaughtPlan) -> list[Executed]:
        """Steps that were executed and not undone."""
        numbers = listing(plan).numbers
        found = [numbers[done.node] for done in self.trail if done.node in numbers]
        return [Executed(step=number, enters=not before) for before, number in enumerate(found)]

    def note(self, program: TrigProgram, arm: ArmMemory) -> None:
        """Take down what a program remembers, between two steps."""
        nodes = program.graph.nodes.values()
        self.rounds = {node.id: node.count for node in nodes if node.type == "loop"}
        self.fathers = {node.id: node.last_father for node in nodes}
        self.taught = {name: position.init for name, position in program.positions.items()}
        self.positions = {name: position.data for name, position in program.positions.items()}
        self.trail, self.forgotten = list(program.trail), program.forgotten
        self.cursor, self.taken, self.ended_at = program.cursor, program.taken, program.ended_at
        self.arm = arm

    def check(self, program: TrigProgram, steps: int) -> None:
        """See that it can be a state of a program of so many steps.

        Raises:
            InvalidInput: it cannot.
        """
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
            or not max(map(abs, (*self.arm.told, self.arm.opening))) < _FARTHEST
        ):
            raise BadFile("the state of the run does not fit this program")

    def put_into(self, program: TrigProgram) -> None:
        """Let a program remember what was taken down."""
        for id, node in program.graph.nodes.items():
            node.count, node.last_father = self.rounds.get(id, 0), self.fathers.get(id, NONE)
        for name, position in program.positions.items():
            position.init, position.data = self.taught[name], self.positions[name]
        program.trail.clear()
        program.trail.extend(self.trail)
        program.forgotten, program.cursor, program.taken = self.forgotten, self.cursor, self.taken
        program.ended_at, program.cut, program.paused = self.ended_at, None, NONE
