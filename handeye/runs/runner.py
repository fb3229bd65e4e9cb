"""A run that can be stepped, stopped and restored.

After every step, the cell's state is captured and immediately restored. This restoration resets whatever the captured
state does not contain (see `SimulatedCell.restore`). A run that is interrupted and resumed therefore takes the same
course, byte for byte, as a run that is not interrupted.
"""

from __future__ import annotations

import itertools
import time
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Final

from handeye.core.entries import Capability, refusal, require
from handeye.core.errors import BadArgument, BadFile, PhysicsFailed, Refused
from handeye.core.mutable_records import copied
from handeye.core.plain_text import counted
from handeye.execution.context import ExecutionContext, Stopwatch
from handeye.execution.controlling import Controller, controlled, repeated
from handeye.execution.scheduler import Deadlock
from handeye.execution.servo import Halted, ServoPeriod
from handeye.execution.state import ReversalOrder
from handeye.program.events import (
    AnyEvent,
    AskedBy,
    Choice,
    ExperimentMade,
    LineTyped,
    OperatorAnswered,
    OperatorCalled,
    PanicStopped,
    PeriodsCommanded,
    StageStarted,
    StepFinished,
    StepStarted,
    UndoEnded,
    UndoOrdered,
)
from handeye.program.system_state import TaskPlace
from handeye.runs.observer import Observer
from handeye.runs.parts import OWN, Parts
from handeye.runs.snapshot import Checkpoint, Snapshot, interfered
from handeye.runs.system import RunCallbacks, RunningSystem, StepFacts
from handeye.runs.systems import listing_of, system_of
from handeye.tasks import any_task
from handeye.tasks.interface import AnyTask

if TYPE_CHECKING:
    from handeye.cell.simulated import SimulatedCell
    from handeye.cell.snapshot_cell import SnapshotCell

RECENT: Final = 400  # steps whose states stay in memory; older states only at the beginning of stages


def reach(first: int) -> str:
    """Return a sentence that says that a run cannot go back beyond its earliest state. `first` is the number of steps
    that came before this state.
    """
    return (
        f"this run begins with {counted(first, 'step')} already done: there is no earlier state to go back to"
    )


def _typed_within_step(events: Sequence[AnyEvent]) -> list[LineTyped]:
    """Return the lines that were typed during the first step of these events."""
    within = itertools.takewhile(lambda event: not isinstance(event, StepFinished), events)
    return [event for event in within if isinstance(event, LineTyped)]


class Runner:
    """A run of a plan in a world, from its beginning or from a checkpoint."""

    def __init__(
        self,
        start: Checkpoint,
        *,
        halt: Callable[[], bool] = lambda: False,
        viewed: Callable[[int, int], None] = lambda *_: None,
        observers: Callable[[Runner], Sequence[Observer]] = lambda _: (),
        parts: Parts = OWN,
        calibrate: bool = False,
    ) -> None:
        """Build the cell. If `start` contains a state of the run, restore this state. If not, restore the state that
        an earlier run stored after it calibrated the camera. If no earlier run stored such a state, calibrate the
        camera.

        Args:
            halt: the panic button, polled in every servo period; Halted is raised if it is pressed during
                calibration.
            viewed: called for each view of a camera calibration, with the number of the view and the total
                number of views.
            observers: called after the cell is built and before the run begins; returns the observers.
            calibrate: calibrate the camera even if an earlier run stored its calibration.
        """
        parts.check(start.setup.replaced)
        self.setup = start.setup
        self.listing = listing_of(start.setup)  # stages and steps of the program
        self.vision = Stopwatch(time.process_time)  # processor time of vision here, undone steps included
        self.kind = system_of(start.setup)  # the system that executes the run, as a value
        self.system: RunningSystem = self.kind.build(
            start.setup,
            RunCallbacks(
                emit=self._emit,
                watch=self._watch,
                halt=halt,
                viewed=viewed,
                vision=self.vision,
                parts=parts,
                calibrate=calibrate,
            ),
        )
        self.events: list[AnyEvent] = []  # events that were not undone
        self.position = 0  # steps done
        self.history: list[Snapshot] = []  # states to go back to, the present one last
        self.started = 0.0  # reading of the clock when this object began to simulate
        self.first = 0  # steps done before this object began
        self.observers: list[Observer] = []
        self._broken: str | None = None
        self._within_step = False
        begun = () if start.snapshot is not None else self.system.begin()
        if begun and begun[0].time:
            raise BadArgument(
                f"the system {self.kind.name} begins a run at {begun[0].time:g} s; a run must begin at 0 s"
            )
        self.started = self.system.switched_on
        if start.snapshot is not None:
            self.events += start.events
            self._put(start.snapshot)
            self.history.append(start.snapshot)
            self.started, self.first = self.time, self.position
        self.observers += observers(self)
        for event in begun:
            self._emit(event)
        if begun:
            self._settle()

    # -- knowing --------------------------------------------------------------------------------------

    @property
    def time(self) -> float:
        """The clock of the run (s), which is 0 when its program begins."""
        return self.system.time

    @property
    def trouble(self) -> str | None:
        """The reason why the run cannot continue even if the operator answers; None if the run can continue."""
        return self._broken or self.system.trouble

    @property
    def task(self) -> AnyTask:
        """The task of the run."""
        return any_task(self.setup.task)

    def require(self, capability: Capability) -> None:
        """Raise InvalidInput unless the run's system has a capability. The message names the system."""
        require(self.setup.system, capability)

    @property
    def context(self) -> ExecutionContext:
        """The context in which a plan of motions is executed. Raises InvalidInput if the run's system does not
        execute such plans.
        """
        if self.system.context is None:
            raise refusal(self.setup.system, "plans")
        return self.system.context

    @property
    def arm_cell(self) -> SimulatedCell:
        """The cell in which a plan of motions is executed. Raises InvalidInput if the run's system does not
        execute such plans.
        """
        if self.system.arm_cell is None:
            raise refusal(self.setup.system, "plans")
        return self.system.arm_cell

    @property
    def cell(self) -> SnapshotCell:
        """The simulated cell. Raises Refused if the run's system has no work cell."""
        if self.system.cell is None:
            raise Refused(f"the system {self.setup.system} has no work cell")
        return self.system.cell

    @property
    def ended(self) -> bool:
        """True if a further step is possible only after the operator has said how to continue."""
        return self.at is None or self.trouble is not None

    @property
    def call(self) -> OperatorCalled | None:
        """The operator call that has not been answered yet, or None."""
        return self.system.state.stopped

    @property
    def at(self) -> int | None:
        """Number of the next step, or None if the run cannot continue without the operator."""
        return self.system.state.at

    @property
    def places(self) -> tuple[TaskPlace, ...]:
        """For each unfinished task, its place in the program. The property `at` gives the next step of the task that
        runs next.
        """
        return self.system.state.places

    @property
    def next(self) -> StepFacts | None:
        return None if self.at is None else self.listing.steps[self.at]

    @property
    def onward(self) -> int | None:
        """The number of the step that would have run next if the program had not stopped to call the operator. The
        value is None if the program has not stopped.
        """
        return self.system.state.onward

    @property
    def stage(self) -> int | None:
        """Index of the present stage, or None between two stages."""
        return self.system.state.stage

    @property
    def between_stages(self) -> bool:
        """True if no stage is in progress and a further stage follows."""
        return self.stage is None and self.at is not None

    @property
    def undone(self) -> bool:
        """True if the run has ended because the arm has undone all the steps that it was asked to undo."""
        last = next((e for e in reversed(self.events) if isinstance(e, StepStarted | UndoEnded)), None)
        return self.at is None and isinstance(last, UndoEnded)

    @property
    def touched(self) -> bool:
        """True if a person intervened with an experiment, a typed line, an answer of the operator, or an order
        to undo."""
        return interfered(self.events)

    def checkpoint(self, snapshot: Snapshot | None = None) -> Checkpoint:
        """Make a checkpoint of the present state, or of an earlier one."""
        kept = snapshot or self.history[-1]
        return Checkpoint(
            setup=self.setup,
            snapshot=kept,
            events=tuple(self.events[: kept.happened]),
        )

    # -- running --------------------------------------------------------------------------------------

    def step(self) -> None:
        """Execute the next step. Raises Halted if the panic button is pressed. After this exception, call `rollback`
        to revert the incomplete step.
        """
        assert not self.ended
        self._within_step = True
        try:
            self.system.step()
        except Halted:
            self._emit(PanicStopped(time=self.time))
            raise
        except PhysicsFailed as error:
            self.rollback()  # the state within the step is meaningless
            self.system.halt()
            self._broken = str(error)
            return
        except Deadlock as error:
            self._broken = str(error)
            return
        finally:
            self._within_step = False
        self.position += 1
        self._settle()

    def answer(self, choice: Choice) -> None:
        """Continue after a call to the operator."""
        self.system.answer(choice)
        self._settle()

    def order_reversal(self, left: int, *, halts: bool = False, asked_by: AskedBy = "person") -> None:
        """Order the arm to undo executed steps until only `left` of them remain. Each following step of the run undoes
        one executed step. If `halts` is True, the run ends when these steps have been undone.
        """
        self.require("undo")
        self.system.reverse(ReversalOrder(left=left, halts=halts, asked_by=asked_by))
        self._settle()

    def finish(self) -> bool:
        """End the run. Returns True if the program was completed."""
        return self.system.finish() and self.trouble is None

    def repeat(self, events: Sequence[AnyEvent]) -> None:
        """Continue until the run has `len(events)` events. On the way, repeat the operator's actions that `events`
        contains.
        """
        while len(self.events) < len(events):
            then = events[len(self.events)]
            if isinstance(then, OperatorAnswered) and (self.call is not None or self.undone):
                self.answer(then.choice)
            elif isinstance(then, UndoOrdered):
                self.order_reversal(then.left, halts=then.halts, asked_by=then.asked_by)
            elif isinstance(then, LineTyped):
                self.type_line(then.text, then.task)
            elif isinstance(then, ExperimentMade):
                self.experiment(then.what, then.name, then.value)
            elif isinstance(then, PeriodsCommanded):
                self.control(then.by, repeated(then.periods), len(then.periods))
            elif self.ended:
                self.finish()
                return
            else:
                self.system.foresee(_typed_within_step(events[len(self.events) :]))
                self.step()

    # -- going back -----------------------------------------------------------------------------------

    def rollback(self) -> None:
        """Put the simulation back into its state at the end of the last complete step."""
        self._return_to(self.history[-1])

    def back_to(self, position: int, kept: Callable[[int], Checkpoint | None] = lambda _: None) -> None:
        """Put the run back into the state in which `position` steps were done. To do this, restore the nearest earlier
        state, and execute the remaining steps from there.

        The function `kept` is needed for states that are no longer in memory. Its argument is a number of steps. It
        returns the newest checkpoint on disk that was made after at most this number of steps.
        """
        if not 0 <= position <= self.position:
            raise BadArgument(f"cannot go back to the state after {counted(position, 'step')}")
        near = self._nearest(position, kept)
        again = self.events[: self._happened(position)]
        while self.history and self.history[-1].position > near.position:
            self.history.pop()
        if not self.history or self.history[-1].position < near.position:
            self.history.append(near)
        self._return_to(self.history[-1])
        self.repeat(again)

    def _nearest(self, position: int, kept: Callable[[int], Checkpoint | None]) -> Snapshot:
        """Return the state, in memory or on disk, from which the fewest steps lead to a position."""
        near = next((here for here in reversed(self.history) if here.position <= position), None)
        if near is None or near.position < position:
            checkpoint = kept(position)
            snapshot = None if checkpoint is None else checkpoint.snapshot
            if snapshot is not None and (near is None or snapshot.position > near.position):
                near = snapshot
        if near is None:
            raise Refused(reach(self.history[0].position))
        return near

    def _happened(self, position: int) -> int:
        """Return how many events happened before the step that begins at a position (number of steps done)."""
        done = 0
        for number, event in enumerate(self.events):
            if done == position and isinstance(event, StageStarted | StepStarted):
                return number
            done += isinstance(event, StepFinished)
        return len(self.events)

    def _return_to(self, snapshot: Snapshot) -> None:
        self._put(snapshot)
        for observer in self.observers:
            observer.undone(len(self.events))

    # -- experiments ----------------------------------------------------------------------------------

    def experiment(self, what: str, name: str, value: tuple[float, ...]) -> None:
        """Set a value in the system's memory, in SI units."""
        self.system.set_value(what, name, value)
        self._emit(ExperimentMade(time=self.time, what=what, name=name, value=value))
        self._settle()

    def control(self, by: str, controller: Controller, most: int) -> int:
        """Let a controller command the arm. `by` is the name of the controller, and `most` is the greatest number of
        servo periods. Returns the number of periods that the controller commanded. After an exception, `rollback`
        reverts these periods.

        Raises:
            InvalidInput: the run's system does not execute plans of motions.
            PhysicsFailed, Halted: the simulation broke down, or the panic button was pressed.
        """
        periods = controlled(self.context, controller, most)
        self._emit(PeriodsCommanded(time=self.time, by=by, periods=periods))
        self._settle()
        return len(periods)

    def type_line(self, text: str, task: str = "") -> None:
        """Type a line at the system's console, for one of the system's tasks. If the line is typed while a step is in
        progress, the system executes the line in the middle of the step, or refuses it.
        """
        self.require("console")
        if self._within_step:
            self.system.interject(text, task)
            return
        self.system.type_line(text, task)
        self._settle()

    # -- inside ---------------------------------------------------------------------------------------

    def _settle(self) -> None:
        """Capture the cell's state, restore it, and add it to the history. If the state equals the last state of the
        history, for example after a statement that takes no time, the state is not restored.
        """
        cell = self.system.cell
        captured = None if cell is None else cell.capture()
        if cell is not None and captured is not None:
            last = self.history[-1].cell if self.history else None
            if last is not None and captured.equals(last):
                captured = last
            else:
                cell.restore(captured)
        self.history.append(
            Snapshot(
                position=self.position,
                happened=len(self.events),
                cell=captured,
                state=copied(self.system.state),
            )
        )
        if len(self.history) > RECENT:
            self._thin()

    def _thin(self) -> None:
        """Drop a state from the history: the oldest one at which no stage begins."""
        for index in range(1, len(self.history) - RECENT):
            before, here = self.history[index - 1 : index + 1]
            interfered = before.position == here.position  # a person changed the state between two steps
            if here.state.stage is not None and not interfered:
                del self.history[index]
                return

    def _put(self, snapshot: Snapshot) -> None:
        cell = self.system.cell
        if (cell is None) != (snapshot.cell is None):
            raise BadFile(
                "the state belongs to a run of a different kind: either the state or this run has a work cell, but "
                "not both"
            )
        if cell is not None and snapshot.cell is not None:
            cell.restore(snapshot.cell)
        self.system.restore(snapshot.state)
        self.position, self._broken = snapshot.position, None
        del self.events[snapshot.happened :]

    def _emit(self, event: AnyEvent) -> None:
        self.events.append(event)
        for observer in self.observers:
            observer.event(event)

    def _watch(self, period: ServoPeriod) -> None:
        for observer in self.observers:
            observer.tick(period)
