"""A run that can be stepped, stopped and put back.

Between two steps the cell is put into its own state, which changes nothing but what a state leaves out (see
`SimulatedCell.restore`). So every run, stopped or not, goes the same way to the byte.
"""

import time
from collections.abc import Callable, Sequence
from typing import Final, Literal

import numpy as np

from handeye.cell.simulated import SimulationError
from handeye.errors import InvalidInput
from handeye.events import (
    AnyEvent,
    Choice,
    ExperimentMade,
    OperatorAnswered,
    OperatorCalled,
    PanicStopped,
    RunStarted,
    StageStarted,
    StepFinished,
    StepStarted,
)
from handeye.execution.camera_calibration import CalibrationFailed, calibrate_camera
from handeye.execution.context import ExecutionContext
from handeye.execution.devices import check_devices
from handeye.execution.executor import Executor
from handeye.execution.servo_loop import Halted
from handeye.execution.stopwatch import Stopwatch
from handeye.planfile.store import plan_digest
from handeye.ports.workcell import Sensed
from handeye.pose import Array
from handeye.program.program import Position, Step
from handeye.record import Vector3
from handeye.records import copied
from handeye.runs.observer import Observer
from handeye.runs.snapshot import Checkpoint, Snapshot, interfered
from handeye.tasks import task
from handeye.versions import versions
from handeye.vision.calibration import Calibration
from handeye.vision.camera import CameraModel

Taught = tuple[float, float, float, float, float, float]

RECENT: Final = 400
"""Steps whose states are kept in memory; of older ones those at the beginning of stages."""


def reach(first: int) -> str:
    """How far one can go back where the earliest state has `first` steps done, as a sentence."""
    return f"this run begins with {first} step{'' if first == 1 else 's'} done: there is nothing before that"


class Runner:
    """A run of a plan in a drawn world, from its beginning or from a checkpoint."""

    def __init__(
        self,
        start: Checkpoint,
        *,
        halt: Callable[[], bool] = lambda: False,
        observers: Callable[["Runner"], Sequence[Observer]] = lambda _: (),
    ) -> None:
        """Build the cell; calibrate its camera, or put it into the state of the checkpoint.

        Args:
            halt: the panic button, asked at every servo period.
            observers: makes those who look on, once the cell is built and before anything happens in it.

        Raises:
            InvalidInput: there is no such task, the plan is for another arm or needs devices that the cell does not
                have, the camera cannot work as asked, or the checkpoint does not fit this scene.
            Halted: the panic button was hit during calibration.
        """
        self.setup = start.setup
        plan = start.setup.plan
        self.task = task(start.setup.task)
        self.task.check_arm(plan)
        self.arm = self.task.arm
        self.cell = self.task.cell(start.setup.world, start.setup.camera)
        check_devices(plan.program, self.cell.devices)
        self._unable: str | None = None
        self.calibration = start.calibration
        if start.snapshot is None:
            self.calibration = self._calibrated(halt)
        elif self.calibration is None and self._looks:
            self._unable = "the camera could not be calibrated when the run was begun"
        self.trouble: str | None = self._unable
        """Why the run cannot go on, if it is not a matter for the operator."""
        self.vision = Stopwatch(time.process_time)
        """Processor time that vision has taken in all."""
        self.run = ExecutionContext(
            plan=plan,
            arm=self.arm,
            cell=self.cell.devices,
            camera=self._camera_model(),
            emit=self._emit,
            vision=self.vision,
        )
        if self.calibration is not None and self.task.eye is not None:
            self.run.state.lens = self.task.eye.looks[-1].lens
        self.run.drive.halt, self.run.drive.watch = halt, self._watch
        self.executor = Executor(run=self.run)
        self.events: list[AnyEvent] = []
        """Everything that has happened and was not undone."""
        self.position = 0
        """Steps done."""
        self.history: list[Snapshot] = []
        """States to go back to, the present one last."""
        self.started = 0.0
        """The cell's clock when this object took the run up, or the camera's calibration began."""
        self.observers: list[Observer] = []
        if start.snapshot is not None:
            self.events += start.events
            self._put(start.snapshot)
            self.history.append(start.snapshot)
            self.started = self.run.time
        self.observers += observers(self)
        if start.snapshot is None:
            self._begin()

    # -- knowing --------------------------------------------------------------------------------------

    @property
    def ended(self) -> bool:
        """No step can be done, unless the operator says how to go on."""
        return self.at is None or self.trouble is not None

    @property
    def call(self) -> OperatorCalled | None:
        """The call of the operator that has not been answered."""
        return self.executor.state.stopped

    @property
    def at(self) -> int | None:
        """The number of the step to be done next; None if the run cannot go on by itself."""
        return self.executor.state.at

    @property
    def next(self) -> Step | None:
        """The step to be done next."""
        return None if self.at is None else self.setup.plan.program.steps[self.at]

    @property
    def onward(self) -> int | None:
        """After a call of the operator: the number of the step that would have been next."""
        return self.executor.state.onward

    @property
    def stages(self) -> tuple[str, ...]:
        """The names of the stages."""
        return self.setup.plan.program.stages

    @property
    def stage(self) -> int | None:
        """The index of the stage under way; None between two stages."""
        return self.executor.state.stage

    @property
    def between_stages(self) -> bool:
        """No stage is under way, and one is to come."""
        return self.stage is None and self.at is not None

    @property
    def touched(self) -> bool:
        """Somebody has interfered: an experiment, or an answer of the operator."""
        return interfered(self.events)

    def checkpoint(self, snapshot: Snapshot | None = None) -> Checkpoint:
        """The present state, or an earlier one, as a checkpoint."""
        kept = snapshot or self.history[-1]
        return Checkpoint(
            setup=self.setup,
            calibration=self.calibration,
            snapshot=kept,
            events=tuple(self.events[: kept.happened]),
        )

    # -- going on -------------------------------------------------------------------------------------

    def step(self) -> None:
        """Do the next step.

        Raises:
            Halted: the panic button was hit; the step is not done, and `undo` takes back what it has done.
        """
        assert not self.ended
        try:
            self.executor.step()
        except Halted:
            self._emit(PanicStopped(time=self.run.time))
            raise
        except SimulationError as error:
            self.trouble = str(error)
            return
        self.position += 1
        self._settle()

    def answer(self, choice: Choice) -> None:
        """Go on after the operator was called."""
        self.executor.answer(choice)
        self._settle()

    def finish(self) -> bool:
        """Close the account of the run; True when the program came to its end."""
        return self.executor.finish() and self.trouble is None

    def repeat(self, events: Sequence[AnyEvent]) -> None:
        """Go on until as many events as these have happened, doing what people did in them.

        Raises:
            InvalidInput: they tell of an experiment that nobody can have made.
        """
        while len(self.events) < len(events):
            then = events[len(self.events)]
            if isinstance(then, OperatorAnswered) and self.call is not None:
                self.answer(then.choice)
            elif isinstance(then, ExperimentMade):
                self._try_again(then)
            elif self.ended:
                self.finish()
                return
            else:
                self.step()

    # -- going back -----------------------------------------------------------------------------------

    def undo(self) -> None:
        """Be again where the last step ended, whatever a step that was broken off has done."""
        self._return_to(self.history[-1])

    def back_to(self, position: int, kept: Callable[[int], Checkpoint | None] = lambda _: None) -> None:
        """Be again where `position` steps were done: from the nearest state there is, and forward from there.

        Args:
            kept: the newest checkpoint on disk at a position or before it, for what is no longer in memory.

        Raises:
            InvalidInput: no such position, or no state at it or before it is left.
        """
        if not 0 <= position <= self.position:
            raise InvalidInput(f"{position} steps done is nowhere to go back to")
        near = self._nearest(position, kept)
        again = self.events[: self._happened(position)]
        while self.history and self.history[-1].position > near.position:
            self.history.pop()
        if not self.history or self.history[-1].position < near.position:
            self.history.append(near)
        self._return_to(self.history[-1])
        self.repeat(again)

    def _nearest(self, position: int, kept: Callable[[int], Checkpoint | None]) -> Snapshot:
        """The state from which the fewest steps lead to a position: in memory or, if nearer, on disk."""
        near = next((here for here in reversed(self.history) if here.position <= position), None)
        if near is None or near.position < position:
            checkpoint = kept(position)
            snapshot = None if checkpoint is None else checkpoint.snapshot
            if snapshot is not None and (near is None or snapshot.position > near.position):
                near = snapshot
        if near is None:
            raise InvalidInput(reach(self.history[0].position))
        return near

    def _happened(self, position: int) -> int:
        """How many events had happened when the step behind a position was about to begin."""
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

    def set_saved(self, name: str, difference: Vector3) -> None:
        """Give a saved difference (m) a value of one's own."""
        self.run.state.saved[name] = np.array(difference)
        self._experiment("saved", name, difference)

    def set_position(self, name: str, at: Taught) -> None:
        """Teach a position anew: x, y, z (m) and O, A, T (rad), in the frame it was taught in.

        Raises:
            InvalidInput: there is no such position.
        """
        known = self.setup.plan.program.positions
        if name not in known:
            raise InvalidInput(f"no position {name}; there are {', '.join(known)}")
        self.run.state.world.moved[name] = Position(at=at, of=known[name].of)
        self._experiment("position", name, at)

    def _try_again(self, made: ExperimentMade) -> None:
        if made.what == "saved" and len(made.value) == 3:
            x, y, z = made.value
            self.set_saved(made.name, (x, y, z))
        elif made.what == "position" and len(made.value) == 6:
            x, y, z, o, a, t = made.value
            self.set_position(made.name, (x, y, z, o, a, t))
        else:
            raise InvalidInput(f"{made.what} {made.name} cannot be set to {len(made.value)} numbers")

    def _experiment(self, what: Literal["saved", "position"], name: str, value: tuple[float, ...]) -> None:
        self._emit(ExperimentMade(time=self.run.time, what=what, name=name, value=value))
        self._settle()

    # -- inside ---------------------------------------------------------------------------------------

    def _begin(self) -> None:
        plan = self.setup.plan
        self._emit(
            RunStarted(
                time=self.run.time,
                program=plan.program.name,
                steps=len(plan.program.steps),
                plan=plan_digest(plan),
                arm=plan.arm,
                arm_digest=plan.arm_digest,
                world=self.setup.world,
                task=self.setup.task,
                camera=self.cell.renderer,
                versions=versions(),
            )
        )
        self._settle()

    @property
    def _looks(self) -> bool:
        """The plan takes pictures."""
        return bool(self.setup.plan.program.written("picture"))

    def _calibrated(self, halt: Callable[[], bool]) -> Calibration | None:
        """The calibration of the camera, if the plan looks at all and it can be had."""
        eye = self.task.eye
        if eye is None or not self._looks:
            return None
        try:
            return calibrate_camera(self.cell.devices, self.arm, eye.drawing, eye.looks, halt)
        except (CalibrationFailed, SimulationError) as error:
            self._unable = str(error)
            return None

    def _camera_model(self) -> CameraModel | None:
        """The camera as well as it is known; None if the task has none."""
        if self.calibration is not None:
            return self.calibration.model
        return None if self.task.eye is None else self.task.eye.drawing

    def _settle(self) -> None:
        """Put the cell into its own state, and keep that."""
        state = self.cell.capture()
        self.cell.restore(state)
        self.history.append(
            Snapshot(
                position=self.position,
                happened=len(self.events),
                cell=state,
                state=copied(self.run.state),
                vision_s=self.vision.seconds,
            )
        )
        if len(self.history) > RECENT:
            self._thin()

    def _thin(self) -> None:
        """Forget the oldest state that does not begin a stage."""
        for index in range(1, len(self.history) - RECENT):
            before, here = self.history[index - 1 : index + 1]
            interfered = before.position == here.position  # no step led from one to the other
            if here.state.stage is not None and not interfered:
                del self.history[index]
                return

    def _put(self, snapshot: Snapshot) -> None:
        self.cell.restore(snapshot.cell)
        self.run.restore(snapshot.state)
        self.vision.seconds = snapshot.vision_s
        self.position, self.trouble = snapshot.position, self._unable
        del self.events[snapshot.happened :]

    def _emit(self, event: AnyEvent) -> None:
        self.events.append(event)
        for observer in self.observers:
            observer.event(event)

    def _watch(self, sensed: Sensed, effort: Array) -> None:
        for observer in self.observers:
            observer.tick(sensed, effort)
