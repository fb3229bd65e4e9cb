"""The executor: follows the graph of a plan, step by step, and lets the program test what went wrong."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final, Literal

import numpy as np

from handeye import errors
from handeye.arm.kinematics import forward
from handeye.events import (
    Choice,
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
from handeye.execution.context import ExecutionContext
from handeye.execution.state import ExecutionState, Fault, SearchState, vector
from handeye.program import operations as op
from handeye.program.program import Step
from handeye.program.world_model import place

IDLE_LIMIT: Final = 10_000
"""Steps without time passing after which a program is taken to run in a circle."""

_ACTIONS: Final[dict[type, Callable[[ExecutionContext, Any], Fault | None]]] = {
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

    run: ExecutionContext

    @property
    def state(self) -> ExecutionState:
        """What it remembers, shared with the actions."""
        return self.run.state

    def step(self) -> None:
        """Do one step; the operator is called if it raises an error that the next one does not test."""
        run, here = self.run, self.state.at
        assert here is not None
        step = run.plan.program.steps[here]
        self._enter(step.stage)
        run.emit(StepStarted(time=run.time, step=here, file=step.file, line=step.line, text=step.text))
        self.state.at = self._perform(here, step)
        run.emit(self._finished(here))
        if isinstance(step.operation, op.Wait):
            self._stop(step.operation.message, None)
        elif self.state.pending is not None and not self._tests(self.state.at):
            self._call_operator(self.state.pending)
        else:
            self._watch_for_circles()
        self._leave()

    def answer(self, choice: Choice) -> None:
        """Go on after the operator was called."""
        assert self.state.stopped is not None
        assert self.state.stage is not None
        run, stage = self.run, self.state.stage
        going_on = {"proceed": self.state.onward, "retry": self._first(stage), "skip": self._first(stage + 1)}
        self.state.at, self.state.stopped, self.state.onward, self.state.idle = (
            going_on[choice],
            None,
            None,
            0,
        )
        run.emit(OperatorAnswered(time=run.time, choice=choice, step=self.state.at))
        self._leave("skipped" if choice == "skip" else "done")

    def finish(self) -> bool:
        """Close the account of the run; True when the program came to its end."""
        run = self.run
        if self.state.stage is not None:
            stage = run.plan.program.stages[self.state.stage]
            run.emit(StageFinished(time=run.time, stage=stage, status="stopped"))
        completed = self.state.at is None and self.state.stopped is None
        run.emit(RunFinished(time=run.time, completed=completed))
        return completed

    def _perform(self, number: int, step: Step) -> int | None:
        """Do the operation; the number of the step that follows."""
        run = self.run
        operation = step.operation
        if isinstance(operation, op.Test):
            return self._test(operation, step)
        if isinstance(operation, op.Save):
            self._save(operation)
            return step.next
        if isinstance(operation, op.Assign):
            run.state.counters[operation.counter] = operation.value
            return step.next
        if isinstance(operation, op.Countdown):
            left = run.state.counters[operation.counter] = run.state.counters.get(operation.counter, 0) - 1
            return operation.positive if left > 0 else step.next
        if operation.raising and not operation.only_checks:
            run.state.finger_line = None
        if isinstance(operation, op.Move):
            self._raise(acting.move(run, number, operation))
        elif isinstance(operation, op.Advance):
            self._raise(self._advance())
        elif isinstance(operation, op.Search):
            run.state.search = SearchState(step=operation.step, limit=operation.limit)
        elif isinstance(operation, op.Load):
            run.drive.state.load = operation.weight
        elif isinstance(operation, op.Tool):
            run.drive.state.tool = operation.speed
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
        self.state.pending = fault
        if fault is not None:
            self.run.emit(ErrorRaised(time=self.run.time, number=fault.number, detail=fault.detail))

    def _test(self, operation: op.Test, step: Step) -> int | None:
        occurred = self.state.pending is not None and self.state.pending.number == operation.number
        self.run.emit(ErrorTested(time=self.run.time, number=operation.number, occurred=occurred))
        if occurred:
            self.state.pending = None
            return operation.raised
        return step.next

    def _tests(self, number: int | None) -> bool:
        """Whether a step tests for an error."""
        return number is not None and isinstance(self.run.plan.program.steps[number].operation, op.Test)

    def _advance(self) -> Fault | None:
        run = self.run
        if run.state.search is None or run.state.search.count + 1 >= run.state.search.limit:
            tried = (
                "no search was set up"
                if run.state.search is None
                else f"{run.state.search.limit} places tried"
            )
            return Fault(number=errors.SEARCH_EXHAUSTED, detail=tried)
        run.state.search.count += 1
        x, y = run.state.search.offset()
        run.emit(
            SearchAdvanced(time=run.time, count=run.state.search.count, offset=(round(x, 6), round(y, 6)))
        )
        return None

    def _save(self, operation: op.Save) -> None:
        run = self.run
        difference = run.drive.hand()[:3, 3] - run.state.goal
        if operation.name in run.state.restored:  # what it has added already still belongs to it
            difference = difference + run.state.restored[operation.name]
        if (
            run.state.finger_line is not None
        ):  # CENTER measures along the finger line; the rest is servo error
            difference = (difference @ run.state.finger_line) * run.state.finger_line
        run.state.saved[operation.name] = difference
        run.emit(Saved(time=run.time, name=operation.name, difference=vector(difference)))

    def _define(self, name: str) -> None:
        run = self.run
        here = run.world.seen_from(run.world.positions[name].of, run.drive.hand())
        run.state.world.moved[name] = here
        run.emit(PositionDefined(time=run.time, name=name, at=here.at, of=here.of))

    def _finished(self, number: int) -> StepFinished:
        """The account of a step that is done."""
        run = self.run
        motion = run.plan.motions.get(number)
        planned = None if motion is None else vector(forward(run.arm, np.array(motion.knots[-1]))[:3, 3])
        hand, gap = vector(run.drive.hand()[:3, 3]), round(run.drive.sensed.gap, 6)
        return StepFinished(time=run.time, step=number, hand=hand, planned=planned, gap=gap)

    def _first(self, stage: int) -> int | None:
        """The first step of a stage, or of the next that has any; None behind the last."""
        steps = self.run.plan.program.steps
        return next((number for number, step in enumerate(steps) if step.stage >= stage), None)

    def _enter(self, stage: int) -> None:
        """Tell of a stage when it begins."""
        if self.state.stage is None:
            run = self.run
            self.state.stage = stage
            run.emit(StageStarted(time=run.time, stage=run.plan.program.stages[stage]))

    def _leave(self, status: Literal["done", "skipped"] = "done") -> None:
        """Tell of a stage when the program goes on outside it, or has ended."""
        run = self.run
        program = run.plan.program
        if self.state.stage is None or self.state.stopped is not None:
            return
        if self.state.at is None or program.steps[self.state.at].stage != self.state.stage:
            run.emit(StageFinished(time=run.time, stage=program.stages[self.state.stage], status=status))
            self.state.stage = None

    def _call_operator(self, fault: Fault) -> None:
        sentence = errors.ERRORS.get(fault.number, "an error")
        self._stop(sentence + (f" ({fault.detail})" if fault.detail else ""), fault.number)

    def _stop(self, message: str, error: int | None) -> None:
        """Set the brakes and tell the operator."""
        run = self.run
        run.drive.state.tool = 0.0
        run.drive.brake(0.1)
        self.state.stopped = OperatorCalled(time=run.time, message=message, error=error)
        run.emit(self.state.stopped)
        self.state.at, self.state.onward = None, self.state.at
        self.state.pending = None

    def _watch_for_circles(self) -> None:
        run = self.run
        self.state.idle = 0 if run.time > self.state.clock else self.state.idle + 1
        self.state.clock = run.time
        if self.state.idle > IDLE_LIMIT and self.state.at is not None:
            line = run.plan.program.steps[self.state.at].place
            self._stop(f"the program runs in a circle at line {line} without anything moving", None)
