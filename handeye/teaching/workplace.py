"""A cell in which plans are executed one after another. Each plan begins in the state that the previous one
left."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Final

import msgspec

from handeye.core.errors import Refused
from handeye.core.mutable_records import copied
from handeye.core.pose import Array
from handeye.core.source import Source
from handeye.core.variation import WorldSpec
from handeye.execution.context import ExecutionContext
from handeye.execution.state import ExecutionState
from handeye.planfile.plan import Plan
from handeye.planfile.store import encode, plan_digest, written_digest
from handeye.planning.planner import PlannedScript
from handeye.program.events import Choice, RunStarted
from handeye.program.taught import Taught
from handeye.runs.advance import Pause, advance
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup, plan_of
from handeye.runs.snapshot import Checkpoint, Snapshot
from handeye.tasks import DEFAULT
from handeye.tasks import task as known_task
from handeye.teaching.functions import TYPED, planned

MAX_STATES: Final = 100  # states that are stored for going back
_NOTHING: Final = "WHERE"
_PICTURE: Final = "LOOK SETUP"
"""Placeholder programs. A workplace holds one of these two until the user gives a program. Placeholders are never
executed.
"""
_FORGOTTEN: Final = (
    "at", "pending", "stage", "stopped", "onward", "idle", "clock", "shots", "general", "found",
    "done", "undoing",
)  # fmt: skip
"""The fields of a state that hold facts about a single plan, such as its present step, the results of its steps, and
its pictures.
"""


class Workplace:
    """The cell, the taught positions, and the memory of the working phase."""

    def __init__(
        self,
        *,
        world: WorldSpec,
        camera: str,
        taught: Taught,
        task: str = DEFAULT,
        look: bool = False,
        calibrate: bool = False,
        halt: Callable[[], bool],
        observers: Callable[[Runner], Sequence[Observer]] = lambda _: (),
    ) -> None:
        """Build the cell of a world. If `look` is True, the cell's camera is set up so that plans can take pictures.
        If `calibrate` is True, the camera is calibrated even if a calibration is stored.

        `halt` is the panic button, polled in every servo period. `observers` returns the observers for the
        runner of each plan. Raises InvalidInput if the camera cannot work as requested, and Halted if the panic
        button is pressed while the camera is set up.
        """
        self.taught, self.halt, self.observers = taught, halt, observers
        made, source = known_task(task), Source(name=TYPED, text=_PICTURE if look else _NOTHING)
        plan = planned(source, taught, made.arm, made.park, task=made.name).plan
        assert plan is not None
        start = Checkpoint(setup=Setup(plan=plan, world=world, camera=camera))
        self.runner = Runner(start, halt=halt, observers=observers, calibrate=calibrate)
        if self.runner.trouble is not None:
            raise Refused(self.runner.trouble)
        self.before: list[Checkpoint] = []  # states to go back to, the newest last

    @classmethod
    def at(
        cls,
        checkpoint: Checkpoint,
        taught: Taught | None,
        halt: Callable[[], bool],
        observers: Callable[[Runner], Sequence[Observer]] = lambda _: (),
    ) -> "Workplace":
        """Return the cell as a run has left it, with the run's memory. If `taught` is given, it replaces the
        positions in the run's plan."""
        program = plan_of(checkpoint.setup).program
        made = cls.__new__(cls)
        made.taught = taught or Taught(
            positions=program.positions, parts=program.parts, fixtures=program.fixtures, held=program.held
        )
        made.halt, made.observers, made.before = halt, observers, []
        made.runner = made._runner(checkpoint)
        return made

    # -- knowing --------------------------------------------------------------------------------------

    @property
    def run(self) -> ExecutionContext:
        """The context in which the executor works at present."""
        return self.runner.context

    @property
    def time(self) -> float:
        """The clock of all plans (s), which is 0 when the first plan begins."""
        return self.run.time

    @property
    def known(self) -> Taught:
        """The present positions and parts: those that were taught, and those that `HERE` defined."""
        positions = {**self.taught.positions, **self.run.state.world.moved}
        return replace(self.taught, positions=positions)

    @property
    def q(self) -> Array:
        """Joint positions at which the arm is held (rad or m, shape (n,))."""
        return self.run.drive.state.q

    def plan(self, source: Source, *, alone: bool = False) -> PlannedScript:
        """Plan a text from the present state. `alone` has the same meaning as in `planned`."""
        task, saved = self.runner.setup.task, self.run.state.saved
        return planned(source, self.known, self.run.arm, self.q, task=task, saved=saved, alone=alone)

    def checkpoint(self) -> Checkpoint:
        """Return a checkpoint of the present state, with all events."""
        runner = self.runner
        snapshot = Snapshot(
            position=runner.position,
            happened=len(runner.events),
            cell=runner.cell.capture(),
            state=copied(self.run.state),
        )
        return Checkpoint(setup=runner.setup, snapshot=snapshot, events=tuple(runner.events))

    # -- doing ----------------------------------------------------------------------------------------

    def carry_out(self, plan: Plan) -> Pause:
        """Execute a plan. Raises Refused if the plan takes pictures and the camera was not set up."""
        if self.run.state.calibration is None and plan.program.written("picture"):
            raise Refused("the camera is not calibrated; to take pictures, start the command with --look")
        self.mark()
        here = self.checkpoint()
        assert here.snapshot is not None
        state = _onward(self.run.state, plan)
        snapshot = msgspec.structs.replace(here.snapshot, position=0, happened=1, state=state)
        setup, begun = msgspec.structs.replace(here.setup, plan=plan), self.runner.events[0]
        assert isinstance(begun, RunStarted)
        begun = msgspec.structs.replace(
            begun, time=self.run.time, plan=plan_digest(plan), content=written_digest(encode(plan).encode()),
            program=plan.program.name, steps=len(plan.program.steps),
        )  # fmt: skip
        self.runner = self._runner(Checkpoint(setup=setup, snapshot=snapshot, events=(begun,)))
        return self._go()

    def _runner(self, start: Checkpoint) -> Runner:
        return Runner(start, halt=self.halt, observers=self.observers)

    def answer(self, choice: Choice) -> Pause:
        """Continue after a call to the operator. Raises Refused if there is no call."""
        if self.runner.call is None:
            raise Refused(f"`{choice}` answers a call to the operator, but no call is waiting for an answer")
        self.runner.answer(choice)
        return self._go()

    def _go(self) -> Pause:
        pause = advance(self.runner)
        if pause.kind == "panic":
            self.runner.rollback()
        return pause

    def mark(self) -> None:
        """Store the present state for `back`."""
        self.before = [*self.before, self.checkpoint()][-MAX_STATES:]

    def back(self) -> None:
        """Return to the state before the last plan. Raises Refused if there was no plan."""
        if not self.before:
            raise Refused("there is nothing to undo")
        self.runner = self._runner(self.before.pop())


def _onward(state: ExecutionState, plan: Plan) -> ExecutionState:
    """Return a state for the next plan. The new state keeps everything except the last plan's place and pictures."""
    program, kept = plan.program, copied(state)
    fresh = ExecutionState(drive=kept.drive, world=kept.world)
    for name in _FORGOTTEN:
        setattr(kept, name, getattr(fresh, name))
    world = kept.world
    world.measured = {part: X for part, X in world.measured.items() if part in program.parts}
    world.moved = {name: at for name, at in world.moved.items() if name in program.positions}
    return kept
