"""The executor: follows the graph of a plan, step by step, and lets the program test what went wrong."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Final

from handeye import errors
from handeye.plan import program as op
from handeye.work import acting, looking
from handeye.work.events import (
    ErrorRaised,
    ErrorTested,
    OperatorCalled,
    RunFinished,
    RunStarted,
    Saved,
    SearchAdvanced,
    StageFinished,
    StageStarted,
    StepFinished,
    StepStarted,
)
from handeye.work.run import Fault, Run, SearchState, vector

IDLE_LIMIT: Final = 10_000
"""Steps without time passing after which a program is taken to run in a circle."""

_ACTIONS: Final[dict[type, Callable[[Run, Any], Fault | None]]] = {
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
    """Carries out a plan on a cell. `step` does one step; `run` does all that are left."""

    state: Run
    at: int | None = 0
    """The step to do next; None when the program has ended or the operator was called."""
    pending: Fault | None = None
    """An error raised and not yet tested."""
    stage: int | None = None
    stopped: OperatorCalled | None = None
    idle: int = 0
    _time: float = field(default=-1.0)

    def run(self) -> bool:
        """Do all steps that are left; True when the program came to its end."""
        run = self.state
        program = run.plan.program
        run.emit(RunStarted(time=run.time, program=program.name, steps=len(program.steps)))
        while self.at is not None:
            self.step()
        if self.stage is not None:
            stage = program.stages[self.stage]
            run.emit(StageFinished(time=run.time, stage=stage, status="stopped" if self.stopped else "done"))
        run.emit(RunFinished(time=run.time, completed=self.stopped is None))
        return self.stopped is None

    def step(self) -> None:
        """Do one step."""
        assert self.at is not None
        run = self.state
        step = run.plan.program.steps[self.at]
        if self.pending is not None and not isinstance(step.operation, op.Test):
            self._call_operator(self.pending)
            return
        self._enter(step.stage)
        run.emit(StepStarted(time=run.time, step=self.at, line=step.line, text=step.text))
        here = self.at
        following = self._perform(here, step)
        hand = run.drive.hand()[:3, 3]
        run.emit(
            StepFinished(time=run.time, step=here, hand=vector(hand), gap=round(run.drive.sensed.gap, 6))
        )
        if self.at is not None:
            self.at = following
        if self.at is None and self.pending is not None:
            self._call_operator(self.pending)
        self._watch_for_circles()

    def _perform(self, number: int, step: op.Step) -> int | None:
        """Do the operation; the number of the step that follows."""
        run = self.state
        operation = step.operation
        if isinstance(operation, op.Test):
            return self._test(operation, step)
        if isinstance(operation, op.Save):
            self._save(operation)
            return step.next
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
        elif isinstance(operation, op.Wait):
            self._stop(operation.message, None)
        elif not isinstance(operation, op.Jump):
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

    def _enter(self, stage: int) -> None:
        """Tell of the stage when it changes."""
        run = self.state
        if stage == self.stage:
            return
        names = run.plan.program.stages
        if self.stage is not None:
            run.emit(StageFinished(time=run.time, stage=names[self.stage], status="done"))
        self.stage = stage
        run.emit(StageStarted(time=run.time, stage=names[stage]))

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
        self.at = None
        self.pending = None

    def _watch_for_circles(self) -> None:
        run = self.state
        self.idle = 0 if run.time > self._time else self.idle + 1
        self._time = run.time
        if self.idle > IDLE_LIMIT and self.at is not None:
            line = run.plan.program.steps[self.at].line
            self._stop(f"the program runs in a circle at line {line} without anything moving", None)
