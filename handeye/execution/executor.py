"""The executor: executes the steps of a plan one by one. After a step that tests for an error, the executor continues
with the step that the test selects.
"""

from dataclasses import dataclass
from typing import Final, Literal

import numpy as np
from msgspec.structs import replace

from handeye.arm.kinematics import forward
from handeye.core import errors
from handeye.core.errors import Refused
from handeye.execution.context import Action, ExecutionContext
from handeye.execution.flow_actions import DECISIONS, FLOW_ACTIONS
from handeye.execution.hand_actions import HAND_ACTIONS
from handeye.execution.motion_actions import MOTION_ACTIONS
from handeye.execution.state import ExecutionState, Fault, ReversalOrder, vector
from handeye.execution.undo.memory import before, noted
from handeye.execution.undo.undoing import end, order, undo_last
from handeye.execution.vision_actions import VISION_ACTIONS
from handeye.ports.workcell import Workcell
from handeye.program.diagnosis.causes import Cause, Looping
from handeye.program.events import (
    Choice,
    ErrorRaised,
    OperatorAnswered,
    OperatorCalled,
    RunFinished,
    StageFinished,
    StageStarted,
    StepFinished,
    StepStarted,
    UndoOrdered,
)
from handeye.program.operation import Device, Operation
from handeye.program.program import Program, Step

_CALLED: Final[dict[Device, str]] = {"camera": "television camera"}  # names of devices in messages


def check_devices(program: Program, cell: Workcell) -> None:
    """Raise Refused if a step needs a device that the cell does not have."""
    devices = {"hand": cell.hand, "screwdriver": cell.screwdriver, "camera": cell.camera}
    for step in program.steps:
        needed = step.needs
        if needed is not None and devices[needed] is None:
            called = _CALLED.get(needed, needed)
            raise Refused(f"line {step.place} needs a {called}, which this cell does not have")


IDLE_LIMIT: Final = 10_000  # steps without time passing after which the program counts as looping

ACTIONS: Final[dict[type[Operation], Action]] = MOTION_ACTIONS | HAND_ACTIONS | VISION_ACTIONS | FLOW_ACTIONS


@dataclass(slots=True, kw_only=True)
class Executor:
    """Executes a plan in a cell, one step at a time."""

    run: ExecutionContext

    @property
    def state(self) -> ExecutionState:
        """The state of the run, shared with the actions."""
        return self.run.state

    def step(self) -> None:
        """Execute one step, or reverse one. If a step raises an error and the next step does not test for this error,
        call the operator.
        """
        if self.state.undoing is not None:
            stopped = undo_last(self.run)
            if stopped is not None:
                self._stop(error=stopped.error, cause=stopped.cause)
            return
        run, here = self.run, self.state.at
        assert here is not None
        step = run.plan.program.steps[here]
        enters = self.state.stage is None
        self.state.held = None
        if self.state.stage is None:
            self.state.stage = step.stage
            run.emit(StageStarted(time=run.time, stage=run.plan.program.stages[step.stage]))
        found = before(run)
        run.emit(StepStarted(time=run.time, step=here, file=step.file, line=step.line, text=step.text))
        self.state.at = self._past(self._perform(step))
        self.state.done.append(noted(run, found, step=here, enters=enters))
        motion, planned = run.plan.motions.get(here), None
        if motion is not None:
            planned = vector(forward(run.arm, np.array(motion.knots[-1]))[:3, 3])
        hand, gap = vector(run.drive.hand()[:3, 3]), round(run.drive.sensed.gap, 6)
        run.emit(StepFinished(time=run.time, step=here, hand=hand, planned=planned, gap=gap))
        if step.operation.calls is not None:
            self._stop(message=step.operation.calls)
        elif self.state.unwound.get(here, 0) < step.operation.undoes:
            self.state.unwound[here] = self.state.unwound.get(here, 0) + 1
            done = self.state.done
            begins = (index for index in reversed(range(len(done))) if done[index].enters)
            began = next(begins, 0)  # 0 if the calling program has moved the arm in this stage
            self.undo(ReversalOrder(left=began, asked_by="program"))
        elif self.state.pending is not None and not self._tests(self.state.at):
            self._stop(error=self.state.pending.number, cause=self.state.pending.cause)
        else:
            self._watch_for_circles()
        if self.state.stopped is not None:
            self.state.done[-1] = replace(self.state.done[-1], called=True)
        elif self.state.at is None and self.state.undoing is None:
            run.drive.stop()  # the program has ended; under its drives, the arm would still sway
        self._leave()

    def answer(self, choice: Choice) -> None:
        """Carry out what the operator chose after the program called the operator, or after a reversal. If a reversal
        has stopped with an error, `proceed` continues this reversal, and any other choice ends it.
        """
        run, stage = self.run, self.state.stage
        assert stage is not None or choice == "proceed"
        going_on = {"proceed": self.state.onward}
        if stage is not None:
            going_on |= {"retry": self._past(self._first(stage)), "skip": self._past(self._first(stage + 1))}
        self.state.at, self.state.idle = going_on[choice], 0
        self.state.stopped = self.state.onward = None
        if choice != "proceed":
            end(self.state)
            self.state.unwound.clear()
        run.emit(OperatorAnswered(time=run.time, choice=choice, step=self.state.at))
        self._leave("skipped" if choice == "skip" else "done")

    def undo(self, undoing: ReversalOrder) -> None:
        """Order the arm to reverse executed steps, beginning with the last one, until `undoing.left` steps remain.
        Raises Refused if there are no steps to reverse.
        """
        if undoing.asked_by == "person":
            self.state.unwound.clear()
        order(self.state, undoing)
        left, halts, asked_by = undoing.left, undoing.halts, undoing.asked_by
        self.run.emit(UndoOrdered(time=self.run.time, left=left, halts=halts, asked_by=asked_by))

    def finish(self) -> bool:
        """End the run. Returns True if the program has been completed."""
        run = self.run
        if self.state.stage is not None:
            stage = run.plan.program.stages[self.state.stage]
            run.emit(StageFinished(time=run.time, stage=stage, status="stopped"))
        completed = self.state.at is None and self.state.stopped is None
        run.emit(RunFinished(time=run.time, completed=completed))
        return completed

    def _perform(self, step: Step) -> int | None:
        """Execute the operation of a step. Returns the number of the next step, or None if the program has ended."""
        operation = step.operation
        if operation.branch is not None:
            taken = DECISIONS[type(operation)](self.run, operation)
            return operation.branch.target if taken else step.next
        if operation.raising and not operation.only_checks:
            self.state.finger_line = None
        fault = ACTIONS[type(operation)](self.run, operation)
        if not operation.raising:
            return step.next
        if self.state.drive.cut:  # whatever the action returned
            fault = Fault(number=errors.WATCHDOG)
        elif self.state.drive.leapt is not None:
            fault = Fault(number=errors.GAP_WRONG, cause=self.state.drive.leapt)
        self.state.drive.leapt = None
        self.state.pending = fault
        if fault is not None:
            self.run.emit(ErrorRaised(time=self.run.time, number=fault.number, cause=fault.cause))
        return step.next

    def _past(self, number: int | None) -> int | None:
        """Return `number`. If the run leaves out a macro, and the step with this number belongs to a call of the
        macro, return the number of the first step after the call.
        """
        steps = self.run.plan.program.steps
        while number is not None and steps[number].called in self.run.without:
            number = number + 1 if number + 1 < len(steps) else None
        return number

    def _tests(self, number: int | None) -> bool:
        """Return True if a step tests for an error."""
        branch = None if number is None else self.run.plan.program.steps[number].operation.branch
        return branch is not None and branch.error is not None

    def _first(self, stage: int) -> int | None:
        """Return the first step of a stage. If the stage has no steps, return the first step of the next stage that
        has steps, or None if there is no such stage.
        """
        steps = self.run.plan.program.steps
        return next((number for number, step in enumerate(steps) if step.stage >= stage), None)

    def _leave(self, status: Literal["done", "skipped"] = "done") -> None:
        """Report the end of a stage when the program leaves the stage, or when the program ends."""
        run = self.run
        program = run.plan.program
        if self.state.stage is None or self.state.stopped is not None:
            return
        if self.state.at is None or program.steps[self.state.at].stage != self.state.stage:
            run.emit(StageFinished(time=run.time, stage=program.stages[self.state.stage], status=status))
            self.state.stage = None
            self.state.unwound.clear()

    def _stop(self, *, message: str = "", error: int | None = None, cause: Cause | None = None) -> None:
        """Set the brakes and call the operator."""
        run = self.run
        run.drive.state.tool = 0.0
        run.drive.stop()
        self.state.stopped = OperatorCalled(time=run.time, message=message, error=error, cause=cause)
        run.emit(self.state.stopped)
        self.state.at, self.state.onward = None, self.state.at
        self.state.pending = None

    def _watch_for_circles(self) -> None:
        run = self.run
        self.state.idle = 0 if run.time > self.state.clock else self.state.idle + 1
        self.state.clock = run.time
        if self.state.idle > IDLE_LIMIT and self.state.at is not None:
            self._stop(cause=Looping(place=run.plan.program.steps[self.state.at].place))
