"""The executor: follows the graph of a plan, step by step, and lets the program test what went wrong."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final, Literal

import numpy as np

from handeye import errors
from handeye.arm.kinematics import forward
from handeye.events import (
    ErrorRaised,
    ErrorTested,
    HandTold,
    OperatorAnswered,
    OperatorCalled,
    PositionDefined,
    RunFinished,
    Saved,
    SearchAdvanced,
    StageFinished,
    StageStarted,
    StepFinished,
    StepStarted,
)
from handeye.execution import motion_actions as acting
from handeye.execution import vision_actions as looking
from handeye.execution.state import ExecutionState, Fault, SearchState, vector
from handeye.program import program as op
from handeye.program.world_model import place

IDLE_LIMIT: Final = 10_000
"""Steps without time passing after which a program is taken to run in a circle."""

Choice = Literal["proceed", "retry", "skip"]
"""What an operator can do about a stop: go on behind it, do the stage again, or leave out the rest of the stage."""

_ACTIONS: Final[dict[type, Callable[[ExecutionState, Any], Fault | None]]] = {
    op.Change: acting.change,
    op.Turn: acting.turn,
    op.Open: acting.open_hand,
    op.Close: acting.close,
    op.Center: acting.center,
    op.Travel: acting.travel,
    op.Lens: looking.lens,
    op.Aim: looking.aim,
    op.Look: looking.look,
    op.General: looking.general,
    op.Specific: looking.specific,
    op.Inspect: looking.inspect,
}


@dataclass(slots=True, kw_only=True)
class Executor:
    """Carries out a plan on a cell, a step at a time."""

    state: ExecutionState
    at: int | None = 0
    """The step to do next; None when the program has ended or the operator was called."""
    pending: Fault | None = None
    """An error raised, which the next step tests."""
    stage: int | None = None
    """The stage under way; None between two stages."""
    stopped: OperatorCalled | None = None
    onward: int | None = None
    """After a stop: the step that would have been next."""
    idle: int = 0
    """Steps since time last passed."""
    clock: float = -1.0
    """When the last step ended, s."""

    @property
    def between_stages(self) -> bool:
        """No stage is under way, and one is to come."""
        return self.stage is None and self.at is not None

    def step(self) -> None:
        """Do one step; the operator is called if it raises an error that the next one does not test."""
        assert self.at is not None
        run, here = self.state, self.at
        step = run.plan.program.steps[here]
        self._enter(step.stage)
        run.emit(StepStarted(time=run.time, step=here, file=step.file, line=step.line, text=step.text))
        self.at = self._perform(here, step)
        run.emit(self._finished(here))
        if isinstance(step.operation, op.Wait):
            self._stop(step.operation.message, None)
        elif self.pending is not None and not self._tests(self.at):
            self._call_operator(self.pending)
        else:
            self._watch_for_circles()
        self._leave()

    def answer(self, choice: Choice) -> None:
        """Go on after the operator was called."""
        assert self.stopped is not None
        assert self.stage is not None
        run, stage = self.state, self.stage
        going_on = {"proceed": self.onward, "retry": self._first(stage), "skip": self._first(stage + 1)}
        self.at, self.stopped, self.onward, self.idle = going_on[choice], None, None, 0
        run.emit(OperatorAnswered(time=run.time, choice=choice, step=self.at))
        self._leave("skipped" if choice == "skip" else "done")

    def finish(self) -> bool:
        """Close the account of the run; True when the program came to its end."""
        run = self.state
        if self.stage is not None:
            stage = run.plan.program.stages[self.stage]
            run.emit(StageFinished(time=run.time, stage=stage, status="stopped"))
        completed = self.at is None and self.stopped is None
        run.emit(RunFinished(time=run.time, completed=completed))
        return completed

    def _perform(self, number: int, step: op.Step) -> int | None:
        """Do the operation; the number of the step that follows."""
        run = self.state
        operation = step.operation
        if isinstance(operation, op.Test):
            return self._test(operation, step)
        if isinstance(operation, op.Save):
            self._save(operation)
            return step.next
        if isinstance(operation, op.Assign):
            run.counters[operation.counter] = operation.value
            return step.next
        if isinstance(operation, op.Countdown):
            left = run.counters[operation.counter] = run.counters.get(operation.counter, 0) - 1
            return operation.positive if left > 0 else step.next
        if isinstance(operation, op.ACTIONS) and not isinstance(operation, op.Travel):
            run.finger_line = None
        if isinstance(operation, op.Move):
            self._raise(acting.move(run, number, operation))
        elif isinstance(operation, op.Advance):
            self._raise(self._advance())
        elif isinstance(operation, op.Search):
            run.search = SearchState(step=operation.step, limit=operation.limit)
        elif isinstance(operation, op.Load):
            run.drive.load = operation.weight
        elif isinstance(operation, op.Tool):
            run.drive.tool = operation.speed
        elif isinstance(operation, op.Here):
            self._define(operation.position)
        elif isinstance(operation, op.Where):
            run.emit(HandTold(time=run.time, at=place(run.drive.hand())))
        elif not isinstance(operation, op.Jump | op.Wait):
            self._raise(_ACTIONS[type(operation)](run, operation))
        return step.next

    def _raise(self, fault: Fault | None) -> None:
        if self.state.drive.cut:  # whatever the action made of it
            fault = Fault(number=errors.WATCHDOG)
        self.pending = fault
        if fault is not None:
            self.state.emit(ErrorRaised(time=self.state.time, number=fault.number, detail=fault.detail))

    def _test(self, operation: op.Test, step: op.Step) -> int | None:
        occurred = self.pending is not None and self.pending.number == operation.number
        self.state.emit(ErrorTested(time=self.state.time, number=operation.number, occurred=occurred))
        if occurred:
            self.pending = None
            return operation.raised
        return step.next

    def _tests(self, number: int | None) -> bool:
        """Whether a step tests for an error."""
        return number is not None and isinstance(self.state.plan.program.steps[number].operation, op.Test)

    def _advance(self) -> Fault | None:
        run = self.state
        if run.search is None or run.search.count + 1 >= run.search.limit:
            tried = "no search was set up" if run.search is None else f"{run.search.limit} places tried"
            return Fault(number=errors.SEARCH_EXHAUSTED, detail=tried)
        run.search.count += 1
        x, y = run.search.offset()
        run.emit(SearchAdvanced(time=run.time, count=run.search.count, offset=(round(x, 6), round(y, 6))))
        return None

    def _save(self, operation: op.Save) -> None:
        run = self.state
        difference = run.drive.hand()[:3, 3] - run.goal
        if operation.name in run.restored:  # what it has added already still belongs to it
            difference = difference + run.restored[operation.name]
        if run.finger_line is not None:  # CENTER measures along the finger line; the rest is servo error
            difference = (difference @ run.finger_line) * run.finger_line
        run.saved[operation.name] = difference
        run.emit(Saved(time=run.time, name=operation.name, difference=vector(difference)))

    def _define(self, name: str) -> None:
        run = self.state
        here = run.world.seen_from(run.world.positions[name].of, run.drive.hand())
        run.world.moved[name] = here
        run.emit(PositionDefined(time=run.time, name=name, at=here.at, of=here.of))

    def _finished(self, number: int) -> StepFinished:
        """The account of a step that is done."""
        run = self.state
        motion = run.plan.motions.get(number)
        planned = None if motion is None else vector(forward(run.arm, np.array(motion.knots[-1]))[:3, 3])
        hand, gap = vector(run.drive.hand()[:3, 3]), round(run.drive.sensed.gap, 6)
        return StepFinished(time=run.time, step=number, hand=hand, planned=planned, gap=gap)

    def _first(self, stage: int) -> int | None:
        """The first step of a stage, or of the next that has any; None behind the last."""
        steps = self.state.plan.program.steps
        return next((number for number, step in enumerate(steps) if step.stage >= stage), None)

    def _enter(self, stage: int) -> None:
        """Tell of a stage when it begins."""
        if self.stage is None:
            run = self.state
            self.stage = stage
            run.emit(StageStarted(time=run.time, stage=run.plan.program.stages[stage]))

    def _leave(self, status: Literal["done", "skipped"] = "done") -> None:
        """Tell of a stage when the program goes on outside it, or has ended."""
        run = self.state
        program = run.plan.program
        if self.stage is None or self.stopped is not None:
            return
        if self.at is None or program.steps[self.at].stage != self.stage:
            run.emit(StageFinished(time=run.time, stage=program.stages[self.stage], status=status))
            self.stage = None

    def _call_operator(self, fault: Fault) -> None:
        sentence = errors.ERRORS.get(fault.number, "an error")
        self._stop(sentence + (f" ({fault.detail})" if fault.detail else ""), fault.number)

    def _stop(self, message: str, error: int | None) -> None:
        """Set the brakes and tell the operator."""
        run = self.state
        run.drive.tool = 0.0
        run.drive.brake(0.1)
        self.stopped = OperatorCalled(time=run.time, message=message, error=error)
        run.emit(self.stopped)
        self.at, self.onward = None, self.at
        self.pending = None

    def _watch_for_circles(self) -> None:
        run = self.state
        self.idle = 0 if run.time > self.clock else self.idle + 1
        self.clock = run.time
        if self.idle > IDLE_LIMIT and self.at is not None:
            line = run.plan.program.steps[self.at].place
            self._stop(f"the program runs in a circle at line {line} without anything moving", None)
